#include "seine/search/bays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "seine/geom/box.hpp"
#include "seine/geom/convex.hpp"

namespace seine::search {
namespace {

constexpr double kAlong = 0.5;      // car lengths between places looked at along the way
constexpr double kAside = 0.1;      // car widths between those looked at beside it …
constexpr double kFurthest = 4.0;   // … and how far away
constexpr double kOtherStep = 0.2;  // car lengths between the other's footprints
constexpr double kSlack = 0.01;     // car lengths, on top of both clearances
constexpr std::size_t kMost = 4;    // places

/// Where the other car drives, as footprints with a slack for what lies between them.
class Lane {
 public:
  Lane(const BayQuestion& question)
      : clearance_(question.robot_clearance + kSlack * question.model->length()) {
    const double step = kOtherStep * question.other_model->length(), length = question.other->length();
    for (double s = 0.0;; s += step) {
      std::vector<geom::Vec2> footprint(question.other_model->footprint.size());
      geom::place(question.other_model->footprint, pose_at(*question.other, std::min(s, length)), footprint);
      boxes_.push_back(geom::bounding_box(footprint).inflated(clearance_));
      footprints_.push_back(std::move(footprint));
      if (s >= length) break;
    }
  }
  bool keeps_off(const geom::Convex& body) const {
    const geom::Box box = body.box();
    for (std::size_t i = 0; i < footprints_.size(); ++i)
      if (boxes_[i].overlaps(box) && geom::distance(body.core, footprints_[i]) < clearance_) return false;
    return true;
  }

 private:
  double clearance_;
  std::vector<std::vector<geom::Vec2>> footprints_;
  std::vector<geom::Box> boxes_;
};

/// The place beside `on` on one side that keeps off everything: half way between the nearest such place and
/// the furthest, so that there is room on both sides.
std::optional<geom::Pose2> place_beside(const BayQuestion& question, const Lane& lane, const geom::Pose2& on,
                                        double side) {
  const vehicle::Model& model = *question.model;
  const geom::Convex body{model.footprint};
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
    if (!lane.keeps_off(geom::placed(body, beside(i)))) continue;
    if (nearest == 0) nearest = i;
    furthest = i;
  }
  if (nearest == 0) return std::nullopt;
  // Further off than its width and a half more room brings nothing.
  return beside(std::min((nearest + furthest + 1) / 2, nearest + static_cast<int>(0.5 / kAside)));
}

}  // namespace

std::vector<geom::Pose2> bays_beside(const BayQuestion& question) {
  const Lane lane(question);
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
