#include "seine/search/blockers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/world/check_parts.hpp"

namespace seine::search {
namespace {

constexpr std::size_t kInFull = 3;  // cars that are explained
constexpr std::size_t kMost = 16;   // bodies that are tried one by one
constexpr int kPatience = 3000;     // expansions of one search
constexpr int kCorners = 12;        // of a disc

/// Something that will stand, or still stands, in the way.
struct Body {
  std::string what;  ///< "car1 stands at its goal"
  std::vector<std::vector<geom::Vec2>> footprints;
};

std::vector<geom::Vec2> placed(const std::vector<geom::Vec2>& polygon, const geom::Pose2& pose) {
  std::vector<geom::Vec2> result(polygon.size());
  geom::place(polygon, pose, result);
  return result;
}

Body at_rest(const world::Obstacle& obstacle, std::size_t index) {
  Body body{world::name_of(obstacle, index) + " has come to rest", {}};
  for (const geom::Convex& part : world::body_of(obstacle)) {
    std::vector<geom::Vec2> polygon = part.core;
    if (part.radius > 0.0) {  // a disc: a polygon inside it, so that no way is called closed that is open
      polygon.clear();
      for (int i = 0; i < kCorners; ++i)
        polygon.push_back(part.core.front() +
                          part.radius * geom::unit(2.0 * std::numbers::pi * i / kCorners));
    }
    body.footprints.push_back(placed(polygon, obstacle.motion.back().pose));
  }
  return body;
}

class Explanation {
 public:
  Explanation(const world::Scenario& scenario, const world::StaticMap& map, int robot,
              const Deadline& deadline)
      : scenario_(scenario),
        car_(scenario.robots[static_cast<std::size_t>(robot)]),
        planner_(map, scenario.model_of(car_)),
        deadline_(deadline) {
    for (std::size_t j = 0; j < scenario.robots.size(); ++j) {
      const world::Robot& other = scenario.robots[j];
      if (static_cast<int>(j) == robot || !other.goal) continue;
      const auto& footprint = scenario.model_of(other).footprint;
      const std::string name = world::name_of(other, j);
      ends_.push_back({name + " stands at its goal", {placed(footprint, *other.goal)}});
      starts_.push_back({name + " has not left its start", {placed(footprint, other.start)}});
    }
    for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
      if (!world::stands_still(scenario.obstacles[i])) ends_.push_back(at_rest(scenario.obstacles[i], i));
  }

  std::string text() {
    if (const std::string who = blockers(ends_); !who.empty())
      return car_.name + " finds no way to its goal once " + who;
    if (const std::string who = blockers(starts_); !who.empty())
      return car_.name + " finds no way to its goal while " + who;
    return car_.name + " has a way, but no time was found to drive it among what moves";
  }

 private:
  bool way_past(std::span<const std::vector<geom::Vec2>> parked) const {
    const world::Margins& margins = scenario_.margins;
    return planner_
        .plan(car_.start, *car_.goal,
              {.max_expansions = kPatience,
               .clearance = margins.obstacle,
               .parked = parked,
               .parked_clearance = std::min(margins.robot, margins.obstacle),
               .deadline = deadline_})
        .has_value();
  }

  /// Who of them closes the way alone, or that only all together do; empty when the way is open.
  std::string blockers(const std::vector<Body>& bodies) const {
    std::vector<std::vector<geom::Vec2>> all;
    for (const Body& body : bodies) all.insert(all.end(), body.footprints.begin(), body.footprints.end());
    if (all.empty() || deadline_.expired() || way_past(all) || deadline_.expired()) return "";
    std::string who;
    for (std::size_t i = 0; i < std::min(kMost, bodies.size()); ++i)
      if (!way_past(bodies[i].footprints) && !deadline_.expired())
        who += (who.empty() ? "" : " or ") + bodies[i].what;
    if (!who.empty() || deadline_.expired()) return who;
    return &bodies == &ends_ ? "all others have come to rest" : "all others stand at their starts";
  }

  const world::Scenario& scenario_;
  const world::Robot& car_;
  PathPlanner planner_;
  const Deadline& deadline_;
  std::vector<Body> ends_, starts_;
};

}  // namespace

std::string why_no_motion(const world::Scenario& scenario, const world::StaticMap& map,
                          std::span<const int> robots, const Deadline& deadline) {
  std::string all = "no motion found among the others: ";
  for (std::size_t i = 0; i < std::min(kInFull, robots.size()); ++i) {
    if (i > 0) all += "; ";
    all += Explanation(scenario, map, robots[i], deadline).text();
  }
  if (robots.size() > kInFull) all += "; and " + std::to_string(robots.size() - kInFull) + " more cars";
  return all;
}

}  // namespace seine::search
