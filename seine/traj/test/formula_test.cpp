// evaluate() against the formula of docs/plan-format.md, written out once more as plainly as it stands there:
// powers of w, pieces by min and max, atan2 and quotients.
#include <gtest/gtest.h>

#include "seine/base/rng.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/traj/trajectory.hpp"

namespace seine::traj {
namespace {

/// The `order`-th derivative of Σ c[k] w^k.
double polynomial(const Quintic& c, double w, int order = 0) {
  double sum = 0.0;
  for (int k = order; k < 6; ++k) {
    double factor = 1.0;
    for (int i = 0; i < order; ++i) factor *= k - i;
    sum += factor * c[static_cast<std::size_t>(k)] * std::pow(w, k - order);
  }
  return sum;
}

State by_the_document(const Segment& s, double t) {
  const double h = s.piece_duration, eta = s.gear;
  const double j = std::min(std::floor(t / h), static_cast<double>(s.progress.size()) - 1.0);
  const Quintic& progress = s.progress[static_cast<std::size_t>(j)];
  const double u = polynomial(progress, t / h - j), rate = polynomial(progress, t / h - j, 1) / h,
               rate2 = polynomial(progress, t / h - j, 2) / (h * h);
  const double i = std::max(0.0, std::min(std::floor(u), static_cast<double>(s.curve.size()) - 1.0));
  const auto& [x, y] = s.curve[static_cast<std::size_t>(i)];
  const double x1 = polynomial(x, u - i, 1), y1 = polynomial(y, u - i, 1);
  const double x2 = polynomial(x, u - i, 2), y2 = polynomial(y, u - i, 2);
  const double m = std::hypot(x1, y1);
  State state;
  state.pose = {polynomial(x, u - i), polynomial(y, u - i), std::atan2(eta * y1, eta * x1)};
  state.speed = eta * m * rate;
  state.acceleration = eta * (m * rate2 + (x1 * x2 + y1 * y2) / m * rate * rate);
  state.curvature = eta * (x1 * y2 - y1 * x2) / std::pow(m, 3.0);
  state.lateral_acceleration = state.curvature * state.speed * state.speed;
  return state;
}

TEST(Formula, IsThatOfTheDocument) {
  const std::uint64_t seed = 71;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Rng rng(seed);
  for (int trial = 0; trial < 300; ++trial) {
    Segment segment;
    segment.gear = rng.below(2) == 0 ? 1 : -1;
    segment.piece_duration = rng.uniform(0.1, 3.0);
    const auto quintic = [&](double spread) {
      Quintic c{};
      for (double& value : c) value = spread * rng.normal();
      return c;
    };
    for (int i = 0; i < 3; ++i) {
      segment.curve.push_back({quintic(0.2), quintic(0.2)});
      segment.curve.back()[0][1] += 3.0;
    }
    // u wanders over all pieces, and beyond both ends of the curve: there the end pieces go on.
    for (int j = 0; j < 4; ++j) {
      segment.progress.push_back(quintic(0.5));
      segment.progress.back()[0] = rng.uniform(-0.1, 3.1);
    }
    for (int k = 0; k < 40; ++k) {
      const double t = rng.uniform(0.0, segment.duration());
      const State a = evaluate(segment, t), b = by_the_document(segment, t);
      const auto same = [](double one, double other) {
        EXPECT_NEAR(one, other, 1e-10 * (1.0 + std::abs(other)));
      };
      same(a.pose.x, b.pose.x);
      same(a.pose.y, b.pose.y);
      EXPECT_NEAR(geom::wrap_angle(a.pose.heading - b.pose.heading), 0.0, 1e-10);
      same(a.speed, b.speed);
      same(a.acceleration, b.acceleration);
      same(a.curvature, b.curvature);
      same(a.lateral_acceleration, b.lateral_acceleration);
    }
  }
}

TEST(Formula, AKnotBelongsToThePieceOnItsRight) {
  Segment segment;
  segment.curve = {{Quintic{0.0, 1.0}, Quintic{}}, {Quintic{5.0, 2.0}, Quintic{}}};
  segment.progress = {{0.0, 1.0}, {1.5, 0.5}};
  segment.piece_duration = 2.0;
  EXPECT_EQ(evaluate(segment, 2.0).pose.x, 6.0);  // the second progress piece, u = 1.5
  segment.progress = {{1.0}};
  EXPECT_EQ(evaluate(segment, 1.0).pose.x, 5.0);  // u = 1
}

}  // namespace
}  // namespace seine::traj
