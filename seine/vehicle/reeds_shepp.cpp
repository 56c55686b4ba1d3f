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
// From this ratio of the two gears' costs on, words of three turns in one gear can be among the cheapest.
constexpr double kOneGear = 2.0;

/// (−π, π], for |angle| < 5π: two compares are several times faster than std::remainder.
double wrap(double angle) {
  while (angle > kPi) angle -= 2.0 * kPi;
  while (angle <= -kPi) angle += 2.0 * kPi;
  return angle;
}

/// std::atan2 to a few units in the last place, four times as fast: the library's takes half of the time of a
/// path. The quotient is brought within 1/128 of a multiple of 1/64 by atan a = atan c + atan((a − c) / (1 +
/// a c)); five terms of the series are exact there.
double atan2_of(double y, double x) {
  constexpr int kSteps = 64;
  static const auto table = [] {
    std::array<double, kSteps + 1> angles{};
    for (std::size_t i = 0; i <= kSteps; ++i) angles[i] = std::atan(static_cast<double>(i) / kSteps);
    return angles;
  }();
  const double ax = std::abs(x), ay = std::abs(y);
  const double high = std::max(ax, ay), low = std::min(ax, ay);
  if (high == 0.0) return 0.0;
  const int step = static_cast<int>(kSteps * (low / high) + 0.5);
  const double c = static_cast<double>(step) / kSteps;
  const double t = (low - c * high) / (high + c * low), t2 = t * t;
  double angle = table[static_cast<std::size_t>(step)] +
                 t * (1.0 - t2 * (1.0 / 3.0 - t2 * (1.0 / 5.0 - t2 * (1.0 / 7.0 - t2 / 9.0))));
  if (ay > ax) angle = kHalfPi - angle;
  if (x < 0.0) angle = kPi - angle;
  return std::copysign(angle, y);
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
  Best(double radius, const DrivingCosts& costs, int room)
      : radius_(radius),
        costs_(costs),
        cheapest_(radius * std::min(costs.forward, costs.reverse)),
        room_(room) {}

  template <int N>
  void offer(const Symmetry& symmetry, const std::array<Turn, N>& turns, std::array<double, N> lengths);
  /// Whether no word with so much length (radii) and so many gear changes can still be among the best: asked
  /// before the dear part of its formula is worked out.
  bool hopeless(double length, int gear_changes) const {
    return count_ == room_ && length * cheapest_ + gear_changes * costs_.gear_change >=
                                  words_[static_cast<std::size_t>(count_ - 1)].cost;
  }
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
  double cheapest_;  // cost of one radius
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
  if (!std::isfinite(cost)) return;
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
  const double u1 = std::sqrt(x1 * x1 + y1 * y1);
  if (!best.hopeless(u1, 0)) {
    const double t1 = atan2_of(y1, x1);
    best.offer<3>(symmetry, {kLeft, kStraight, kLeft}, {full_turn(t1), u1, full_turn(wrap(g.heading - t1))});
  }
  const double x2 = g.x + g.sine, y2 = g.y - 1.0 - g.cosine;
  const double square = x2 * x2 + y2 * y2 - 4.0;
  if (square < 0.0) return;
  const double u = std::sqrt(square);
  if (best.hopeless(u, 0)) return;
  const double t2 = wrap(atan2_of(y2, x2) + atan2_of(2.0, u));
  best.offer<3>(symmetry, {kLeft, kStraight, kRight}, {full_turn(t2), u, full_turn(wrap(t2 - g.heading))});
}

/// C|C|C and C|CC [Reeds90, 8.3 and 8.4].
void three_turns(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x = g.x - g.sine, y = g.y - 1.0 + g.cosine;
  const double square = x * x + y * y;
  if (square > 16.0) return;
  const double u = -2.0 * std::asin(0.25 * std::sqrt(square));
  if (best.hopeless(-u, 1)) return;
  const double t = wrap(atan2_of(y, x) + 0.5 * u + kPi);
  if (t < -kRounding) return;
  best.offer<3>(symmetry, {kLeft, kRight, kLeft}, {t, u, wrap(g.heading - t + u)});
}

/// CCC in one gear [Dubins57]: the circles of C|C|C, the middle one driven the long way round. Worth a look
/// only where the other gear is dear.
void three_turns_in_one_gear(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x = g.x - g.sine, y = g.y - 1.0 + g.cosine;
  const double square = x * x + y * y;
  if (square > 16.0) return;
  const double back = 2.0 * std::asin(0.25 * std::sqrt(square)), u = 2.0 * kPi - back;
  if (best.hopeless(u, 0)) return;
  const double t = wrap(atan2_of(y, x) - 0.5 * back + kPi);
  best.offer<3>(symmetry, {kLeft, kRight, kLeft}, {full_turn(t), u, full_turn(wrap(g.heading - t - back))});
}

