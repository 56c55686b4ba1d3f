#include "seine/baseline/letter/robot_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "seine/baseline/letter/time_map.hpp"
#include "seine/traj/minco.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Vec2;
using Boundary = std::array<double, traj::UniformMinco::kMaxPieces + 5>;

constexpr std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

void CurveGradient::clear() {
  std::ranges::fill(coefficients, 0.0);
  std::ranges::fill(durations, 0.0);
}

void CurveGradient::add(const CurveGradient& other) {
  for (std::size_t i = 0; i < coefficients.size(); ++i) coefficients[i] += other.coefficients[i];
  for (std::size_t i = 0; i < durations.size(); ++i) durations[i] += other.durations[i];
}

RobotCurve::RobotCurve(const RobotTask& task) : stand_(task.start) {
  const auto variable = [this](std::initializer_list<double> values) {
    const int first = variables_;
    start_.insert(start_.end(), values);
    variables_ = static_cast<int>(start_.size());
    return first;
  };
  int coefficients = 0;
  for (std::size_t i = 0; i < task.segments.size(); ++i) {
    const SegmentTask& guess = task.segments[i];
    Segment s{.gear = guess.gear,
              .pieces = guess.pieces(),
              .coefficients = coefficients,
              .waypoints = variables_,
              .start_speed = guess.start_speed,
              .end_speed = guess.end_speed};
    coefficients += 12 * s.pieces;
    for (int j = 1; j < s.pieces; ++j) variable({guess.points[index(j)].x, guess.points[index(j)].y});
    s.tau = variable({tau_of(guess.piece_duration)});
    s.from = {guess.points.front().x, guess.points.front().y, guess.start_heading};
    s.to = {guess.points.back().x, guess.points.back().y, guess.end_heading};
    if (i > 0) s.from_variable = segments_.back().to_variable;
    const bool last = i + 1 == task.segments.size();
    s.to_heading = !last && task.free_cusps;
    if (s.to_heading)
      s.to_variable = variable({s.to.x, s.to.y, s.to.heading});
    else if (last && task.free_end)
      s.to_variable = variable({s.to.x, s.to.y});
    segments_.push_back(s);
  }
  coefficients_.resize(index(coefficients));
  polynomials_.resize(index(coefficients / 12));
}

void RobotCurve::initial(std::span<double> x) const {
  std::ranges::copy(start_, x.begin());
}

void RobotCurve::load(std::span<const double> x) {
  end_ = 0.0;
  for (Segment& s : segments_) {
    const auto pose_of = [&](int first, bool heading, geom::Pose2& pose) {
      if (first < 0) return;
      pose.x = x[index(first)], pose.y = x[index(first + 1)];
      if (heading) pose.heading = x[index(first + 2)];
    };
    pose_of(s.from_variable, true, s.from);
    pose_of(s.to_variable, s.to_heading, s.to);
    s.h = duration_of(x[index(s.tau)]);
    s.slope = duration_slope(x[index(s.tau)]);
    s.begin = end_;
    end_ += s.pieces * s.h;
    solve(s, x);
  }
}

// The rows of the boundary data are those of traj::UniformMinco: rests without acceleration, their speed in
// the segment's gear.
void RobotCurve::solve(const Segment& s, std::span<const double> x) {
  const auto& minco = traj::UniformMinco::with(s.pieces);
  const std::size_t end = index(s.pieces + 2);
  const Vec2 v0 = (s.gear * s.start_speed * s.h) * s.from.direction();
  const Vec2 v1 = (s.gear * s.end_speed * s.h) * s.to.direction();
  for (int axis = 0; axis < 2; ++axis) {
    const auto of = [axis](Vec2 v) { return axis == 0 ? v.x : v.y; };
    Boundary z;
    z[0] = of(s.from.position()), z[1] = of(v0), z[2] = 0.0;
    for (int j = 1; j < s.pieces; ++j) z[index(j + 2)] = x[index(s.waypoints + 2 * (j - 1) + axis)];
    z[end] = of(s.to.position()), z[end + 1] = of(v1), z[end + 2] = 0.0;
    const double* const row = &coefficients_[index(s.coefficients + 6 * axis * s.pieces)];
    minco.coefficients(z, &coefficients_[index(s.coefficients + 6 * axis * s.pieces)], s.pieces);
    for (int j = 0; j < s.pieces; ++j) {
      Polynomial& polynomial = polynomials_[index(s.coefficients / 12 + j)];
      for (int k = 0; k < 6; ++k) (axis == 0 ? polynomial.x : polynomial.y)[index(k)] = row[k * s.pieces + j];
    }
  }
}

