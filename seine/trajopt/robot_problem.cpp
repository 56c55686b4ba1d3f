#include "seine/trajopt/robot_problem.hpp"

#include <algorithm>
#include <cmath>

#include "seine/traj/minco.hpp"

namespace seine::trajopt {
namespace {

using geom::Vec2;

// A wait is a variable on a logarithm; below this (in units) it is as good as none.
constexpr double kShortestWait = 1e-3;

vehicle::Model scaled(vehicle::Model model, const Units& units, double tighten) {
  const double speed = units.time / units.length, acceleration = speed * units.time, keep = 1.0 - tighten;
  for (Vec2& corner : model.footprint) corner *= 1.0 / units.length;
  model.wheelbase /= units.length;
  model.limits.speed *= speed * keep;
  model.limits.reverse_speed *= speed * keep;
  model.limits.acceleration *= acceleration * keep;
  model.limits.lateral_acceleration *= acceleration * keep;
  model.limits.steering_rate *= units.time * keep;
  return model;
}

SegmentGuess scaled(SegmentGuess guess, const Units& units) {
  guess.wait /= units.time;
  guess.duration /= units.time;
  guess.length /= units.length;
  for (Vec2& p : guess.points) p *= 1.0 / units.length;
  for (double& s : guess.progress) s /= units.length;
  guess.start_curvature *= units.length;
  guess.end_curvature *= units.length;
  const double acceleration = units.time * units.time / units.length;
  guess.start_acceleration *= acceleration;
  guess.end_deceleration *= acceleration;
  return guess;
}

geom::Pose2 scaled(geom::Pose2 pose, const Units& units) {
  return {pose.x / units.length, pose.y / units.length, pose.heading};
}

}  // namespace

RobotProblem::RobotProblem(const RobotTask& task, const Units& units, const Settings& settings,
                           const Demand& demand)
    : settings_(settings),
      units_(units),
      model_(scaled(task.model, units, settings.tighten + demand.tighten)) {
  footprint_ = model_.footprint;
  reach_ = model_.reach();
  kappa_unit_ = task.model.max_curvature() * units.length;
  kappa_max_ = kappa_unit_ * (1.0 - settings.tighten - demand.tighten);
  start_speed_ = std::abs(task.start_speed) * units.time / units.length;
  least_speed_ = demand.least_speed * units.time / units.length;
  for (const SegmentGuess& guess : task.segments) guess_.push_back(scaled(guess, units));
  corridor_ = task.corridor;
  for (double& b : corridor_.b) b /= units.length;
  lay_out(task, units);
  set_scale();
  double travel = 0.0;
  for (const SegmentGuess& guess : guess_) travel += guess.duration;
  sample_weight_ = settings.penalty * demand.penalty_scale * travel / (kTimeLanes * time_pieces_);
  curve_weight_ = settings.penalty * demand.penalty_scale * travel / (kCurveLanes * pieces_);
  for (auto* c : {&cx_, &cy_, &gcx_, &gcy_}) c->assign(static_cast<std::size_t>(6 * pieces_), 0.0);
  for (auto* c : {&cu_, &gcu_}) c->assign(static_cast<std::size_t>(6 * time_pieces_), 0.0);
}

void RobotProblem::lay_out(const RobotTask& task, const Units& units) {
  const int count = static_cast<int>(guess_.size());
  for (const SegmentGuess& guess : guess_) {
    Segment s{};
    s.gear = guess.gear, s.pieces = guess.pieces(), s.time_pieces = guess.time_pieces();
    s.piece_begin = pieces_, s.time_begin = time_pieces_;
    pieces_ += s.pieces, time_pieces_ += s.time_pieces;
    s.knots = variables_, variables_ += 2 * (s.pieces - 1);
    s.progress = variables_, variables_ += s.time_pieces - 1;
    s.length = variables_++;
    s.duration = variables_++;
    s.held = task.fixed_waits ? guess.wait : 0.0;
    s.wait = guess.wait > kShortestWait && !task.fixed_waits ? variables_++ : -1;
    s.speed_limit = guess.gear > 0 ? model_.limits.speed : model_.limits.reverse_speed;
    segments_.push_back(s);
  }
  for (int r = 0; r <= count; ++r) {
    Rest rest{};
    const auto before = static_cast<std::size_t>(std::max(r - 1, 0)),
               after = static_cast<std::size_t>(std::min(r, count - 1));
    const bool given = r == 0 || (r == count ? task.goal.has_value() : task.fixed_cusps);
    if (r == 0) {
      rest.pose = scaled(task.start, units);
      rest.curvature = guess_[0].start_curvature;
      rest.acceleration = guess_[0].start_acceleration;
    } else if (r == count) {
      const SegmentGuess& last = guess_[before];
      const geom::Pose2 end{last.points.back().x, last.points.back().y, last.end_heading};
      rest.pose = given ? scaled(*task.goal, units) : end;
      rest.curvature = guess_[before].end_curvature;
      rest.acceleration = guess_[before].end_deceleration;
    } else {
      rest.pose = {guess_[after].points.front().x, guess_[after].points.front().y,
                   guess_[after].start_heading};
      rest.curvature = 0.5 * (guess_[before].end_curvature + guess_[after].start_curvature);
      rest.acceleration = std::sqrt(guess_[before].end_deceleration * guess_[after].start_acceleration);
    }
    rest.curvature = std::clamp(rest.curvature / kappa_unit_, -0.9, 0.9);
    rest.pose_variable = given ? -1 : variables_;
    if (!given) variables_ += 3;
    rest.curvature_variable = variables_++;
    rest.acceleration_variable = variables_++;
    rests_.push_back(rest);
  }
}

std::vector<int> RobotProblem::timing() const {
  std::vector<int> indices;
  for (const Segment& s : segments_) {
    for (int j = 0; j < s.time_pieces - 1; ++j) indices.push_back(s.progress + j);
    indices.push_back(s.duration);
    if (s.wait >= 0) indices.push_back(s.wait);
  }
  for (const Rest& rest : rests_) indices.push_back(rest.acceleration_variable);
  return indices;
}

// Moving a knot by δ changes the curvature by about δ/l², turning a rest by δ changes it by δ/l.
void RobotProblem::set_scale() {
  scale_.assign(static_cast<std::size_t>(variables_), 1.0);
  x_.assign(static_cast<std::size_t>(variables_), 0.0);
  const auto piece_length = [&](std::size_t i) { return guess_[i].length / segments_[i].pieces; };
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const double l = piece_length(i), scale = std::min(1.0, l * l * kappa_unit_);
    for (int j = 0; j < 2 * (segments_[i].pieces - 1); ++j)
      scale_[static_cast<std::size_t>(segments_[i].knots + j)] = scale;
    scale_[static_cast<std::size_t>(segments_[i].duration)] = settings_.duration_scale;
  }
  for (std::size_t r = 0; r < rests_.size(); ++r) {
    if (rests_[r].pose_variable < 0) continue;
    const double l = std::min(piece_length(r - 1), piece_length(std::min(r, segments_.size() - 1)));
    const auto at = static_cast<std::size_t>(rests_[r].pose_variable);
    scale_[at] = scale_[at + 1] = std::min(1.0, l * l * kappa_unit_);
    scale_[at + 2] = std::min(1.0, l * kappa_unit_);
  }
}

