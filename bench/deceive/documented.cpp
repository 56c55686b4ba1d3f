#include "bench/deceive/documented.hpp"

#include <algorithm>
#include <cmath>

namespace seine::deceive {
namespace {

using traj::Quintic;
using traj::Segment;

/// Σ k (k − 1) … (k − order + 1) c_k w^(k − order), from the highest power down
double polynomial(const Quintic& c, double w, int order) {
  static constexpr double kFalling[4][6] = {
      {1, 1, 1, 1, 1, 1}, {0, 1, 2, 3, 4, 5}, {0, 0, 2, 6, 12, 20}, {0, 0, 0, 6, 24, 60}};
  double sum = 0.0;
  for (int k = 5; k >= order; --k) sum = sum * w + kFalling[order][k] * c[static_cast<std::size_t>(k)];
  return sum;
}

int documented_piece(const Segment& segment, double u) {
  const double last = static_cast<double>(segment.curve.size()) - 1.0;
  return static_cast<int>(std::clamp(std::floor(u), 0.0, last));
}

double begin_of(const Segment& segment, std::size_t j) {
  return segment.piece_duration * static_cast<double>(j);
}

/// The sights of one progress piece, `begin` being when its segment begins to move.
class PieceTrack {
 public:
  PieceTrack(const Segment& segment, std::size_t j, double begin, std::vector<Sight>& sights)
      : segment_(segment), j_(j), begin_(begin), sights_(sights) {}

  void run(const Look& look) {
    double range = 0.0;
    for (std::size_t k = 1; k < 6; ++k) range += static_cast<double>(k) * std::abs(segment_.progress[j_][k]);
    const double count =
        std::min({std::ceil(std::max({look.hertz * segment_.piece_duration, look.per_piece * range,
                                      static_cast<double>(look.least)})),
                  2e5, std::max(2.0, static_cast<double>(look.most) - static_cast<double>(sights_.size()))});
    add(0.0, -1, true);
    double before = 0.0;
    for (double i = 1.0; i <= count; ++i) {
      const double w = i / count;
      // At its end the piece is followed to where it comes from: the next piece begins on the other side.
      pass_knots(before, i < count ? w : 1.0 - 1e-9);
      add(w, last_piece_, false);
      before = w;
    }
  }

 private:
  double u(double w) const { return progress(segment_, j_, w); }

  void add(double w, int piece, bool jump) {
    last_piece_ = piece < 0 ? documented_piece(segment_, u(w)) : piece;
    Sight here = sight(segment_, j_, w, last_piece_);
    here.t += begin_;
    here.jump = jump && !sights_.empty();
    sights_.push_back(here);
  }

  /// Both sides of each knot between two parameters; afterwards `last_piece_` is the piece at the second (at
  /// a knot itself: the one it comes from, the next sight has the other).
  void pass_knots(double from, double to) {
    for (int guard = 0; guard < 64; ++guard) {
      const int wanted = documented_piece(segment_, u(to));
      if (wanted == last_piece_) return;
      const int next = last_piece_ + (wanted > last_piece_ ? 1 : -1);
      const double knot = static_cast<double>(std::max(next, last_piece_));
      const bool up = next > last_piece_;
      double low = from, high = to;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((u(middle) < knot) == up ? low : high) = middle;
      }
      const double at = 0.5 * (low + high);
      add(at, last_piece_, false);
      add(at, next, true);
      from = at;
    }
    last_piece_ = documented_piece(segment_, u(to));
  }

  const Segment& segment_;
  std::size_t j_;
  double begin_;
  std::vector<Sight>& sights_;
  int last_piece_ = 0;
};

}  // namespace

double progress(const Segment& segment, std::size_t j, double w) {
  return polynomial(segment.progress[j], w, 0);
}

Sight sight(const Segment& segment, std::size_t j, double w, int piece) {
  const double h = segment.piece_duration, eta = segment.gear;
  const double u = progress(segment, j, w), u1 = polynomial(segment.progress[j], w, 1) / h,
               u2 = polynomial(segment.progress[j], w, 2) / (h * h);
  const int i = piece < 0 ? documented_piece(segment, u) : piece;
  const auto& curve = segment.curve[static_cast<std::size_t>(i)];
  const double local = u - i;
  double x[4], y[4];
  for (int k = 0; k < 4; ++k) {
    x[k] = polynomial(curve[0], local, k);
    y[k] = polynomial(curve[1], local, k);
  }
  const double m = std::hypot(x[1], y[1]), along = (x[1] * x[2] + y[1] * y[2]) / m;
  const double bend = (x[1] * y[2] - y[1] * x[2]) / (m * m * m);
  const double bend_by_u = (x[1] * y[3] - y[1] * x[3]) / (m * m * m) - 3.0 * bend * along / m;
  Sight s;
  s.t = begin_of(segment, j) + w * h;
  s.x = x[0], s.y = y[0];
  s.heading = std::atan2(eta * y[1], eta * x[1]);
  s.rate = m * u1;
  s.speed = eta * m * u1;
  s.acceleration = eta * (m * u2 + along * u1 * u1);
  s.curvature = eta * bend;
  s.curvature_rate = eta * bend_by_u * u1;
  s.lateral = s.curvature * s.speed * s.speed;
  s.tangent = m;
  return s;
}

geom::Pose2 pose_at(const traj::RobotTrajectory& way, double t) {
  if (way.segments.empty()) return way.stands.value_or(geom::Pose2{});
  for (std::size_t n = 0; n < way.segments.size(); ++n) {
    const Segment& segment = way.segments[n];
    t -= segment.wait;
    const double count = static_cast<double>(segment.progress.size());
    const double duration = segment.piece_duration * count;
    if (t <= duration || n + 1 == way.segments.size()) {
      const double local = std::clamp(t, 0.0, duration) / segment.piece_duration;
      const double j = std::min(std::floor(local), count - 1.0);
      const Sight s = sight(segment, static_cast<std::size_t>(j), local - j);
      return {s.x, s.y, s.heading};
    }
    t -= duration;
  }
  return {};
}

std::vector<Sight> track(const traj::RobotTrajectory& way, const Look& look) {
  std::vector<Sight> sights;
  double begin = 0.0;
  for (const Segment& segment : way.segments) {
    if (segment.wait > 0.0) {
      Sight still = sights.empty() ? sight(segment, 0, 0.0) : sights.back();
      still.speed = still.rate = still.acceleration = still.lateral = still.curvature_rate = 0.0;
      still.t = begin, still.jump = !sights.empty();
      sights.push_back(still);
      still.t = begin + segment.wait, still.jump = false;
      still.curvature = sight(segment, 0, 0.0).curvature;  // the wheel turns while the car rests
      sights.push_back(still);
      begin += segment.wait;
    }
    for (std::size_t j = 0; j < segment.progress.size(); ++j) PieceTrack(segment, j, begin, sights).run(look);
    begin += segment.piece_duration * static_cast<double>(segment.progress.size());
  }
  return sights;
}

}  // namespace seine::deceive