Place RobotCurve::place(int segment, int piece, const Quadrature::Node& node) const {
  const Segment& s = at(segment);
  const Polynomial& c = polynomial(s, piece);
  Place place{.segment = segment, .piece = piece, .w = node.w};
  const double per = 1.0 / s.h;
  for (std::size_t k = 0; k < 6; ++k) {
    place.position += node.power[k] * Vec2{c.x[k], c.y[k]};
    place.velocity += node.first[k] * Vec2{c.x[k], c.y[k]};
    place.acceleration += node.second[k] * Vec2{c.x[k], c.y[k]};
  }
  place.velocity *= per;
  place.acceleration *= per * per;
  place.speed = geom::norm(place.velocity);
  place.direction = (s.gear / place.speed) * place.velocity;
  return place;
}

Place RobotCurve::locate(double t) const {
  if (segments_.empty())
    return {.position = stand_.position(), .direction = stand_.direction(), .arrived = true};
  int segment = 0;
  const int last = static_cast<int>(segments_.size()) - 1;
  while (segment < last && t >= at(segment + 1).begin) ++segment;
  const Segment& s = at(segment);
  const double per = 1.0 / s.h, rho = (t - s.begin) * per;
  Place place{.segment = segment, .piece = std::clamp(static_cast<int>(rho), 0, s.pieces - 1)};
  place.w = std::clamp(rho - place.piece, 0.0, 1.0);
  const Polynomial& c = polynomial(s, place.piece);
  const auto horner = [w = place.w](const std::array<double, 6>& a, double& value, double& slope) {
    value = a[0] + w * (a[1] + w * (a[2] + w * (a[3] + w * (a[4] + w * a[5]))));
    slope = a[1] + w * (2.0 * a[2] + w * (3.0 * a[3] + w * (4.0 * a[4] + w * 5.0 * a[5])));
  };
  horner(c.x, place.position.x, place.velocity.x);
  horner(c.y, place.position.y, place.velocity.y);
  place.velocity *= per;
  place.speed = geom::norm(place.velocity);
  place.direction = (s.gear / place.speed) * place.velocity;
  place.arrived = t >= end_;
  return place;
}

geom::Box RobotCurve::hull(int segment, int piece) const {
  // Bernstein coefficients of a quintic: b_i = Σ_{k ≤ i} C(i, k) / C(5, k) c_k.
  static constexpr double kShare[6][6] = {{1, 0, 0, 0, 0, 0},         {1, 0.2, 0, 0, 0, 0},
                                          {1, 0.4, 0.1, 0, 0, 0},     {1, 0.6, 0.3, 0.1, 0, 0},
                                          {1, 0.8, 0.6, 0.4, 0.2, 0}, {1, 1, 1, 1, 1, 1}};
  const Polynomial& c = polynomial(at(segment), piece);
  std::array<Vec2, 6> control{};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t k = 0; k <= i; ++k) control[i] += kShare[i][k] * Vec2{c.x[k], c.y[k]};
  return geom::bounding_box(control);
}

double RobotCurve::jerk(double weight, CurveGradient& gradient) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& s = segments_[i];
    const double per = 1.0 / std::pow(s.h, 5);
    double energy = 0.0;
    for (int first = s.coefficients; first < s.coefficients + 12 * s.pieces; first += 6 * s.pieces)
      for (int j = 0; j < s.pieces; ++j) {
        std::array<double, 6> c;
        for (int k = 0; k < 6; ++k) c[index(k)] = coefficients_[index(first + k * s.pieces + j)];
        energy += traj::jerk_energy(c);
        const auto g = traj::jerk_energy_gradient(c);
        for (int k = 3; k < 6; ++k)
          gradient.coefficients[index(first + k * s.pieces + j)] += weight * per * g[index(k - 3)];
      }
    sum += per * energy;
    gradient.durations[i] -= weight * 5.0 * per / s.h * energy;
  }
  return sum;
}

CurveGradient RobotCurve::zero_gradient() const {
  return {std::vector<double>(coefficients_.size()), std::vector<double>(segments_.size())};
}

