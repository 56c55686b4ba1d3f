#include "seine/vehicle/reeds_shepp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace seine::vehicle {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHalfPi = 0.5 * kPi;
// A length that should be ≥ 0 may come out this much below it by rounding (radii); it is then taken as it is.
constexpr double kRounding = 1e-9;
constexpr int kMaxBest = 8;

/// (−π, π], for |angle| < 5π: two compares are several times faster than std::remainder.
double wrap(double angle) {
  while (angle > kPi) angle -= 2.0 * kPi;
  while (angle <= -kPi) angle += 2.0 * kPi;
  return angle;
}

/// A goal seen from the start in radii: every word is computed for a start at the origin, for the left turn
/// first and the forward gear first; the others follow by the symmetries of [Reeds90, section 8].
struct Target {
  double x, y, heading;
  double sine, cosine;  // of the heading
};

/// L, S, R as the sign of the curvature.
enum Turn : int { kLeft = 1, kStraight = 0, kRight = -1 };

/// Which symmetry of the problem is being solved.
struct Symmetry {
  int time = 1;            // −1: all lengths change sign
  int mirror = 1;          // −1: left and right change places
  bool backwards = false;  // the word is driven from its end
};

/// Keeps the cheapest words seen, ascending.
class Best {
 public:
  Best(double radius, const DrivingCosts& costs, int room) : radius_(radius), costs_(costs), room_(room) {}

  template <int N>
  void offer(const Symmetry& symmetry, const std::array<Turn, N>& turns, std::array<double, N> lengths);
  int copy_to(std::span<ReedsSheppPath> out) const;

 private:
  struct Word {
    std::array<double, 5> length{};  // radii, signed
    std::array<signed char, 5> turn{};
    int count = 0;
    double cost = 0.0;  // m
  };
  double cost_of(std::span<const double> lengths) const;

  double radius_;
  DrivingCosts costs_;
  int room_;
  int count_ = 0;
  std::array<Word, kMaxBest> words_{};
};

double Best::cost_of(std::span<const double> lengths) const {
  double cost = 0.0;
  int gear = 0;
  for (const double length : lengths) {
    if (std::abs(length) < kRounding) continue;
    const int now = length > 0.0 ? 1 : -1;
    if (gear == -now) cost += costs_.gear_change;
    gear = now;
    cost += radius_ * (now > 0 ? costs_.forward * length : -costs_.reverse * length);
  }
  return cost;
}

template <int N>
void Best::offer(const Symmetry& symmetry, const std::array<Turn, N>& turns, std::array<double, N> lengths) {
  if (symmetry.time < 0) {
    for (double& length : lengths) length = -length;
  }
  const double cost = cost_of(lengths);
  if (count_ == room_ && cost >= words_[static_cast<std::size_t>(count_ - 1)].cost) return;
  int at = count_ < room_ ? count_++ : count_ - 1;
  for (; at > 0 && words_[static_cast<std::size_t>(at - 1)].cost > cost; --at) {
    words_[static_cast<std::size_t>(at)] = words_[static_cast<std::size_t>(at - 1)];
  }
  Word& word = words_[static_cast<std::size_t>(at)];
  word.count = N;
  word.cost = cost;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t from = symmetry.backwards ? N - 1 - i : i;
    word.length[i] = lengths[from];
    word.turn[i] = static_cast<signed char>(symmetry.mirror * turns[from]);
  }
}

int Best::copy_to(std::span<ReedsSheppPath> out) const {
  for (int k = 0; k < count_; ++k) {
    const Word& word = words_[static_cast<std::size_t>(k)];
    ReedsSheppPath& path = out[static_cast<std::size_t>(k)];
    path = {};
    path.cost = word.cost;
    for (std::size_t i = 0; i < static_cast<std::size_t>(word.count); ++i) {
      if (std::abs(word.length[i]) < kRounding) continue;
      path.arc[static_cast<std::size_t>(path.count++)] = {word.turn[i] / radius_, word.length[i] * radius_};
      path.length += std::abs(word.length[i]) * radius_;
    }
  }
  return count_;
}

