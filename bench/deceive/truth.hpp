#pragma once

#include <string>
#include <vector>

#include "bench/deceive/documented.hpp"
#include "seine/world/scenario.hpp"

// What is true of a plan: a dense look at the documented formula (documented.hpp), with distances of its own
// (shapes.hpp). Of Seine only plain data are used.
namespace seine::deceive {

/// What the look forgives: the stated tolerances of docs/certificate.md, each with a little room, since the
/// look is to find what is clearly wrong. Lengths count in car lengths, speeds in the car's fastest.
struct Grants {
  double limit = 3e-6;            ///< of a limit, at an instant
  double limit_floor = 3e-9;      ///< in units of the quantity
  double place = 1.05e-4;         ///< m, start and goal …
  double place_lengths = 1e-3;    ///< … but no more than this many lengths
  double heading = 1.05e-4;       ///< rad, start and goal
  double clearance = 2.1e-4;      ///< m below the margin …
  double clearance_lengths = 1e-3;  ///< … but no more than this many lengths
  double rest = 1.05e-3;            ///< m/s at rest, of the start speed, and against the gear …
  double rest_speeds = 1e-2;        ///< … but no more than this share of the fastest
  // Granted once a plan, by all joints together: beyond what the limit allows in any window of time (or of
  // distance).
  double slip_lengths = 2e-3;     ///< jumps of the position, and distance driven faster than the limit
  double turn = 3e-3;             ///< rad, turned more than the curvature allows
  double surge_speeds = 1e-2;     ///< of the fastest, speed gained beyond the acceleration allowed
  double steer = 1e-2;            ///< rad, turned by the front wheel beyond its rate
  double backing_lengths = 1e-2;  ///< distance driven against the gear
};

/// Something that is truly wrong with a plan.
struct Fault {
  const char* what = "";  ///< of the messages of the look: one address each
  int robot = -1, other = -1;
  double time = 0.0;   ///< s
  double value = 0.0;  ///< met …
  double limit = 0.0;  ///< … and allowed
  double ratio = 0.0;  ///< (value − limit) / granted: above 1 is a fault
};

/// The worst of each kind for each car, whether a fault or not: ratio ≤ 1 is none.
std::vector<Fault> look_at(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                           const Look& look = {}, const Grants& grants = {});

/// The largest ratio, at least 0; NaN counts as infinite.
double worst_ratio(const std::vector<Fault>& faults);
/// Those with a ratio above 1, a line each.
std::string describe(const std::vector<Fault>& faults);

/// Collects the worst of each kind.
class Ledger {
 public:
  explicit Ledger(int robot) : robot_(robot) {}
  void offer(const char* what, double time, double value, double limit, double granted, int other = -1);
  std::vector<Fault>& faults() { return faults_; }

 private:
  int robot_;
  std::vector<Fault> faults_;
};

// The parts of the look.

/// Limits, joints, windows, start, goal and rests of one car.
void look_at_drive(const world::Scenario& scenario, int robot, const traj::RobotTrajectory& way,
                   const std::vector<Sight>& track, const Grants& grants, Ledger& ledger);
/// Distances to everything that is not a car, at each of the times.
void look_at_ground(const world::Scenario& scenario, int robot, const traj::RobotTrajectory& way,
                    const std::vector<double>& times, const Grants& grants, Ledger& ledger);
/// Distances between two cars.
void look_at_pair(const world::Scenario& scenario, int a, int b, const traj::TeamTrajectory& plan,
                  const std::vector<double>& times, const Grants& grants, Ledger& ledger);
/// Size and shape of the net.
void look_at_net(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                 const std::vector<double>& times, const Grants& grants, Ledger& ledger);

}  // namespace seine::deceive
