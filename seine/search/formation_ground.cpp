#include "seine/search/formation_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace seine::search {
namespace {

using geom::Pose2;
using geom::Vec2;

// Car lengths; docs/net-planning.md has the measurements.
constexpr double kCarSlack = 0.05, kNetSlack = 0.05;  // on top of the margins
constexpr double kCell = 0.3, kFar = 2.0;             // of the distances for cars

Vec2 turned(Vec2 v, Vec2 by) {
  return {by.x * v.x - by.y * v.y, by.y * v.x + by.x * v.y};
}

double longest_car(const world::Scenario& scenario) {
  double length = 0.0;
  for (const world::Robot& robot : scenario.robots)
    length = std::max(length, scenario.model_of(robot).length());
  return length;
}

}  // namespace

FormationGround::FormationGround(const FormationProblem& problem)
    : p_(problem),
      length_(longest_car(*problem.scenario)),
      cars_(*problem.map, kCell * length_, kFar * length_) {
  for (const world::Robot& robot : p_.scenario->robots) {
    const std::vector<Vec2>& footprint = p_.scenario->model_of(robot).footprint;
    const geom::Box box = geom::bounding_box(footprint);
    Disc disc{box.center().x, 0.0, 0.5 * std::min(box.size().x, box.size().y)};
    for (const Vec2 corner : footprint)
      disc.outer = std::max(disc.outer, geom::norm(corner - Vec2{disc.ahead, 0.0}));
    // Only of a rectangle is the inner disc known to be inside.
    if (footprint.size() != 4 || std::abs(box.center().y) > 1e-9) disc.inner = 0.0;
    discs_.push_back(disc);
  }
}

// Fills attachments_.
void FormationGround::hold(const Stand& frame, const Formation& formation) {
  attachments_.resize(formation.offsets.size());
  for (std::size_t k = 0; k < attachments_.size(); ++k)
    attachments_[k] =
        frame.at + formation.offsets[k] + turned(p_.scenario->net->attachments[k].at, frame.forward);
}

Vec2 FormationGround::middle(const Stand& frame, const Formation& formation) {
  hold(frame, formation);
  Vec2 sum;
  for (const Vec2 a : attachments_) sum += a;
  return sum / static_cast<double>(attachments_.size());
}

bool FormationGround::clear(const Stand& frame, const Formation& formation) {
  // What was in the way of the pose before is so here as often as not.
  const std::size_t count = p_.scenario->robots.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = i == 0 ? blocked_ : i <= blocked_ ? i - 1 : i;
    if (car_clear(k, frame, formation)) continue;
    blocked_ = k;
    return false;
  }
  hold(frame, formation);
  return p_.tall->clear(attachments_, kNetSlack * length_) && clear_below(formation);
}

bool FormationGround::car_clear(std::size_t k, const Stand& frame, const Formation& formation) {
  const double clearance = p_.scenario->margins.obstacle + kCarSlack * length_;
  const Vec2 at = frame.at + formation.offsets[k];
  // Most poses are far from everything, or plainly in it.
  const Disc& disc = discs_[k];
  const auto room = cars_.bounds(at + disc.ahead * frame.forward);
  if (room.lower >= disc.outer + clearance) return true;
  if (room.upper < disc.inner + clearance) return false;
  polygon_.clear();
  for (const Vec2 corner : p_.scenario->model_of(p_.scenario->robots[k]).footprint)
    polygon_.push_back(at + turned(corner, frame.forward));
  return p_.map->clear(polygon_, clearance);
}

// Whether the net, at attachments_, hangs above everything low that it is over.
bool FormationGround::clear_below(const Formation& formation) const {
  const geom::Box box = geom::bounding_box(attachments_);
  for (const LowPiece& low : p_.low) {
    if (low.height <= formation.lowest || !box.overlaps(low.shape.box())) continue;
    if (geom::distance_up_to(attachments_, low.shape.core, low.shape.radius + 1.0) < low.shape.radius)
      return false;
  }
  return true;
}

// The disc lies in the middle of the net, as large as the narrowest polygon leaves room for.
void FormationGround::find_ways(std::span<const Formation> shapes) {
  double radius = std::numeric_limits<double>::infinity();
  for (const Formation& shape : shapes) {
    const Vec2 center = middle(stand_at(p_.start), shape);
    for (std::size_t i = 0; i < attachments_.size(); ++i) {
      const Vec2 a = attachments_[i], e = attachments_[(i + 1) % attachments_.size()] - a;
      radius = std::min(radius, geom::cross(e, center - a) / geom::norm(e));
    }
  }
  radius = std::max(0.8 * radius, 0.2 * length_);
  fields_.clear();
  tall_ = std::make_unique<PointDistances>(*p_.tall, 0.7 * radius, 4.0 * radius);
  const DiscWay way{.distances = tall_.get(), .radius = radius};
  // Asked about mostly on the way from the place before.
  Vec2 from = middle(stand_at(p_.start), shapes.front());
  const auto add = [&](Vec2 place) {
    fields_.push_back(std::make_unique<CostToGo>(way, place));
    fields_.back()->focus(std::exchange(from, place));
  };
  for (const Rendezvous& meeting : p_.meetings) add(meeting.point);
  if (p_.goal) add(p_.goal->center);
}

double FormationGround::to(std::size_t place, Vec2 point, bool field) {
  const Vec2 target = place == p_.meetings.size() ? p_.goal->center : p_.meetings[place].point;
  const double straight = geom::norm(point - target);
  return field ? std::max(straight, (*fields_[place])(point)) : straight;
}

}  // namespace seine::search
