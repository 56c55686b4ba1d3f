// Measured flights: where they end, foretold from their beginning.
#include <cstdio>
#include <vector>

#include "bench/drive/parts.hpp"
#include "seine/sim/flights.hpp"

namespace seine::bench {
namespace {

void row(const char* name, const std::vector<sim::Track>& tracks, double noise) {
  const sim::Errors errors = sim::errors_of(tracks, noise);
  std::printf("  %-24s %3zu flights   filter %4.0f %4.0f %4.0f   line fit %4.0f %4.0f %4.0f\n", name,
              tracks.size(), errors.filter[0], errors.filter[1], errors.filter[2], errors.line[0],
              errors.line[1], errors.line[2]);
}

}  // namespace

void flights() {
  std::printf("error of the foretold end of a flight after 30, 50, 70 %% of it, median in mm\n");
  row("thrown balls", sim::thrown_balls(SEINE_DATA_DIR), 1e-3);
  row("table tennis 2019", sim::table_tennis(SEINE_DATA_DIR, "2019"), 1e-2);
  row("table tennis 2020", sim::table_tennis(SEINE_DATA_DIR, "2020"), 1e-2);
}

}  // namespace seine::bench
