#pragma once

#include <array>
#include <span>
#include <vector>

#include "seine/baseline/letter/quadrature.hpp"
#include "seine/baseline/letter/robot_task.hpp"
#include "seine/geom/box.hpp"
#include "seine/traj/trajectory.hpp"

namespace seine::baseline::letter {

/// A robot's flat output at one instant.
struct Place {
  int segment = 0, piece = 0;
  double w = 0.0;  ///< in the piece
  geom::Vec2 position, velocity;
  geom::Vec2 acceleration;  ///< zero where only the pose is asked for
  geom::Vec2 direction;     ///< unit heading, η σ̇ / |σ̇|
  double speed = 0.0;       ///< |σ̇|, m/s
  bool arrived = false;     ///< stands at its end: nothing depends on the time
};

/// ∂J/∂ of a robot's coefficients and piece durations.
struct CurveGradient {
  std::vector<double> coefficients;  ///< as RobotCurve keeps them
  std::vector<double> durations;     ///< of the pieces of each segment
  void clear();
  void add(const CurveGradient& other);
};

/// The letter's trajectory of one robot: the flat output as piecewise quintics in time, minimum jerk through
/// its waypoints (MINCO, s = 3), pieces of one duration within a segment [Wang22], and the chain rule between
/// the variables (waypoints, cusp poses, final position, virtual times τ) and the coefficients. A robot that
/// stands has no segments and no variables.
class RobotCurve {
 public:
  explicit RobotCurve(const RobotTask& task);

  int variables() const { return variables_; }
  void initial(std::span<double> x) const;
  void load(std::span<const double> x);

  std::size_t segments() const { return segments_.size(); }
  int pieces(int segment) const { return at(segment).pieces; }
  int gear(int segment) const { return at(segment).gear; }
  double piece_duration(int segment) const { return at(segment).h; }
  double begin(int segment, int piece) const { return at(segment).begin + piece * at(segment).h; }
  double duration() const { return end_; }
  Place place(int segment, int piece, const Quadrature::Node& node) const;
  /// The pose at time t of the common clock; beyond the end it stands there. Never before 0.
  Place locate(double t) const;
  /// Contains the positions of a piece.
  geom::Box hull(int segment, int piece) const;
  /// ∫ |σ⃛|² dt, and `weight` times its gradient into `gradient`.
  double jerk(double weight, CurveGradient& gradient) const;

  CurveGradient zero_gradient() const;
  /// Adds what ∂J/∂(position, velocity, acceleration) at a place means for the coefficients and, at a fixed
  /// parameter w, for the piece's duration.
  void pull(const Place& place, const Quadrature::Node& node, geom::Vec2 g_position, geom::Vec2 g_velocity,
            geom::Vec2 g_acceleration, CurveGradient& gradient) const;
  /// The same for ∂J/∂(position, heading) at a fixed time; returns ∂J/∂t.
  double pull_at_time(const Place& place, geom::Vec2 g_position, geom::Vec2 g_direction,
                      CurveGradient& gradient) const;
  /// Adds ∂J/∂t of the instant at parameter w of a piece.
  void pull_time(int segment, double pieces_before, double g_time, CurveGradient& gradient) const;
  /// ∂J/∂variables from ∂J/∂(coefficients, durations); `g` is overwritten.
  void gradient(const CurveGradient& of_curve, std::span<double> g) const;

  traj::RobotTrajectory trajectory() const;

 private:
  struct Segment {
    int gear, pieces;
    int coefficients;             // first of 12 · pieces: six rows of x, six of y, a column a piece
    int waypoints, tau;           // first variable
    double h = 1.0, slope = 1.0;  // s, and dh/dτ
    double begin = 0.0;
    double start_speed, end_speed;
    geom::Pose2 from, to;
    int from_variable = -1, to_variable = -1;  // x, y (and heading at a cusp); −1: fixed
    bool to_heading = false;                   // the end's heading is a variable too
  };
  const Segment& at(int segment) const { return segments_[static_cast<std::size_t>(segment)]; }
  void solve(const Segment& segment, std::span<const double> x);
  /// The coefficients of one piece side by side.
  struct Polynomial {
    std::array<double, 6> x, y;
  };
  const Polynomial& polynomial(const Segment& s, int piece) const {
    return polynomials_[static_cast<std::size_t>(s.coefficients / 12 + piece)];
  }

  geom::Pose2 stand_;  // where a robot without segments stands
  std::vector<Segment> segments_;
  std::vector<double> start_;  // values of the variables as the guess has them
  std::vector<double> coefficients_;
  std::vector<Polynomial> polynomials_;
  int variables_ = 0;
  double end_ = 0.0;
};

}  // namespace seine::baseline::letter
