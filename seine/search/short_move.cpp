#include "seine/search/short_move.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "seine/search/drive_time.hpp"
#include "seine/vehicle/reeds_shepp.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFurthest = 2.0;    // car lengths
constexpr double kJerkShare = 0.15;  // of v / a: what a stretch takes longer for its smooth ends
constexpr double kSamePlace = 9e-5;  // m, and rad of the heading: the certificate grants 1e-4
constexpr double kNoLength = 1e-9;   // m

// Car lengths: shorter stretches save next to no time, and are lost between the optimiser's tolerances.
constexpr double kLeastStretch = 0.02;

// Of the smallest turning radius. Wide turns are for cars whose wheel turns slowly, and the widest for goals
// so near that tight ones would make stretches too short.
constexpr std::array kRadii{1.1, 1.4, 2.0, 3.0, 5.0, 8.0, 12.0, 30.0, 80.0, 200.0, 500.0, 1200.0};

/// The goal's place when the car only rolls forth or back; nothing when it would miss.
std::optional<Route> straight_move(const geom::Pose2& start, const geom::Pose2& goal) {
  const geom::Vec2 gap = goal.position() - start.position();
  const double along = geom::dot(start.direction(), gap), aside = geom::cross(start.direction(), gap);
  if (std::abs(aside) > kSamePlace || std::abs(geom::wrap_angle(goal.heading - start.heading)) > kSamePlace)
    return std::nullopt;
  const Arc arc{0.0, along};
  return Route{start, vehicle::drive(start, arc), {arc}};
}

/// Of the stretches in one gear, m.
double shortest_stretch(std::span<const Arc> arcs) {
  double shortest = kInfinity, stretch = 0.0;
  int gear = 0;
  for (const Arc& arc : arcs) {
    if (std::abs(arc.distance) < kNoLength) continue;
    if (gear != 0 && arc.gear() != gear) {
      shortest = std::min(shortest, stretch);
      stretch = 0.0;
    }
    gear = arc.gear();
    stretch += std::abs(arc.distance);
  }
  return std::min(shortest, stretch);
}

/// The quickest of the words that are clear.
class Choice {
 public:
  Choice(const geom::Pose2& start, const geom::Pose2& goal, const FootprintChecker& checker)
      : start_(start), goal_(goal), checker_(checker), room_(checker.room(start)) {}

  void look_at(double radius, const vehicle::DrivingCosts& costs) {
    std::array<vehicle::ReedsSheppPath, 8> words;
    const int found = vehicle::reeds_shepp(start_, goal_, radius, costs, words);
    for (std::size_t k = 0; k < static_cast<std::size_t>(found); ++k) {
      if (shortest_stretch(words[k].arcs()) < kLeastStretch * checker_.model().length()) continue;
      const double time = smooth_drive_time(words[k].arcs(), checker_.model());
      if (!(time < quickest_) || sweep(checker_, start_, room_, words[k].arcs()) < 0.0) continue;
      quickest_ = time;
      const auto arcs = words[k].arcs();
      best_ = Route{start_, goal_, {arcs.begin(), arcs.end()}};
    }
  }
  std::optional<Route> best() { return std::move(best_); }

 private:
  const geom::Pose2 &start_, &goal_;
  const FootprintChecker& checker_;
  double room_, quickest_ = kInfinity;
  std::optional<Route> best_;
};

}  // namespace

double smooth_drive_time(std::span<const Arc> arcs, const vehicle::Model& model) {
  double time = drive_time(arcs, model), stretch = 0.0;
  const auto wheel = [&](const Arc& arc) { return std::atan(model.wheelbase * arc.curvature); };
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    // On short arcs nothing else happens while the wheel turns.
    if (i > 0) time += std::abs(wheel(arcs[i]) - wheel(arcs[i - 1])) / model.limits.steering_rate;
    stretch += std::abs(arcs[i].distance);
    if (i + 1 < arcs.size() && arcs[i + 1].gear() == arcs[i].gear()) continue;
    const double top = arcs[i].gear() > 0 ? model.limits.speed : model.limits.reverse_speed;
    const double acceleration = model.limits.acceleration;
    time += kJerkShare * std::min(top / acceleration, std::sqrt(stretch / acceleration));
    stretch = 0.0;
  }
  return time;
}

std::optional<Route> short_move(const geom::Pose2& start, const geom::Pose2& goal,
                                const FootprintChecker& checker) {
  const vehicle::Model& model = checker.model();
  if (geom::norm(goal.position() - start.position()) > kFurthest * model.length()) return std::nullopt;
  if (std::optional<Route> move = straight_move(start, goal);
      move && smooth_drive_time(move->arcs, model) < kInfinity &&
      sweep(checker, start, checker.room(start), move->arcs) >= 0.0)
    return move;

  const double smallest = 1.0 / model.max_curvature();
  const vehicle::Limits& limits = model.limits;
  const double backwards = std::clamp(limits.speed / limits.reverse_speed, 1.0, 1e3);
  Choice choice(start, goal, checker);
  for (const double share : kRadii) {
    const double radius = share * smallest;
    for (const double change : {0.0, 0.3, 2.0})
      choice.look_at(radius, {.reverse = backwards, .gear_change = change * radius});
  }
  return choice.best();
}

}  // namespace seine::search
