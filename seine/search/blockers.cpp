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

constexpr std::size_t kInFull = 2;  // cars that are explained
constexpr std::size_t kMost = 6;    // bodies that are tried one by one
constexpr int kPatience = 1500;     // expansions of one search
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
  Explanation(const world::Scenario& scenario, const world::StaticMap& map, const Deadline& deadline)
      : scenario_(scenario), deadline_(deadline) {
    for (const vehicle::Model& model : scenario.models) planners_.emplace_back(map, model);
  }

  std::string text(std::size_t robot) const {
    const std::string name = name_of(robot);
    std::vector<Body> ends, starts;
    for (std::size_t j = 0; j < scenario_.robots.size(); ++j) {
      if (j == robot || !scenario_.robots[j].goal) continue;
      ends.push_back(at_goal(j));
      starts.push_back(
          {name_of(j) + " has not left its start", {placed(footprint(j), scenario_.robots[j].start)}});
    }
    for (std::size_t i = 0; i < scenario_.obstacles.size(); ++i)
      if (!world::stands_still(scenario_.obstacles[i])) ends.push_back(at_rest(scenario_.obstacles[i], i));
    if (const std::string who = blockers(robot, ends, "all others have come to rest"); !who.empty())
      return name + " finds no way to its goal once " + who;
    if (const std::string who = blockers(robot, starts, "all others stand at their starts"); !who.empty())
      return name + " finds no way to its goal while " + who;
    // It may be the one that is in the way.
    for (std::size_t j = 0; j < std::min(kMost, scenario_.robots.size()); ++j)
      if (j != robot && scenario_.robots[j].goal && !way_past(j, at_goal(robot).footprints) &&
          !deadline_.expired())
        return name_of(j) + " finds no way to its goal once " + at_goal(robot).what;
    return name + " has a way, but no time was found to drive it among what moves";
  }

 private:
  std::string name_of(std::size_t robot) const { return world::name_of(scenario_.robots[robot], robot); }
  const std::vector<geom::Vec2>& footprint(std::size_t robot) const {
    return scenario_.model_of(scenario_.robots[robot]).footprint;
  }
  Body at_goal(std::size_t robot) const {
    return {name_of(robot) + " stands at its goal",
            {placed(footprint(robot), *scenario_.robots[robot].goal)}};
  }

  bool way_past(std::size_t robot, std::span<const std::vector<geom::Vec2>> parked) const {
    const world::Margins& margins = scenario_.margins;
    const world::Robot& car = scenario_.robots[robot];
    return planners_[static_cast<std::size_t>(car.model)]
        .plan(car.start, *car.goal,
              {.max_expansions = kPatience,
               .clearance = margins.obstacle,
               .parked = parked,
               .parked_clearance = std::min(margins.robot, margins.obstacle),
               .deadline = deadline_})
        .has_value();
  }

  /// Who of them closes the way alone, or that only `together` they do; empty when the way is open.
  std::string blockers(std::size_t robot, const std::vector<Body>& bodies, const char* together) const {
    std::vector<std::vector<geom::Vec2>> all;
    for (const Body& body : bodies) all.insert(all.end(), body.footprints.begin(), body.footprints.end());
    if (all.empty() || deadline_.expired() || way_past(robot, all) || deadline_.expired()) return "";
    std::string who;
    for (std::size_t i = 0; i < std::min(kMost, bodies.size()); ++i)
      if (!way_past(robot, bodies[i].footprints) && !deadline_.expired())
        who += (who.empty() ? "" : " or ") + bodies[i].what;
    return who.empty() && !deadline_.expired() ? together : who;
  }

  const world::Scenario& scenario_;
  const Deadline& deadline_;
  std::vector<PathPlanner> planners_;  // one for each model
};

}  // namespace

std::string why_no_motion(const world::Scenario& scenario, const world::StaticMap& map,
                          std::span<const int> robots, const Deadline& deadline) {
  std::string all = "no motion found among the others: ";
  const Explanation explanation(scenario, map, deadline);
  for (std::size_t i = 0; i < std::min(kInFull, robots.size()); ++i)
    all += (i > 0 ? "; " : "") + explanation.text(static_cast<std::size_t>(robots[i]));
  if (robots.size() > kInFull) all += "; and " + std::to_string(robots.size() - kInFull) + " more cars";
  return all;
}

}  // namespace seine::search