void RobotProblem::initial(std::span<double> x) const {
  const auto at = [&](int index) -> double& { return x[static_cast<std::size_t>(index)]; };
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& s = segments_[i];
    const SegmentGuess& guess = guess_[i];
    const double l = guess.length / s.pieces;
    for (int j = 1; j < s.pieces; ++j) {
      at(s.knots + 2 * (j - 1)) = guess.points[static_cast<std::size_t>(j)].x;
      at(s.knots + 2 * (j - 1) + 1) = guess.points[static_cast<std::size_t>(j)].y;
    }
    for (int j = 1; j < s.time_pieces; ++j)
      at(s.progress + j - 1) = guess.progress[static_cast<std::size_t>(j)] / l;
    at(s.length) = std::log(l);
    at(s.duration) = std::log(guess.duration / s.time_pieces);
    if (s.wait >= 0) at(s.wait) = std::log(guess.wait);
  }
  for (std::size_t r = 0; r < rests_.size(); ++r) {
    const Rest& rest = rests_[r];
    if (rest.pose_variable >= 0) {
      at(rest.pose_variable) = rest.pose.x;
      at(rest.pose_variable + 1) = rest.pose.y;
      at(rest.pose_variable + 2) = rest.pose.heading;
    }
    at(rest.curvature_variable) = rest.curvature;
    at(rest.acceleration_variable) = r == 0 && moving_start() ? 0.0 : std::log(rest.acceleration);
  }
  for (std::size_t i = 0; i < scale_.size(); ++i) x[i] /= scale_[i];
}

