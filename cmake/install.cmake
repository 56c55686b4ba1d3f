# `cmake --install` puts the program, the rooms and their headers in place; find_package(seine) then offers seine::seine
# (everything) and seine::<room>.
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY SEINE_ROOMS)
add_library(seine_all INTERFACE)
set_target_properties(seine_all PROPERTIES EXPORT_NAME seine)
set(targets seine_all)
foreach(room ${rooms})
  target_link_libraries(seine_all INTERFACE seine_${room})
  list(APPEND targets seine_${room})
endforeach()
add_library(seine::seine ALIAS seine_all)

install(TARGETS ${targets} EXPORT seineTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET seine)
  install(TARGETS seine RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY seine/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/seine
  FILES_MATCHING PATTERN "*.hpp" PATTERN "test" EXCLUDE)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/seine)
install(EXPORT seineTargets NAMESPACE seine:: DESTINATION ${package})
configure_package_config_file(cmake/seineConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/seineConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/seineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/seineConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/seineConfigVersion.cmake
  DESTINATION ${package})
