#include "seine/search/formation_shot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "seine/vehicle/reeds_shepp.hpp"

namespace seine::search {
namespace {

using geom::Pose2;
using geom::Vec2;
using vehicle::Arc;

constexpr double kTurns[] = {0.0, 0.1, -0.1, 0.3, -0.3, 0.6, -0.6, 0.88, -0.88};  // of κ_max
constexpr double kWordTurn = 0.8;  // of κ_max: the optimiser needs something to give
// Headings to end with where the goal leaves it free, rad from the present one: fine ones for small shifts
// aside.
constexpr double kOffHeadings[] = {0.03, 0.08, 0.2, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4, 2.8};
constexpr std::size_t kWords = 4;
constexpr double kSingleArc = 6.0;     // car lengths, the longest single arc that is tried
constexpr int kArcSamples = 48;        // of an arc, to see where it enters the region
constexpr double kSpacing = 0.2;       // car lengths between poses that are looked at
constexpr double kNothing = 1e-9;      // m
constexpr int kMostLooks = 6;          // candidates that are driven pose by pose
constexpr double kHeadingShare = 0.5;  // of the goal's tolerance, for a way that ends early

Pose2 pose_of(const Stand& stand) {
  return {stand.at.x, stand.at.y, stand.heading};
}

Stand after(const Stand& stand, const Arc& arc, double distance) {
  return stand_at(vehicle::drive(pose_of(stand), arc.curvature, distance));
}

}  // namespace

FormationShots::FormationShots(const FormationGoal& goal, const TeamLimits& limits, FormationGround& ground,
                               bool forward, bool backward)
    : goal_(goal),
      limits_(limits),
      ground_(ground),
      forward_(forward),
      backward_(backward && limits.reverse_speed > 0.0) {}

bool FormationShots::may_drive(const FormationShot& shot) const {
  return std::all_of(shot.arcs.begin(), shot.arcs.end(),
                     [&](const Arc& arc) { return arc.distance > 0.0 ? forward_ : backward_; });
}

bool FormationShots::inside(const Stand& stand, const Formation& held) {
  if (geom::norm(ground_.middle(stand, held) - goal_.center) > goal_.radius) return false;
  return !goal_.heading || std::abs(geom::wrap_angle(stand.heading - *goal_.heading)) <=
                               kHeadingShare * goal_.heading_tolerance;
}

// Cuts a way where it enters the region; false where it never does.
bool FormationShots::end_early(const Stand& stand, const Formation& held, FormationShot& shot) {
  Stand from = stand;
  for (std::size_t i = 0; i < shot.arcs.size(); ++i) {
    Arc& arc = shot.arcs[i];
    for (int k = 1; k <= kArcSamples; ++k) {
      double far = arc.distance * k / kArcSamples, near = arc.distance * (k - 1) / kArcSamples;
      if (!inside(after(from, arc, far), held)) continue;
      for (int j = 0; j < 20; ++j) {
        const double middle = 0.5 * (near + far);
        (inside(after(from, arc, middle), held) ? far : near) = middle;
      }
      arc.distance = far;
      shot.arcs.resize(i + 1);
      return true;
    }
    from = after(from, arc, arc.distance);
  }
  return false;
}

void FormationShots::offer(FormationShot shot, const Arc* before) {
  std::erase_if(shot.arcs, [](const Arc& arc) { return std::abs(arc.distance) < kNothing; });
  if (shot.arcs.empty() || !may_drive(shot)) return;
  shot.cost = 0.0;
  for (const Arc& arc : shot.arcs) {
    shot.cost += limits_.time_of(arc) + limits_.time_between(before, arc);
    before = &arc;
  }
  shots_.push_back(std::move(shot));
}

void FormationShots::offer_single_arcs(const Stand& stand, const Formation& held, const Arc* before) {
  const double reach = geom::norm(ground_.middle(stand, held) - goal_.center) + goal_.radius;
  const double longest = std::min(kSingleArc * limits_.length, 1.6 * reach);
  for (const double turn : kTurns)
    for (const double gear : {1.0, -1.0}) {
      FormationShot shot{{{turn * limits_.curvature, gear * longest}}, 0.0};
      if (end_early(stand, held, shot)) offer(std::move(shot), before);
    }
}

void FormationShots::offer_words(const Stand& stand, const Formation& held, double heading,
                                 const Arc* before) {
  // Where the frame stands when the net's middle is on the goal.
  const Stand turned = stand_at({0.0, 0.0, heading});
  const Vec2 at = goal_.center - ground_.middle(turned, held);
  std::array<vehicle::ReedsSheppPath, kWords> words;
  vehicle::DrivingCosts costs{
      .reverse = 1.0 + kBackwardPrice,
      .gear_change = kGearPrice * limits_.speed * limits_.speed / limits_.acceleration};
  if (!backward_) costs.reverse = 1e3;
  if (!forward_) costs.forward = 1e3;
  const int found = vehicle::reeds_shepp(pose_of(stand), {at.x, at.y, heading},
                                         1.0 / (kWordTurn * limits_.curvature), costs, words);
  for (int i = 0; i < found; ++i) {
    const auto& word = words[static_cast<std::size_t>(i)];
    FormationShot shot{{word.arcs().begin(), word.arcs().end()}, 0.0};
    if (!goal_.exact) end_early(stand, held, shot);
    offer(std::move(shot), before);
  }
}

// Out straight and then to the goal, so that the way has the length asked for.
void FormationShots::offer_detours(const Stand& stand, const Formation& held, double least) {
  const std::vector<FormationShot> direct = std::exchange(shots_, {});
  for (const FormationShot& shot : direct) {
    double length = 0.0;
    for (const Arc& arc : shot.arcs) length += std::abs(arc.distance);
    if (length >= least) shots_.push_back(shot);
  }
  for (const double out : {0.5 * least, -0.5 * least}) {
    const Arc first{0.0, out};
    const std::vector<FormationShot> before = std::exchange(shots_, {});
    const Stand there = after(stand, first, out);
    for (const double heading : headings_from(there, ground_.middle(there, held)))
      offer_words(there, held, heading, &first);
    for (FormationShot& shot : shots_) {
      shot.arcs.insert(shot.arcs.begin(), first);
      shot.cost += limits_.time_of(first);
    }
    std::erase_if(shots_, [&](const FormationShot& shot) { return !may_drive(shot); });
    shots_.insert(shots_.begin(), before.begin(), before.end());
  }
}

std::vector<double> FormationShots::headings_from(const Stand& stand, Vec2 middle) const {
  if (goal_.heading) return {*goal_.heading};
  const Vec2 way = goal_.center - middle;
  std::vector<double> headings{stand.heading};
  if (geom::norm(way) > kNothing) {
    headings.push_back(std::atan2(way.y, way.x));
    headings.push_back(std::atan2(-way.y, -way.x));
  }
  for (const double off : kOffHeadings)
    for (const double side : {1.0, -1.0}) headings.push_back(geom::wrap_angle(stand.heading + side * off));
  return headings;
}

bool FormationShots::clear(const Stand& stand, const Formation& held, const FormationShot& shot) {
  Stand from = stand;
  for (const Arc& arc : shot.arcs) {
    const int checks =
        std::max(1, static_cast<int>(std::ceil(std::abs(arc.distance) / (kSpacing * limits_.length))));
    for (int k = checks; k > 0; --k)
      if (!ground_.clear(after(from, arc, arc.distance * k / checks), held)) return false;
    from = after(from, arc, arc.distance);
  }
  return true;
}

std::optional<FormationShot> FormationShots::from(const Stand& stand, const Formation& held,
                                                  const Arc* before, double least) {
  shots_.clear();
  if (!goal_.heading) offer_single_arcs(stand, held, before);
  for (const double heading : headings_from(stand, ground_.middle(stand, held)))
    offer_words(stand, held, heading, before);
  if (least > 0.0) offer_detours(stand, held, least);
  std::stable_sort(shots_.begin(), shots_.end(),
                   [](const FormationShot& a, const FormationShot& b) { return a.cost < b.cost; });
  const std::size_t looks = std::min<std::size_t>(shots_.size(), kMostLooks);
  for (std::size_t i = 0; i < looks; ++i)
    if (clear(stand, held, shots_[i])) return shots_[i];
  return std::nullopt;
}

}  // namespace seine::search