double full_turn(double angle) {
  return angle < -kRounding ? angle + 2.0 * kPi : angle;
}

/// CSC: LSL [Reeds90, 8.1] and LSR [8.2]. Turns beyond π are never shortest but are in one gear.
void straight_between(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x1 = g.x - g.sine, y1 = g.y - 1.0 + g.cosine;
  const double t1 = std::atan2(y1, x1);
  best.offer<3>(symmetry, {kLeft, kStraight, kLeft},
                {full_turn(t1), std::hypot(x1, y1), full_turn(wrap(g.heading - t1))});
  const double x2 = g.x + g.sine, y2 = g.y - 1.0 - g.cosine;
  const double square = x2 * x2 + y2 * y2 - 4.0;
  if (square < 0.0) return;
  const double u = std::sqrt(square);
  const double t2 = wrap(std::atan2(y2, x2) + std::atan2(2.0, u));
  best.offer<3>(symmetry, {kLeft, kStraight, kRight}, {full_turn(t2), u, full_turn(wrap(t2 - g.heading))});
}

/// C|C|C and C|CC [Reeds90, 8.3 and 8.4].
void three_turns(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x = g.x - g.sine, y = g.y - 1.0 + g.cosine;
  const double square = x * x + y * y;
  if (square > 16.0) return;
  const double u = -2.0 * std::asin(0.25 * std::sqrt(square));
  const double t = wrap(std::atan2(y, x) + 0.5 * u + kPi);
  if (t < -kRounding) return;
  best.offer<3>(symmetry, {kLeft, kRight, kLeft}, {t, u, wrap(g.heading - t + u)});
}

/// The outer turns of the four-turn words when the inner ones are u and v [Reeds90, 8.7 and 8.8].
struct Outer {
  double first, last;
};
Outer outer_turns(double u, double v, double x, double y, double heading) {
  const double delta = wrap(u - v);
  const double sin_delta = std::sin(delta), cos_delta = std::cos(delta);
  const double a = std::sin(u) - sin_delta, b = std::cos(u) - cos_delta - 1.0;
  const double base = std::atan2(y * a - x * b, x * a + y * b);
  const double side = 2.0 * (cos_delta - std::cos(v) - std::cos(u)) + 3.0;
  const double first = side < 0.0 ? wrap(base + kPi) : base;
  return {first, wrap(first - u + v - heading)};
}

/// CCu|CuC and C|CuCu|C [Reeds90, 8.7 and 8.8].
void four_turns(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x = g.x + g.sine, y = g.y - 1.0 - g.cosine;
  const double square = x * x + y * y;
  if (square <= 4.0) {
    const double u = std::acos(0.25 * (2.0 + std::sqrt(square)));
    const Outer outer = outer_turns(u, -u, x, y, g.heading);
    if (outer.first >= -kRounding && outer.last <= kRounding) {
      best.offer<4>(symmetry, {kLeft, kRight, kLeft, kRight}, {outer.first, u, -u, outer.last});
    }
  }
  const double cosine = (20.0 - square) / 16.0;
  if (cosine >= 0.0 && cosine <= 1.0) {
    const double u = -std::acos(cosine);
    const Outer outer = outer_turns(u, u, x, y, g.heading);
    if (outer.first >= -kRounding && outer.last >= -kRounding) {
      best.offer<4>(symmetry, {kLeft, kRight, kLeft, kRight}, {outer.first, u, u, outer.last});
    }
  }
}

