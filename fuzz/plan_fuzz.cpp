// Plan files.
#include <cstdint>
#include <string_view>

#include "seine/base/error.hpp"
#include "seine/io/plan_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seine;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    io::parse_plan(bytes, "plan.json");
  } catch (const InputError&) {
  }
  return 0;
}