void RobotProblem::load(std::span<const double> point) {
  for (std::size_t i = 0; i < scale_.size(); ++i) x_[i] = scale_[i] * point[i];
  const std::span<const double> x = x_;
  const auto at = [&](int index) { return x[static_cast<std::size_t>(index)]; };
  for (std::size_t r = 0; r < rests_.size(); ++r) {
    Rest& rest = rests_[r];
    rest.now = rest.pose;
    if (rest.pose_variable >= 0)
      rest.now = {at(rest.pose_variable), at(rest.pose_variable + 1), at(rest.pose_variable + 2)};
    rest.kappa = at(rest.curvature_variable) * kappa_unit_;
    const double a = at(rest.acceleration_variable);
    rest.alpha = r == 0 && moving_start() ? a : std::exp(a);
    rest.g_x = rest.g_y = rest.g_heading = rest.g_kappa = rest.g_alpha = 0.0;
  }
  arrival_ = 0.0;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    Segment& s = segments_[i];
    s.l = std::exp(at(s.length)), s.h = std::exp(at(s.duration));
    s.start = arrival_ + (s.wait >= 0 ? std::exp(at(s.wait)) : s.held);
    s.g_l = s.g_h = s.g_start = 0.0;
    arrival_ = s.start + s.h * s.time_pieces;
    load_segment(i, x);
  }
  for (auto* g : {&gcx_, &gcy_, &gcu_}) std::fill(g->begin(), g->end(), 0.0);
}

// Boundary rows of both splines: at a rest p' = η l d, p'' = κ l² n (κ of the front wheel: no η, so both
// sides of a cusp share it), u̇ = 0, and ü = ±α / l. The progress rows are in normalised time (times h, h²).
void RobotProblem::load_segment(std::size_t index, std::span<const double> x) {
  const Segment& s = segments_[index];
  const Rest &a = rests_[index], &b = rests_[index + 1];
  std::array<double, traj::UniformMinco::kMaxPieces + 5> z;
  const auto rows = static_cast<std::size_t>(s.pieces + 5);
  const auto end = static_cast<std::size_t>(s.pieces + 2);
  const double first = s.gear * s.l, second = s.l * s.l;
  const Vec2 d0 = a.now.direction(), d1 = b.now.direction();
  const auto curve = [&](double p0, double v0, double a0, double p1, double v1, double a1, int coordinate,
                         double* out) {
    z[0] = p0, z[1] = v0, z[2] = a0, z[end] = p1, z[end + 1] = v1, z[end + 2] = a1;
    for (int j = 1; j < s.pieces; ++j)
      z[static_cast<std::size_t>(j + 2)] = x[static_cast<std::size_t>(s.knots + 2 * (j - 1) + coordinate)];
    traj::UniformMinco::with(s.pieces).coefficients({z.data(), rows}, out + s.piece_begin, pieces_);
  };
  curve(a.now.x, first * d0.x, -a.kappa * second * d0.y, b.now.x, first * d1.x, -b.kappa * second * d1.y, 0,
        cx_.data());
  curve(a.now.y, first * d0.y, a.kappa * second * d0.x, b.now.y, first * d1.y, b.kappa * second * d1.x, 1,
        cy_.data());

  const auto t_end = static_cast<std::size_t>(s.time_pieces + 2);
  const double scale = s.h * s.h / s.l;
  z[0] = 0.0;
  z[1] = index == 0 ? start_speed_ * s.h / s.l : 0.0;
  z[2] = a.alpha * scale;
  for (int j = 1; j < s.time_pieces; ++j)
    z[static_cast<std::size_t>(j + 2)] = x[static_cast<std::size_t>(s.progress + j - 1)];
  z[t_end] = s.pieces, z[t_end + 1] = 0.0, z[t_end + 2] = -b.alpha * scale;
  traj::UniformMinco::with(s.time_pieces)
      .coefficients({z.data(), static_cast<std::size_t>(s.time_pieces + 5)}, cu_.data() + s.time_begin,
                    time_pieces_);
}

Moment RobotProblem::moment(double t) const {
  std::size_t index = segments_.size() - 1;
  while (index > 0 && t < segments_[index].start) {
    // Between two segments the car rests at the later one's start as well as at the earlier one's end; take
    // the earlier end.
    const Segment& before = segments_[index - 1];
    if (t >= before.start + before.h * before.time_pieces) {
      --index;
      break;
    }
    --index;
  }
  const Segment& s = segments_[index];
  // The clamp also sends a NaN from a wild trial step to the first piece.
  const double since = (t - s.start) / s.h;
  const double rho = since > 0.0 ? std::min(since, static_cast<double>(s.time_pieces)) : 0.0;
  const int tp = std::min(static_cast<int>(rho), s.time_pieces - 1);
  // Resting, nothing depends on time.
  const bool resting = t <= s.start || rho >= s.time_pieces;
  const bool rolling = index == 0 && moving_start() && t >= s.start && rho < s.time_pieces;
  return {.wt = rho - tp,
          .rho = rho,
          .segment = static_cast<int>(index),
          .time_piece = s.time_begin + tp,
          .resting = resting && !rolling};
}

