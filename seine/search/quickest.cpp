#include "seine/search/quickest.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "seine/search/drive_time.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

// Wider turns are longer; they pay where bends are taken slowly or the wheel turns slowly.
constexpr double kRadii[] = {1.0, 1.5, 2.2, 3.3, 5.0, 10.0, 25.0, 60.0};
constexpr int kWords = 8;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A way must be quicker by this share to be taken for another: estimates are no better.
constexpr double kWorthwhile = 0.01;
// What it adds to the time of a way, in the time a car needs to drive its own length √(length /
// acceleration).
constexpr double kGearChange = 0.1, kShortStretch = 1.0;
constexpr double kShort = 0.3;      // car lengths
constexpr double kTooShort = 0.15;  // the same: a word with such a stretch is left to the search

double shortest_stretch(std::span<const Arc> arcs) {
  double shortest = std::numeric_limits<double>::infinity(), stretch = 0.0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    stretch += std::abs(arcs[i].distance);
    if (i + 1 < arcs.size() && arcs[i + 1].gear() == arcs[i].gear()) continue;
    shortest = std::min(shortest, stretch);
    stretch = 0.0;
  }
  return shortest;
}

/// s, to compare ways by: a gear change has to be earned, and a stretch in one gear of less than a third of a
/// car leaves the optimiser no room.
double trouble(std::span<const Arc> arcs, const vehicle::Model& model) {
  const double length = model.length(), unit = std::sqrt(length / model.limits.acceleration);
  double time = drive_time(arcs, model), stretch = 0.0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    stretch += std::abs(arcs[i].distance);
    const bool last = i + 1 == arcs.size();
    if (!last && arcs[i + 1].gear() == arcs[i].gear()) continue;
    if (!last) time += kGearChange * unit;
    time += kShortStretch * unit * std::max(0.0, 1.0 - stretch / (kShort * length));
    stretch = 0.0;
  }
  return time;
}

}  // namespace

bool quicker(const Route& route, const Route& than, const vehicle::Model& model) {
  return trouble(route.arcs, model) < (1.0 - kWorthwhile) * trouble(than.arcs, model);
}

bool take_quickest_word(Route& route, const FootprintChecker& checker, double radius) {
  const vehicle::Model& model = checker.model();
  const vehicle::Limits& limits = model.limits;
  const bool backs = limits.reverse_speed > 0.0;
  const double slower = backs ? std::max(1.0, limits.speed / limits.reverse_speed) : kInfinity;
  const double room = checker.room(route.start);
  double best = route.arcs.empty() ? kInfinity : (1.0 - kWorthwhile) * trouble(route.arcs, model);
  bool taken = false;
  const auto look = [&](double turn, const vehicle::DrivingCosts& costs) {
    std::array<vehicle::ReedsSheppPath, kWords> words;
    const int found = vehicle::reeds_shepp(route.start, route.goal, turn, costs, words);
    for (std::size_t k = 0; k < static_cast<std::size_t>(found); ++k) {
      if (shortest_stretch(words[k].arcs()) < kTooShort * model.length()) continue;
      const double time = trouble(words[k].arcs(), model);
      if (!(time < best) || sweep(checker, route.start, room, words[k].arcs()) < 0.0) continue;
      best = time, taken = true;
      route.arcs.assign(words[k].arcs().begin(), words[k].arcs().end());
    }
  };
  for (const double factor : kRadii) {
    const double turn = factor * radius;
    look(turn, {.reverse = slower});
    look(turn, {.reverse = slower, .gear_change = 4.0 * turn});
    look(turn, {.reverse = kInfinity});
    if (backs) look(turn, {.reverse = 1.0, .forward = kInfinity});
  }
  return taken;
}

}  // namespace seine::search
