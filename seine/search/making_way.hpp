#pragma once

#include <memory>
#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/search/point_distances.hpp"
#include "seine/search/refuge.hpp"
#include "seine/world/scenario.hpp"

namespace seine::search {

/// Ways of a car that let others pass: by a place where it stops and where it is in nobody's way. Paths only;
/// who waits when is for the velocity planning to find.
class MakingWay {
 public:
  struct Settings {
    double robot_clearance = 0.05;  ///< m
    Deadline deadline{};
  };
  /// @param planners one for each model of the scenario
  MakingWay(const world::Scenario& scenario, const world::StaticMap& map,
            std::span<const PathPlanner> planners, const Settings& settings);

  struct Other {
    int robot;
    Path way;  ///< its own
  };
  /// By places beside the car's own way (bays_beside).
  std::vector<Path> by_bays(int robot, const Path& way, const Other& other) const;
  /// By the nearest places anywhere that are off the ways of all of `others`.
  std::vector<Path> by_refuges(int robot, const Path& way, std::span<const Other> others);

 private:
  using Footprints = std::vector<std::vector<geom::Vec2>>;
  Footprints standing(std::span<const Other> others, bool at_goals) const;
  std::vector<Route> routes_to_refuges(int robot, const Lane& lane, const Footprints& parked);
  std::optional<Path> plan(int robot, const geom::Pose2& from, const geom::Pose2& to,
                           const Footprints& parked) const;

  const world::Scenario& scenario_;
  const world::StaticMap& map_;
  std::span<const PathPlanner> planners_;
  Settings settings_;
  std::vector<std::unique_ptr<PointDistances>> distances_;  // by model, made when first needed
};

}  // namespace seine::search
