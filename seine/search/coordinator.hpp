#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/search/speed_lattice.hpp"
#include "seine/search/traffic.hpp"
#include "seine/search/velocity.hpp"
#include "seine/world/scenario.hpp"

namespace seine::search {

/// One path a robot may take, ready for velocity planning.
struct Way {
  SpeedLattice lattice;
  double alone =
      0.0;  ///< s, arrival if nobody else were there; until that is looked for, a lower bound of it
  std::vector<int> reach;    ///< per tick, furthest unit that can be reached
  VelocityPlan unhindered;   ///< when nobody is in its way; not found: not looked for yet
  std::uint32_t serial = 0;  ///< distinct for all ways and placements
};

using WayPtr = std::shared_ptr<const Way>;

/// A robot's motion in the team: which way, when. Shared between team states, never changed.
struct Placement {
  WayPtr way;  ///< null: its motion was fixed by the caller
  std::vector<ProfileKnot> profile;
  double arrival = 0.0;            ///< s
  std::vector<MovingBody> bodies;  ///< one for each clock of the team
  std::uint32_t serial = 0;
};

/// Who is where: null for robots that have no motion yet.
using TeamState = std::vector<std::shared_ptr<const Placement>>;

/// Memory of the coordinator's questions: what is taken on a way by a placement is looked up again and again.
struct CoordinatorWorkspace {
  VelocityWorkspace velocity;
  std::unordered_map<std::uint64_t, std::vector<Mark>> marks;  ///< by (way, placement)
  std::vector<std::span<const Mark>> taken;
};

/// The robots of a scenario, their ways, and the one question everything is made of: when can this robot go,
/// given what the others do? Const calls are safe from many threads at once, each with its own workspace.
class Coordinator {
 public:
  /// @param extra_clearance m, on top of the scenario's margin between robots where starts and goals leave
  /// that much room
  /// @param deadline  nothing is placed once it has passed
  Coordinator(const world::Scenario& scenario, const LatticeOptions& lattice, double extra_clearance,
              const Deadline& deadline = {});

  int robots() const { return static_cast<int>(cars_.size()); }
  /// A path made ready for the robot, except for what it can do alone; null when it cannot be driven.
  /// @param careful as SpeedLattice
  std::shared_ptr<Way> make_way(int robot, Path path, bool careful = false) const;
  /// Looks for the unhindered drive. False: there is none.
  bool finish_way(Way& way) const;
  /// Finished ways that `place` chooses from.
  void keep_way(int robot, WayPtr way) {
    cars_[static_cast<std::size_t>(robot)].ways.push_back(std::move(way));
  }
  void drop_way(int robot, int index) {
    auto& ways = cars_[static_cast<std::size_t>(robot)].ways;
    ways.erase(ways.begin() + index);
  }
  /// make, finish and keep; false when it cannot be driven alone.
  bool add_way(int robot, Path path);
  const std::vector<WayPtr>& ways(int robot) const { return car(robot).ways; }
  /// Smallest arrival over its ways when nobody else is there.
  double alone(int robot) const;
  /// The robot keeps this motion.
  void fix(int robot, const TimedPath& motion, TeamState& state);
  bool fixed(int robot) const { return cars_[static_cast<std::size_t>(robot)].fixed.has_value(); }

  /// The earliest arrival of the robot among the others of `state`, over all its ways; null when none works,
  /// or none arrives before `latest` (s).
  std::shared_ptr<const Placement> place(int robot, const TeamState& state, CoordinatorWorkspace& workspace,
                                         double latest = std::numeric_limits<double>::infinity()) const;
  /// The same with one way only.
  std::shared_ptr<const Placement> place_on(int robot, const WayPtr& way, const TeamState& state,
                                            CoordinatorWorkspace& workspace,
                                            double latest = std::numeric_limits<double>::infinity()) const;

  /// The same, not leaving the start before `delay` (s).
  std::shared_ptr<const Placement> place_after(double delay, int robot, const WayPtr& way,
                                               const TeamState& state, CoordinatorWorkspace& workspace) const;
  /// What moves around the robot: the moving obstacles and the others of `state`, on its own clock.
  std::vector<Traffic> traffic(int robot, const TeamState& state) const;
  const SpeedGrid& grid(int robot) const { return car(robot).kind->grid; }

  /// Robots that are in the way of the unhindered drive along `way`, in the order of the first conflict, and
  /// where that is.
  struct Conflict {
    int robot;  ///< −1: a moving obstacle
    int tick;
    int unit;
    int obstacle;  ///< index into Scenario::obstacles, −1 when it is a robot
  };
  std::vector<Conflict> conflicts(int robot, const Way& way, const TeamState& state,
                                  CoordinatorWorkspace& workspace) const;

  /// Whether somewhere on its first way the robot touches another one that stands at its start, or at its
  /// goal.
  bool touches_start(int robot, int other) const { return touches(robot, other, false); }
  bool touches_goal(int robot, int other) const { return touches(robot, other, true); }

  TimedPath motion(int robot, const Placement& placement) const;
  std::vector<geom::Vec2> footprint_at(int robot, const geom::Pose2& pose) const;
  const world::Scenario& scenario() const { return scenario_; }

 private:
  struct Kind {  // of car: one for each model
    SpeedGrid grid;
    SweptFootprint footprint;
    std::size_t clock;
  };
  struct Car {
    const Kind* kind;
    std::vector<WayPtr> ways;
    std::optional<TimedPath> fixed;
    std::vector<geom::Vec2> at_start, at_goal;
  };
  const Car& car(int robot) const { return cars_[static_cast<std::size_t>(robot)]; }
  double clearance(int a, int b) const;
  bool touches(int robot, int other, bool goal) const;
  std::vector<MovingBody> bodies_of(const Path& path, std::span<const ProfileKnot> profile,
                                    const Kind& kind) const;
  std::span<const Mark> taken(int robot, const Way& way, int other, const TeamState& state,
                              CoordinatorWorkspace& workspace) const;
  VelocityPlan plan_on(int robot, const Way& way, const TeamState& state, CoordinatorWorkspace& workspace,
                       double latest, double delay = 0.0) const;
  std::shared_ptr<const Placement> placement(int robot, const WayPtr& way, VelocityPlan plan) const;

  const world::Scenario& scenario_;
  double extra_clearance_;
  Deadline deadline_;
  std::vector<Kind> kinds_;
  std::vector<double> clocks_;  // s, the distinct ticks
  std::vector<Car> cars_;
  std::vector<std::vector<MovingBody>> obstacles_;  // by clock
  std::vector<int> part_of_;                        // by part: index into Scenario::obstacles
  mutable std::atomic<std::uint32_t> serial_{0};
};

}  // namespace seine::search
