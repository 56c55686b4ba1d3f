#include "seine/search/bays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "seine/geom/convex.hpp"
#include "seine/search/refuge.hpp"

namespace seine::search {
namespace {

constexpr double kAlong = 0.5;     // car lengths between places looked at along the way
constexpr double kAside = 0.1;     // car widths between those looked at beside it …
constexpr double kFurthest = 4.0;  // … and how far away
constexpr double kSlack = 0.01;    // car lengths, on top of both clearances
constexpr std::size_t kMost = 4;   // places

/// The place beside `on` on one side that keeps off everything: half way between the nearest such place and
/// the furthest, so that there is room on both sides.
std::optional<geom::Pose2> place_beside(const BayQuestion& question, const Lane& lane, const geom::Pose2& on,
                                        double side) {
  const vehicle::Model& model = *question.model;
  const geom::Vec2 aside = (side * kAside * model.width()) * geom::unit(on.heading + 0.5 * std::numbers::pi);
  const auto beside = [&](int steps) {
    const geom::Vec2 at = on.position() + static_cast<double>(steps) * aside;
    return geom::Pose2{at.x, at.y, on.heading};
  };
  std::vector<geom::Vec2> footprint(model.footprint.size());
  int nearest = 0, furthest = 0;
  for (int i = 1; i * kAside <= kFurthest; ++i) {
    geom::place(model.footprint, beside(i), footprint);
    if (!question.map->clear(footprint, question.obstacle_clearance + kSlack * model.length())) break;
    if (lane.room(footprint, 0.0) < 0.0) continue;
    if (nearest == 0) nearest = i;
    furthest = i;
  }
  if (nearest == 0) return std::nullopt;
  // Further off than its width and a half more room brings nothing.
  return beside(std::min((nearest + furthest + 1) / 2, nearest + static_cast<int>(0.5 / kAside)));
}

}  // namespace

std::vector<geom::Pose2> bays_beside(const BayQuestion& question) {
  Lane lane;
  lane.add(*question.other_model, *question.other, question.robot_clearance);
  const double step = kAlong * question.model->length(), length = question.way->length();
  std::vector<std::vector<geom::Pose2>> stretches;  // of neighbouring places on one side
  for (const double side : {1.0, -1.0}) {
    bool open = false;
    for (double s = 0.0; s <= length; s += step) {
      const auto place = place_beside(question, lane, pose_at(*question.way, s), side);
      if (place && !open) stretches.emplace_back();
      if (place) stretches.back().push_back(*place);
      open = place.has_value();
    }
  }
  std::sort(stretches.begin(), stretches.end(),
            [](const auto& a, const auto& b) { return a.size() > b.size(); });
  // The middle of each first, then places a quarter in from its ends.
  std::vector<geom::Pose2> bays;
  for (const double share : {0.5, 0.25, 0.75})
    for (const auto& stretch : stretches) {
      if (bays.size() == kMost) return bays;
      if (share == 0.5 || stretch.size() >= 4)
        bays.push_back(stretch[static_cast<std::size_t>(share * static_cast<double>(stretch.size()))]);
    }
  return bays;
}

}  // namespace seine::search
