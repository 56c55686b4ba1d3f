// Native scenarios and CL-MAPF instances: whatever is accepted must survive writing and reading.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "seine/base/error.hpp"
#include "seine/io/scenario_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seine;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  world::Scenario scenario;
  try {
    scenario = io::parse_scenario(text, "fuzz.yaml", "/nonexistent");
  } catch (const InputError&) {
    return 0;
  }
  const std::string written = io::scenario_text(scenario);
  if (io::scenario_text(io::parse_scenario(written, "again.yaml", "/nonexistent")) != written) std::abort();
  return 0;
}
