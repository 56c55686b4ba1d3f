#include <algorithm>
#include <array>
#include <cmath>

#include "seine/search/route.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

// Sweeps tried for one route at most: a wiggly one of 20 arcs needs about 15.
constexpr int kMaxSweeps = 80;
// Saving less than this many metres (in turning radii) is not worth a sweep.
constexpr double kWorthwhile = 0.01;

/// A route as arcs with the poses between them; arcs are cut so that there are enough places to start a
/// shortcut from.
class Shortener {
 public:
  Shortener(Route& route, const FootprintChecker& checker, const RouteCosts& costs)
      : route_(route), checker_(checker), costs_(costs) {}

  void run();

 private:
  void cut();
  bool try_span(std::size_t first, std::size_t count);
  double cost(std::size_t first, std::size_t count, std::span<const Arc> instead) const;

  Route& route_;
  const FootprintChecker& checker_;
  const RouteCosts& costs_;
  std::vector<Arc> arcs_;
  std::vector<geom::Pose2> poses_;  // poses_[i] is where arcs_[i] begins; one more than arcs
  int sweeps_ = 0;
};

void Shortener::cut() {
  merge(route_.arcs);
  arcs_.clear();
  poses_.assign(1, route_.start);
  for (const Arc& arc : route_.arcs) {
    const int parts = std::clamp(static_cast<int>(std::abs(arc.distance) / costs_.radius), 1, 8);
    for (int i = 0; i < parts; ++i) {
      arcs_.push_back({arc.curvature, arc.distance / parts});
      poses_.push_back(vehicle::drive(poses_.back(), arcs_.back()));
    }
  }
  poses_.back() = route_.goal;
}

/// Of the window with `instead` in the place of arcs [first, first + count), judged with its neighbours, so
/// that gear changes and short stretches at its seams count.
double Shortener::cost(std::size_t first, std::size_t count, std::span<const Arc> instead) const {
  const std::size_t low = first >= 3 ? first - 3 : 0, high = std::min(arcs_.size(), first + count + 3);
  std::array<Arc, 128> window;
  std::size_t size = 0;
  const auto add = [&](const Arc& arc) { window[size++] = arc; };
  std::for_each(arcs_.begin() + static_cast<std::ptrdiff_t>(low),
                arcs_.begin() + static_cast<std::ptrdiff_t>(first), add);
  std::for_each(instead.begin(), instead.end(), add);
  std::for_each(arcs_.begin() + static_cast<std::ptrdiff_t>(first + count),
                arcs_.begin() + static_cast<std::ptrdiff_t>(high), add);
  return costs_.of(poses_[low], {window.data(), size}, low > 0 ? &arcs_[low - 1] : nullptr);
}

bool Shortener::try_span(std::size_t first, std::size_t count) {
  const std::span<const Arc> old(arcs_.data() + first, count);
  const double now = cost(first, count, old);
  std::array<vehicle::ReedsSheppPath, 3> words;
  const int found =
      vehicle::reeds_shepp(poses_[first], poses_[first + count], costs_.radius, costs_.driving, words);
  for (int k = 0; k < found && sweeps_ < kMaxSweeps; ++k) {
    const std::span<const Arc> word = words[static_cast<std::size_t>(k)].arcs();
    if (cost(first, count, word) > now - kWorthwhile * costs_.radius) continue;
    ++sweeps_;
    if (sweep(checker_, poses_[first], checker_.room(poses_[first]), word) < 0.0) continue;
    const auto at = arcs_.begin() + static_cast<std::ptrdiff_t>(first);
    std::vector<Arc> arcs(arcs_.begin(), at);
    arcs.insert(arcs.end(), word.begin(), word.end());
    arcs.insert(arcs.end(), at + static_cast<std::ptrdiff_t>(count), arcs_.end());
    route_.arcs = std::move(arcs);
    cut();
    return true;
  }
  return false;
}

void Shortener::run() {
  cut();
  constexpr std::size_t kMaxSpan = 96;  // arcs, what `cost` has room for
  for (std::size_t span = std::min(arcs_.size(), kMaxSpan); span >= 2 && sweeps_ < kMaxSweeps;) {
    bool better = false;
    for (std::size_t first = 0; first + span <= arcs_.size() && sweeps_ < kMaxSweeps;
         first += std::max<std::size_t>(1, span / 3)) {
      better = try_span(first, span) || better;
    }
    span = better ? std::min(span, arcs_.size()) : std::min(span - 1, (2 * span) / 3);
  }
  merge(route_.arcs);
}

}  // namespace

void shorten(Route& route, const FootprintChecker& checker, const RouteCosts& costs) {
  Shortener(route, checker, costs).run();
}

}  // namespace seine::search