/// C|C(π/2)SC [Reeds90, 8.9 and 8.10].
void quarter_turn(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x1 = g.x - g.sine, y1 = g.y - 1.0 + g.cosine;
  const double square1 = x1 * x1 + y1 * y1;
  if (square1 >= 4.0) {
    const double r = std::sqrt(square1 - 4.0);
    const double t = wrap(std::atan2(y1, x1) + std::atan2(r, -2.0));
    const double v = wrap(g.heading - kHalfPi - t);
    if (t >= -kRounding && r >= 2.0 && v <= kRounding) {
      best.offer<4>(symmetry, {kLeft, kRight, kStraight, kLeft}, {t, -kHalfPi, 2.0 - r, v});
    }
  }
  const double x2 = g.x + g.sine, y2 = g.y - 1.0 - g.cosine;
  const double square2 = x2 * x2 + y2 * y2;
  if (square2 < 4.0) return;
  const double t = std::atan2(x2, -y2);
  const double v = wrap(t + kHalfPi - g.heading);
  if (t >= -kRounding && v <= kRounding) {
    best.offer<4>(symmetry, {kLeft, kRight, kStraight, kRight}, {t, -kHalfPi, 2.0 - std::sqrt(square2), v});
  }
}

/// C|C(π/2)SC(π/2)|C [Reeds90, 8.11].
void two_quarter_turns(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x = g.x + g.sine, y = g.y - 1.0 - g.cosine;
  const double square = x * x + y * y;
  if (square < 4.0) return;
  const double u = 4.0 - std::sqrt(square - 4.0);
  if (u > kRounding) return;
  const double t = wrap(std::atan2((4.0 - u) * x - 2.0 * y, -2.0 * x + (u - 4.0) * y));
  const double v = wrap(t - g.heading);
  if (t >= -kRounding && v >= -kRounding) {
    best.offer<5>(symmetry, {kLeft, kRight, kStraight, kLeft, kRight}, {t, -kHalfPi, u, -kHalfPi, v});
  }
}

Target target(double x, double y, double heading, double sine, double cosine) {
  return {x, y, wrap(heading), sine, cosine};
}

}  // namespace

int reeds_shepp(const geom::Pose2& from, const geom::Pose2& to, double radius, const DrivingCosts& costs,
                std::span<ReedsSheppPath> best) {
  const geom::Vec2 ahead = from.direction(), gap = (to.position() - from.position()) / radius;
  const double x = geom::dot(gap, ahead), y = geom::cross(ahead, gap);
  const double heading = geom::wrap_angle(to.heading - from.heading);
  const double sine = std::sin(heading), cosine = std::cos(heading);
  Best words(radius, costs, std::min(kMaxBest, static_cast<int>(best.size())));
  if (best.empty()) return 0;
  for (const int time : {1, -1}) {
    for (const int mirror : {1, -1}) {
      const double turned = time * mirror;  // what both symmetries do to the heading and its sine
      const Symmetry symmetry{time, mirror, false};
      const Target g = target(time * x, mirror * y, turned * heading, turned * sine, cosine);
      straight_between(g, symmetry, words);
      three_turns(g, symmetry, words);
      four_turns(g, symmetry, words);
      quarter_turn(g, symmetry, words);
      two_quarter_turns(g, symmetry, words);
      // The same words driven from the goal to the start give CC|C and CSC(π/2)|C.
      const Symmetry reversed{time, mirror, true};
      const Target back =
          target(g.x * cosine + g.y * g.sine, g.x * g.sine - g.y * cosine, g.heading, g.sine, cosine);
      three_turns(back, reversed, words);
      quarter_turn(back, reversed, words);
    }
  }
  return words.copy_to(best);
}

ReedsSheppPath reeds_shepp(const geom::Pose2& from, const geom::Pose2& to, double radius,
                           const DrivingCosts& costs) {
  std::array<ReedsSheppPath, 1> best;
  reeds_shepp(from, to, radius, costs, best);
  return best[0];
}

geom::Pose2 pose_at(const geom::Pose2& from, const ReedsSheppPath& path, double s) {
  geom::Pose2 pose = from;
  for (const Arc& arc : path.arcs()) {
    const double length = std::abs(arc.distance);
    if (s <= length) return drive(pose, arc.curvature, std::copysign(std::max(s, 0.0), arc.distance));
    pose = drive(pose, arc);
    s -= length;
  }
  return pose;
}

}  // namespace seine::vehicle