void RobotCurve::pull(const Place& place, const Quadrature::Node& node, Vec2 g_position, Vec2 g_velocity,
                      Vec2 g_acceleration, CurveGradient& gradient) const {
  const Segment& s = at(place.segment);
  const double per = 1.0 / s.h;
  const Vec2 g1 = per * g_velocity, g2 = (per * per) * g_acceleration;
  double* const c = &gradient.coefficients[index(s.coefficients + place.piece)];
  for (int k = 0; k < 6; ++k) {
    const Vec2 g = node.power[index(k)] * g_position + node.first[index(k)] * g1 + node.second[index(k)] * g2;
    c[k * s.pieces] += g.x;
    c[(6 + k) * s.pieces] += g.y;
  }
  gradient.durations[index(place.segment)] -=
      per * (geom::dot(g_velocity, place.velocity) + 2.0 * geom::dot(g_acceleration, place.acceleration));
}

double RobotCurve::pull_at_time(const Place& place, Vec2 g_position, Vec2 g_direction,
                                CurveGradient& gradient) const {
  if (segments_.empty()) return 0.0;
  const Vec2 g_velocity = (at(place.segment).gear / place.speed) *
                          (g_direction - geom::dot(g_direction, place.direction) * place.direction);
  const Quadrature::Node node = basis_at(place.w);
  pull(place, node, g_position, g_velocity, {}, gradient);
  if (place.arrived) return 0.0;
  const Vec2 acceleration = this->place(place.segment, place.piece, node).acceleration;
  const double g_time = geom::dot(g_position, place.velocity) + geom::dot(g_velocity, acceleration);
  // At a fixed time longer pieces mean an earlier parameter.
  pull_time(place.segment, place.piece + place.w, -g_time, gradient);
  return g_time;
}

void RobotCurve::pull_time(int segment, double pieces_before, double g_time, CurveGradient& gradient) const {
  for (int i = 0; i < segment; ++i) gradient.durations[index(i)] += g_time * at(i).pieces;
  gradient.durations[index(segment)] += g_time * pieces_before;
}

void RobotCurve::gradient(const CurveGradient& of_curve, std::span<double> g) const {
  std::ranges::fill(g, 0.0);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& s = segments_[i];
    const auto& minco = traj::UniformMinco::with(s.pieces);
    const std::size_t end = index(s.pieces + 2);
    double g_h = of_curve.durations[i];
    std::array<Boundary, 2> z{};
    for (int axis = 0; axis < 2; ++axis) {
      Boundary& g_z = z[index(axis)];
      minco.add_adjoint(&of_curve.coefficients[index(s.coefficients + 6 * axis * s.pieces)], s.pieces, g_z);
      for (int j = 1; j < s.pieces; ++j) g[index(s.waypoints + 2 * (j - 1) + axis)] += g_z[index(j + 2)];
    }
    const auto rest = [&](std::size_t row, const geom::Pose2& pose, double speed, int first, bool heading) {
      const Vec2 g_p{z[0][row], z[1][row]}, g_v{z[0][row + 1], z[1][row + 1]};
      const Vec2 d = pose.direction();
      g_h += s.gear * speed * geom::dot(g_v, d);
      if (first < 0) return;
      g[index(first)] += g_p.x, g[index(first + 1)] += g_p.y;
      if (heading) g[index(first + 2)] += s.gear * speed * s.h * geom::dot(g_v, geom::left_normal(d));
    };
    rest(0, s.from, s.start_speed, s.from_variable, true);
    rest(end, s.to, s.end_speed, s.to_variable, s.to_heading);
    g[index(s.tau)] = g_h * s.slope;
  }
}

traj::RobotTrajectory RobotCurve::trajectory() const {
  if (segments_.empty()) return traj::RobotTrajectory::standing(stand_);
  traj::RobotTrajectory result;
  for (const Segment& s : segments_) {
    traj::Segment segment{.gear = s.gear, .piece_duration = s.h};
    for (int j = 0; j < s.pieces; ++j) {
      const Polynomial& c = polynomial(s, j);
      segment.curve.push_back({c.x, c.y});
      segment.progress.push_back({static_cast<double>(j), 1.0, 0.0, 0.0, 0.0, 0.0});
    }
    result.segments.push_back(std::move(segment));
  }
  return result;
}

}  // namespace seine::baseline::letter
