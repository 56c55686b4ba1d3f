#pragma once

#include <string>
#include <vector>

#include "bench/deceive/documented.hpp"
#include "seine/world/scenario.hpp"

// What is true of a plan: a dense look at the documented formula (documented.hpp), with distances of its own
// (shapes.hpp). Of Seine only plain data are used.
namespace seine::deceive {

/// What the look forgives: the stated tolerances (docs/certificate.md#tolerances) with a twentieth more, for
/// what the look finds is real but for rounding. Lengths hold for cars from `short_car` on and shrink with
/// shorter ones; speeds are relative to a speed of the car.
struct Grants {
  double short_car = 0.25;    ///< m
  double limit = 2e-6;        ///< of a limit, at an instant
  double limit_floor = 2e-9;  ///< in units of the quantity
  double place = 1.05e-4;     ///< m, start and goal
  double heading = 1.05e-4;   ///< rad, start and goal
  double clearance = 2.1e-4;  ///< m below the margin
  double rest = 1.05e-3;      ///< relative: at rest, of the start speed, and against the gear
  double slip = 1.05e-5;      ///< m, all jumps of the position together
  double turn = 1.05e-4;      ///< rad, all jumps of the heading together
  double surge = 1.05e-3;     ///< relative, all jumps of the speed together
  double steer = 1.05e-3;     ///< of the largest curvature, all jumps of the curvature together
  double backing = 1.05e-4;   ///< m, driven against the gear in all
  /// What a whole window (of time, or of distance) may exceed its limits by, in what its jumps may.
  double window = 2.0;
};

/// The units of one car.
struct Scale {
  double size = 1.0;  ///< of lengths: at most 1
  double pace = 1.0;  ///< m/s: least of 1 m/s, its speed limits and √(a_max · length)
};
Scale scale_of(const vehicle::Model& model, const Grants& grants);

/// Something about a plan, and whether it is truly wrong.
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