/// The outer turns of the four-turn words when the inner ones are u and v [Reeds90, 8.7 and 8.8].
struct Outer {
  double first, last;
};
Outer outer_turns(double u, double v, double x, double y, double heading) {
  const double delta = wrap(u - v);
  const double sin_delta = std::sin(delta), cos_delta = std::cos(delta);
  const double a = std::sin(u) - sin_delta, b = std::cos(u) - cos_delta - 1.0;
  const double base = atan2_of(y * a - x * b, x * a + y * b);
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
    if (best.hopeless(2.0 * u, 1)) return;
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
  if (const double r = square1 >= 8.0 ? std::sqrt(square1 - 4.0) : 0.0;
      r >= 2.0 && !best.hopeless(kHalfPi + r - 2.0, 1)) {
    const double t = wrap(atan2_of(y1, x1) + atan2_of(r, -2.0));
    const double v = wrap(g.heading - kHalfPi - t);
    if (t >= -kRounding && v <= kRounding) {
      best.offer<4>(symmetry, {kLeft, kRight, kStraight, kLeft}, {t, -kHalfPi, 2.0 - r, v});
    }
  }
  const double x2 = g.x + g.sine, y2 = g.y - 1.0 - g.cosine;
  const double square2 = x2 * x2 + y2 * y2;
  if (square2 < 4.0) return;
  const double u = 2.0 - std::sqrt(square2);
  if (best.hopeless(kHalfPi - u, 1)) return;
  const double t = atan2_of(x2, -y2);
  const double v = wrap(t + kHalfPi - g.heading);
  if (t >= -kRounding && v <= kRounding) {
    best.offer<4>(symmetry, {kLeft, kRight, kStraight, kRight}, {t, -kHalfPi, u, v});
  }
}

/// C|C(π/2)SC(π/2)|C [Reeds90, 8.11].
void two_quarter_turns(const Target& g, const Symmetry& symmetry, Best& best) {
  const double x = g.x + g.sine, y = g.y - 1.0 - g.cosine;
  const double square = x * x + y * y;
  if (square < 4.0) return;
  const double u = 4.0 - std::sqrt(square - 4.0);
  if (u > kRounding || best.hopeless(kPi - u, 2)) return;
  const double t = wrap(atan2_of((4.0 - u) * x - 2.0 * y, -2.0 * x + (u - 4.0) * y));
  const double v = wrap(t - g.heading);
  if (t >= -kRounding && v >= -kRounding) {
    best.offer<5>(symmetry, {kLeft, kRight, kStraight, kLeft, kRight}, {t, -kHalfPi, u, -kHalfPi, v});
  }
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
  // What both symmetries do to the heading and its sine is the sign of their product.
  const auto seen = [&](int time, int mirror) {
    return Target{time * x, mirror * y, time * mirror * heading, time * mirror * sine, cosine};
  };
  // The words with one gear first: far off they are the cheapest, and most of the others need no more than a
  // look then.
  for (const int time : {1, -1}) {
    for (const int mirror : {1, -1}) straight_between(seen(time, mirror), {time, mirror, false}, words);
  }
  const double dearest = std::max(costs.forward, costs.reverse),
               cheapest = std::min(costs.forward, costs.reverse);
  if (dearest > kOneGear * cheapest) {
    for (const int time : {1, -1}) {
      for (const int mirror : {1, -1})
        three_turns_in_one_gear(seen(time, mirror), {time, mirror, false}, words);
    }
    if (!std::isfinite(dearest)) return words.copy_to(best);
  }
  for (const int time : {1, -1}) {
    for (const int mirror : {1, -1}) {
      const Target g = seen(time, mirror);
      const Symmetry symmetry{time, mirror, false}, reversed{time, mirror, true};
      three_turns(g, symmetry, words);
      four_turns(g, symmetry, words);
      quarter_turn(g, symmetry, words);
      two_quarter_turns(g, symmetry, words);
      // The same words driven from the goal to the start give CC|C and CSC(π/2)|C.
      const Target back{g.x * cosine + g.y * g.sine, g.x * g.sine - g.y * cosine, g.heading, g.sine, cosine};
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
