// TPCAP parking cases.
#include <cstdint>
#include <string_view>

#include "seine/base/error.hpp"
#include "seine/io/scenario_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seine;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    io::parse_scenario(bytes, "fuzz.csv", "/nonexistent");
  } catch (const InputError&) {
  }
  return 0;
}
