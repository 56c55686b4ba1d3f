// ./dev bench drive: what a driven plan is worth, against the numbers asked for.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/drive/parts.hpp"

int main(int count, char** arguments) {
  using namespace seine::bench;
  int runs = 100;
  std::string only;
  for (int i = 1; i < count; ++i)
    (std::atoi(arguments[i]) > 0 ? runs = std::atoi(arguments[i]),
     only                        : only += std::string(" ") + arguments[i]);
  const auto wanted = [&](const char* part) { return only.empty() || only.find(part) != std::string::npos; };
  if (wanted("tracking")) tracking(runs);
  if (wanted("collisions")) collisions(runs);
  if (wanted("throws")) throws(runs);
  if (wanted("replanning")) replanning(runs);
  if (wanted("speed")) speed(runs);
  if (wanted("drops")) drops(5 * runs);
  return 0;
}