void RobotProblem::locate(const Moment& moment, ClockState& state) const {
  const Segment& s = segments_[static_cast<std::size_t>(moment.segment)];
  const double* cu = cu_.data() + moment.time_piece;
  const int ts = time_pieces_;
  const double wt = moment.wt;
  const double u =
      cu[0] + wt * (cu[ts] + wt * (cu[2 * ts] + wt * (cu[3 * ts] + wt * (cu[4 * ts] + wt * cu[5 * ts]))));
  const double du =
      cu[ts] + wt * (2 * cu[2 * ts] + wt * (3 * cu[3 * ts] + wt * (4 * cu[4 * ts] + wt * 5 * cu[5 * ts])));
  // The clamp also sends a NaN from a wild trial step to the first piece.
  const int piece = u > 0.0 ? static_cast<int>(std::min(u, s.pieces - 1.0)) : 0;
  const double w = u - piece;
  const auto derivatives = [n = pieces_, w](const double* c, double& p, double& d1, double& d2) {
    const double c2 = c[2 * n], c3 = c[3 * n], c4 = c[4 * n], c5 = c[5 * n];
    p = c[0] + w * (c[n] + w * (c2 + w * (c3 + w * (c4 + w * c5))));
    d1 = c[n] + w * (2 * c2 + w * (3 * c3 + w * (4 * c4 + w * 5 * c5)));
    d2 = 2 * c2 + w * (6 * c3 + w * (12 * c4 + w * 20 * c5));
  };
  derivatives(cx_.data() + s.piece_begin + piece, state.position.x, state.d1.x, state.d2.x);
  derivatives(cy_.data() + s.piece_begin + piece, state.position.y, state.d1.y, state.d2.y);
  state.inverse_m = 1.0 / geom::norm(state.d1);
  state.direction = (s.gear * state.inverse_m) * state.d1;
  state.g_position = state.g_direction = {};
  state.w = w, state.piece = s.piece_begin + piece;
  state.u1 = moment.resting ? 0.0 : du / s.h;
  state.moment = moment;
}

traj::RobotTrajectory RobotProblem::trajectory() const {
  traj::RobotTrajectory result;
  double end = 0.0;
  for (const Segment& s : segments_) {
    traj::Segment out;
    out.gear = s.gear;
    out.wait = (s.start - end) * units_.time;
    out.piece_duration = s.h * units_.time;
    end = s.start + s.h * s.time_pieces;
    for (int j = 0; j < s.pieces; ++j) {
      std::array<traj::Quintic, 2> piece;
      for (std::size_t k = 0; k < 6; ++k) {
        const std::size_t from =
            k * static_cast<std::size_t>(pieces_) + static_cast<std::size_t>(s.piece_begin + j);
        piece[0][k] = cx_[from] * units_.length;
        piece[1][k] = cy_[from] * units_.length;
      }
      out.curve.push_back(piece);
    }
    for (int j = 0; j < s.time_pieces; ++j) {
      traj::Quintic piece;
      for (std::size_t k = 0; k < 6; ++k)
        piece[k] =
            cu_[k * static_cast<std::size_t>(time_pieces_) + static_cast<std::size_t>(s.time_begin + j)];
      out.progress.push_back(piece);
    }
    result.segments.push_back(std::move(out));
  }
  return result;
}

std::vector<geom::Pose2> sample_poses(const SegmentGuess& segment) {
  const int pieces = segment.pieces();
  const double l = segment.length / pieces;
  const Vec2 d0 = geom::unit(segment.start_heading), d1 = geom::unit(segment.end_heading);
  const double first = segment.gear * l, k0 = segment.start_curvature * l * l,
               k1 = segment.end_curvature * l * l;
  const auto& spline = traj::UniformMinco::with(pieces);
  std::vector<double> c(static_cast<std::size_t>(12 * pieces));
  for (int coordinate = 0; coordinate < 2; ++coordinate) {
    const auto of = [&](Vec2 v) { return coordinate == 0 ? v.x : v.y; };
    std::vector<double> z{of(segment.points.front()), first * of(d0), k0 * of(geom::left_normal(d0))};
    for (int j = 1; j < pieces; ++j) z.push_back(of(segment.points[static_cast<std::size_t>(j)]));
    z.insert(z.end(), {of(segment.points.back()), first * of(d1), k1 * of(geom::left_normal(d1))});
    spline.coefficients(z, c.data() + 6 * pieces * coordinate, pieces);
  }
  std::vector<geom::Pose2> poses;
  for (int j = 0; j < pieces; ++j)
    for (int lane = 0; lane < kCurveLanes; ++lane) {
      const double w = static_cast<double>(lane) / kCurveLanes;
      Vec2 p, d;
      for (int k = 5; k >= 0; --k) {
        const auto from = static_cast<std::size_t>(k * pieces + j);
        const Vec2 ck{c[from], c[from + static_cast<std::size_t>(6 * pieces)]};
        d = p + w * d;
        p = ck + w * p;
      }
      poses.push_back({p.x, p.y, std::atan2(segment.gear * d.y, segment.gear * d.x)});
    }
  return poses;
}

}  // namespace seine::trajopt
