// The YAML file of a ROS map.
#include <cstdint>
#include <string_view>

#include "seine/base/error.hpp"
#include "seine/io/map_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seine;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    io::parse_map_header(bytes, "fuzz.yaml");
  } catch (const InputError&) {
  }
  return 0;
}
