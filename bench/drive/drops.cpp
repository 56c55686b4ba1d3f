// Objects dropped onto nets held still, as the catch's rules allow them.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "bench/drive/parts.hpp"
#include "bench/drive/statistics.hpp"
#include "seine/sim/drops.hpp"

namespace seine::bench {
namespace {

constexpr std::uint64_t kSeed = 2026;
constexpr double kOpenings[] = {0.88, 0.90, 0.92, 0.95};

struct Hung {
  net::Net net;
  std::vector<geom::Vec3> corners;
  sim::CordNet physics;
};

std::vector<Hung> hang(int robots) {
  const net::Net net = world::family_net(robots);
  std::vector<Hung> hung;
  for (const double opening : kOpenings) {
    const std::vector<geom::Vec3> corners = sim::held(net, opening);
    hung.push_back({net, corners, sim::CordNet(net, corners, sim::material_of_rebound(net.rebound))});
  }
  return hung;
}

void tell(int index, const sim::CatchWatch& watch, const sim::Drop& drop) {
  const net::Catch& c = drop.measured;
  std::printf("    drop %d of seed %llu: %s, %.1f m/s, %.0f degrees, margins %.2f and %.2f m, opening %.2f\n",
              index, static_cast<unsigned long long>(kSeed), sim::name_of(watch.fate()), c.speed,
              c.angle * 180.0 / std::numbers::pi, c.rim_margin, c.contact_margin, c.opening);
}

}  // namespace

void drops(int runs) {
  std::printf("drops onto a still net that meet the conditions of a catch: caught\n");
  for (const int robots : {3, 4, 6}) {
    Rng rng(kSeed);
    const std::vector<Hung> nets = hang(robots);
    int caught = 0;
    for (int i = 0; i < runs; ++i) {
      progress("drops", i, runs);
      const Hung& hung = nets[static_cast<std::size_t>(rng.below(std::size(kOpenings)))];
      sim::Drop drop;
      do {
        drop = sim::random_drop(rng, hung.net, sim::on_ground(hung.corners), {});
      } while (!sim::certified(hung.net, drop));
      sim::CordNet physics = hung.physics;
      const sim::CatchWatch watch = sim::watch_drop(physics, hung.corners, drop);
      watch.fate() == sim::Fate::caught ? void(++caught) : tell(i, watch, drop);
    }
    progress("drops", runs, runs);
    std::printf("  %d corners: %d of %d, %.1f %%\n", robots, caught, runs, 100.0 * caught / runs);
    std::fflush(stdout);
  }
}

}  // namespace seine::bench
