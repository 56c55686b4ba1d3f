// ./dev bench drive [N] [PART…]: what driven plans are worth, against the numbers asked for.
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "bench/drive/parts.hpp"

namespace seine::bench {
namespace {

struct Part {
  std::string name;
  std::function<void(int)> run;
};

const std::vector<Part> kParts{{"programmes", [](int runs) { programmes((runs + 4) / 5); }},
                               {"tracking", tracking},
                               {"collisions", collisions},
                               {"throws", throws},
                               {"replanning", [](int runs) { replanning((runs + 1) / 2); }},
                               {"speed", [](int runs) { speed((runs + 4) / 5); }},
                               {"drops", [](int runs) { drops(5 * runs); }},
                               {"flights", [](int) { flights(); }}};

int complain() {
  std::string names;
  for (const Part& part : kParts) names += " [" + part.name + "]";
  std::fprintf(stderr, "usage: seine_drive_bench [RUNS]%s\n", names.c_str());
  return 2;
}

int run(const std::vector<std::string>& arguments) {
  int runs = 100;
  std::vector<const Part*> chosen;
  for (const std::string& argument : arguments) {
    const Part* found = nullptr;
    for (const Part& part : kParts)
      if (part.name == argument) found = &part;
    if (found != nullptr) {
      chosen.push_back(found);
    } else if (runs = std::atoi(argument.c_str()); runs <= 0) {
      return complain();
    }
  }
  if (chosen.empty())
    for (const Part& part : kParts) chosen.push_back(&part);
  for (const Part* part : chosen) part->run(runs);
  return 0;
}

}  // namespace
}  // namespace seine::bench

int main(int count, char** arguments) {
  return seine::bench::run({arguments + 1, arguments + count});
}
