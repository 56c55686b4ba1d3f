#pragma once

#include <span>
#include <vector>

#include "seine/traj/trajectory.hpp"
#include "seine/trajopt/kernels.hpp"
#include "seine/trajopt/robot_task.hpp"
#include "seine/trajopt/settings.hpp"

namespace seine::trajopt {

/// A time of the common clock on a car's own: the same for all cars that share one timing.
struct Moment {
  double wt = 0.0, rho = 0.0;       ///< within the progress piece; in pieces since the segment began
  int segment = 0, time_piece = 0;  ///< pieces counted over all segments
  bool resting = false;
};

/// A car's pose at one tick of the common clock, with what the chain rule needs; and ∂J/∂(position,
/// direction), filled in by the pair terms.
struct ClockState {
  geom::Vec2 position, direction;  ///< rear axle; unit heading of the body
  geom::Vec2 g_position, g_direction;
  geom::Vec2 d1, d2;       ///< p', p'' with respect to u
  double inverse_m = 1.0;  ///< 1/|p'|
  double w = 0.0;          ///< within the curve's piece
  double u1 = 0.0;         ///< u̇; 0 at rest
  int piece = 0;           ///< counted over all segments
  Moment moment;
};

/// What repair rounds ask of a car whose limits were missed.
struct Demand {
  double penalty_scale = 1.0;
  double tighten = 0.0;  ///< on top of Settings::tighten
  double least_speed =
      0.0;  ///< m/s: that a moving car should have, where going backwards has to be ruled out
};

/// One car in the two-layer form (docs/trajectory.md): its variables, its own cost and limits, its pose on
/// the common clock, and the chain rule back to the variables. Knows nothing of other cars. Everything inside
/// is in `Units`.
///
/// Variables, segment after segment: interior knots (x, y), interior progress, log l, log h, log wait (only
/// where the guess waits); then a pose and a curvature (x, y, θ, κ/κ_max) for each rest between segments;
/// curvature at start and goal; the acceleration magnitude at each rest (logarithm; at a moving start the
/// acceleration itself). Positions are scaled so that a unit step bends the curve about as much on a short
/// piece as on a long one: without that a manoeuvre of a few centimetres stalls the whole problem.
class RobotProblem {
 public:
  RobotProblem(const RobotTask& task, const Units& units, const Settings& settings,
               const Demand& demand = {});

  int variables() const { return variables_; }
  /// Which of them are about time: progress, durations, waits, accelerations at rests; in one order for all
  /// cars.
  std::vector<int> timing() const;
  void initial(std::span<double> x) const;

  /// Takes x and evaluates the curve and the progress; must come before everything below.
  void load(std::span<const double> point);
  /// Own cost with the hinges' knee as given; keeps the gradient inside.
  double evaluate(double knee);
  /// Time t (units) of the common clock; before the start and after arrival the car stands still.
  Moment moment(double t) const;
  /// Its pose then.
  void locate(const Moment& moment, ClockState& state) const;
  /// Adds the pull-back of state.g_position and state.g_direction to the gradient kept inside.
  void pull_back(const ClockState& state);
  /// ∂J/∂x, all of it.
  void gradient(std::span<double> g);

  double arrival() const { return arrival_; }  ///< units
  traj::RobotTrajectory trajectory() const;    ///< SI

 private:
  struct Segment {
    int gear, pieces, time_pieces;
    int piece_begin, time_begin;            // into the coefficient arrays
    int knots, progress, length, duration;  // variable indices
    int wait;  // variable index, −1 when it does not wait, or as long as `held`
    double held;
    double speed_limit;
    // Current values.
    double l, h, start;  // start: when it begins to move
    // Gradients.
    double g_l, g_h, g_start;
  };
  struct Rest {
    geom::Pose2 pose;  // guess, or given
    double curvature;  // κ/κ_max, guess
    double acceleration;
    int pose_variable;  // −1 when given
    int curvature_variable;
    int acceleration_variable;
    // Current values.
    geom::Pose2 now;
    double kappa, alpha;
    // Gradients.
    double g_x, g_y, g_heading, g_kappa, g_alpha;
  };

  void lay_out(const RobotTask& task, const Units& units);
  void set_scale();
  void load_segment(std::size_t index, std::span<const double> x);
  double limits(double knee);
  double corridor_cost(int piece, const Segment& segment, CurveLanes& lanes, double knee) const;
  double planes_cost(std::size_t sample, geom::Vec2 position, geom::Vec2 direction, double knee,
                     geom::Vec2& g_position, geom::Vec2& g_direction) const;
  double steering_cost(const Segment& segment, double knee, double& g_h);
  double smoothness();
  double rest_cost(double knee);
  double end_cost(double knee);
  void pull_segment(std::size_t index, std::span<double> g);
  bool moving_start() const { return start_speed_ != 0.0; }

  Settings settings_;
  Units units_;
  vehicle::Model model_;               // limits in units
  std::vector<geom::Vec2> footprint_;  // units
  double reach_ = 0.0, kappa_max_ = 1.0, kappa_unit_ = 1.0, start_speed_ = 0.0, least_speed_ = 0.0,
         sample_weight_ = 0.0, curve_weight_ = 0.0;
  std::vector<SegmentGuess> guess_;  // units
  std::vector<Segment> segments_;
  std::vector<Rest> rests_;        // segments + 1
  corridor::Corridor corridor_;    // units
  std::vector<double> scale_, x_;  // of each variable; the present point, scale taken out
  int variables_ = 0, pieces_ = 0, time_pieces_ = 0;
  double arrival_ = 0.0;

  std::vector<double> cx_, cy_, cu_, gcx_, gcy_, gcu_;  // coefficient-major, stride pieces_ / time_pieces_
};

}  // namespace seine::trajopt
