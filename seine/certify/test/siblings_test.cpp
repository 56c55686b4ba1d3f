// Plans built to deceive: each breaks what it says by far more than is granted, in pieces that a look at one
// joint, at the ends of a cell or at one number would let through. Random sizes; the seed is printed.
#include <gtest/gtest.h>

#include <functional>

#include "seine/base/effort.hpp"
#include "seine/certify/test/brute_force.hpp"

namespace seine::certify::test {
namespace {

using traj::Segment;

const int kTrials = effort(60, 8);

/// One car of random size with all limits.
vehicle::Model random_car(Rng& rng) {
  const double length = std::pow(10.0, rng.uniform(-1.3, 1.5));
  vehicle::Model model;
  model.footprint = vehicle::rectangle_footprint(length, 0.5 * length, 0.2 * length);
  model.wheelbase = rng.uniform(0.4, 0.7) * length;
  model.limits = {.speed = length * rng.uniform(0.5, 4.0),
                  .reverse_speed = length * rng.uniform(0.5, 4.0),
                  .acceleration = length * rng.uniform(0.5, 4.0),
                  .lateral_acceleration = length * rng.uniform(0.5, 4.0),
                  .steering = rng.uniform(0.3, 0.8),
                  .steering_rate = rng.uniform(0.2, 2.0)};
  return model;
}

/// A segment along a straight line, p' = `unit` metres, standing at u = 0.
Segment standing_at(const geom::Pose2& pose, double unit, double duration) {
  Segment segment;
  const Vec2 d = pose.direction();
  segment.curve = {{Quintic{pose.x, unit * d.x}, Quintic{pose.y, unit * d.y}}};
  segment.progress = {Quintic{}};
  segment.piece_duration = duration;
  return segment;
}

struct Case {
  vehicle::Model model;
  double length = model.length();
  traj::RobotTrajectory way;
  double start_speed = 0.0;

  Certificate judge() const {
    const traj::TeamTrajectory plan{{way}};
    world::Scenario scenario = scenario_for(plan, model, 1000.0 * length + 100.0);
    scenario.robots[0].start_speed = start_speed;
    return certify(scenario, world::StaticMap(scenario), plan);
  }
};

using Construct = std::function<void(Rng&, Case&)>;

void expect_refused(std::uint64_t seed, const Construct& construct) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(seed + static_cast<std::uint64_t>(trial));
    Case one{random_car(rng)};
    construct(rng, one);
    const Certificate certificate = one.judge();
    EXPECT_EQ(certificate.verdict(), Verdict::refuted)
        << "seed " << seed + static_cast<std::uint64_t>(trial) << ": " << summary(certificate);
  }
}

/// Log-uniform.
double between(Rng& rng, double low, double high) {
  return low * std::pow(high / low, rng.uniform(0.0, 1.0));
}

TEST(Siblings, TurnOnTheSpot) {
  expect_refused(1000, [](Rng& rng, Case& c) {
    const double step = between(rng, 1e-5, 0.9e-4), turn = between(rng, 2e-3, 0.03);
    const double duration = between(rng, 1e-6, 1e-3);
    for (double heading = 0.0; heading < turn; heading += step)
      c.way.segments.push_back(standing_at({0.0, 0.0, heading}, c.length, duration));
  });
}

TEST(Siblings, SlideSideways) {
  expect_refused(2000, [](Rng& rng, Case& c) {
    const double step = std::min(1.0, 4.0 * c.length) * between(rng, 1e-8, 0.9e-5);
    const double duration = between(rng, 1e-6, 1e-3);
    for (int i = 0; i < 2000; ++i)
      c.way.segments.push_back(standing_at({0.0, step * i, 0.0}, c.length, duration));
  });
}

TEST(Siblings, SlideAtJointsOfTheProgress) {
  expect_refused(3000, [](Rng& rng, Case& c) {
    Segment segment = standing_at({}, c.length * between(rng, 1e-3, 1e3), between(rng, 1e-6, 1e-3));
    const double unit = segment.curve[0][0][1];
    const double step = std::min(1.0, 4.0 * c.length) * between(rng, 1e-7, 0.9e-5) / unit;
    segment.progress.clear();
    for (int i = 0; i < 1000 && step * i < 1.0; ++i) segment.progress.push_back({step * i});
    c.way.segments = {segment};
  });
}

TEST(Siblings, SpeedByJumps) {
  // Whole plan within a short time: accelerates by jumps, far beyond the limit.
  expect_refused(4000, [](Rng& rng, Case& c) {
    const double h = between(rng, 1e-6, 1e-4), jump = c.length * between(rng, 1e-5, 1e-3);
    Segment segment = standing_at({}, c.length, h);
    segment.progress.clear();
    double u = 0.0;
    const int pieces = 400;
    for (int i = 0; i < pieces; ++i) {
      const double speed = jump * std::min(i, pieces - 1 - i);
      const double step = speed * h / c.length;
      segment.progress.push_back({u, step});
      u += step;
    }
    c.way.segments = {segment};
  });
}

TEST(Siblings, SpeedByGrowthOfTheTangent) {
  expect_refused(5000, [](Rng& rng, Case& c) {
    const double growth = 1.0 + between(rng, 1e-4, 0.9e-3), l = c.length * between(rng, 1e-3, 1e-2);
    Segment segment;
    segment.piece_duration = 1.0;
    const int pieces = 600;
    double x = 0.0, unit = l;
    for (int i = 0; i < pieces; ++i) {
      segment.curve.push_back({Quintic{x, unit}, Quintic{}});
      x += unit, unit *= growth;
    }
    const double rate = rng.uniform(100.0, 300.0);
    segment.piece_duration = pieces / rate;
    segment.progress = {{0.0, static_cast<double>(pieces)}};
    c.start_speed = l * rate;
    Segment stop;
    const double v = unit / growth * rate, a = 0.5 * c.model.limits.acceleration, way = 0.5 * v * v / a;
    stop.curve = {{Quintic{x, way}, Quintic{}}};
    stop.piece_duration = v / a;
    stop.progress = {{0.0, 2.0, -1.0}};
    c.way.segments = {segment, stop};
    c.model.limits.speed = 10.0 * v;
    c.model.limits.acceleration = std::min(c.model.limits.acceleration, 0.05 * v * rate * (growth - 1.0));
  });
}

TEST(Siblings, BendByKinks) {
  expect_refused(6000, [](Rng& rng, Case& c) {
    const double turn = between(rng, 1e-5, 0.9e-4);
    const double step = turn / (c.model.max_curvature() * rng.uniform(2.0, 5.0));
    Segment segment;
    double heading = 0.0;
    Vec2 p{};
    const int pieces = 500;
    for (int i = 0; i < pieces; ++i) {
      const Vec2 d = geom::unit(heading);
      segment.curve.push_back({Quintic{p.x, step * d.x}, Quintic{p.y, step * d.y}});
      p = p + step * d, heading += turn;
    }
    segment.progress = rest_to_rest(pieces, 8, 0.0);
    segment.piece_duration = 10.0;
    c.way.segments = {segment};
  });
}

TEST(Siblings, SteeringInStandingSegments) {
  expect_refused(7000, [](Rng& rng, Case& c) {
    const double most = c.model.max_curvature(), step = most * between(rng, 1e-5, 0.9e-3);
    const double h = between(rng, 1e-6, 1e-4);
    for (int i = 0; i < 2000 && step * i < most; ++i) {
      Segment segment = standing_at({}, c.length, h);
      segment.curve[0][1][2] = 0.5 * step * i * c.length * c.length;
      c.way.segments.push_back(segment);
    }
    c.model.limits.steering_rate = std::min(
        0.1 / (h * static_cast<double>(c.way.segments.size())) * std::atan(step * 2000 * c.model.wheelbase),
        1.0);
  });
}

TEST(Siblings, SteeringInWaitsThatAreTooShort) {
  expect_refused(8000, [](Rng& rng, Case& c) {
    const double most = c.model.max_curvature(), step = most * between(rng, 1e-4, 0.9e-3);
    const double angle = std::atan(step * c.model.wheelbase);
    for (int i = 0; i < 500 && step * i < most; ++i) {
      Segment segment = standing_at({}, c.length, 1e-6);
      segment.curve[0][1][2] = 0.5 * step * i * c.length * c.length;
      segment.wait = rng.uniform(0.0, 0.9) * angle / c.model.limits.steering_rate;
      c.way.segments.push_back(segment);
    }
  });
}

TEST(Siblings, TeleportWhereTheTangentVanishes) {
  // p' = 0 (almost) at u = landing: a jump of u to there looks short by |p'|.
  expect_refused(9000, [](Rng& rng, Case& c) {
    const double landing = rng.uniform(0.2, 0.8), rest = c.length * between(rng, 1e-9, 1e-2);
    const double scale = c.length * rng.uniform(3.0, 30.0);
    Segment segment;  // x' = rest + scale (u − landing)²
    segment.curve = {
        {Quintic{0.0, rest + scale * landing * landing, -scale * landing, scale / 3.0}, Quintic{}}};
    const double before = landing * rng.uniform(0.2, 0.9);
    segment.progress = {hermite({0, 0, 0}, {before, 0, 0}), hermite({landing, 0, 0}, {1, 0, 0})};
    segment.piece_duration = 100.0;
    c.way.segments = {segment};
  });
}

TEST(Siblings, TheWheelJumpsAtAKnot) {
  // Place and heading agree there, the wheel does not.
  expect_refused(10000, [](Rng& rng, Case& c) {
    const double l = c.length * rng.uniform(3.0, 10.0),
                 bend = rng.uniform(0.5, 1.0) * c.model.max_curvature();
    Segment segment;
    segment.curve = {curve_piece({{}, 0.0}, {{l, 0.0, 0.0}, 0.0}, 1, l),
                     curve_piece({{l, 0.0, 0.0}, bend}, {{2.0 * l, 0.0, 0.0}, 0.0}, 1, l)};
    segment.progress = {hermite({0, 0, 0}, {1, 0, 0}), hermite({1, 0, 0}, {2, 0, 0})};
    segment.piece_duration = 100.0;
    c.way.segments = {segment};
  });
}

TEST(Siblings, OutOverAKnotAndBackWithinOnePiece) {
  // Starts and ends before a knot, and runs metres beyond it in between, forwards and back.
  expect_refused(11000, [](Rng& rng, Case& c) {
    const double l = c.length * between(rng, 1e-3, 1.0), start = rng.uniform(0.02, 0.9);
    const double reach = rng.uniform(1.05, 2.9) - start;
    Segment segment;
    const double tiny = l * between(rng, 1e-8, 1.0), far = c.length * rng.uniform(1.0, 10.0);
    segment.curve = {{Quintic{0.0, tiny}, Quintic{}},
                     {Quintic{tiny, tiny, 0.0, far}, Quintic{}},
                     {Quintic{2.0 * tiny + far, tiny + 3.0 * far}, Quintic{}}};
    // u = start + reach · 16 w²(1 − w)²
    segment.progress = {{start, 0.0, 16.0 * reach, -32.0 * reach, 16.0 * reach}};
    segment.piece_duration = between(rng, 0.1, 1000.0);
    c.way.segments = {segment};
  });
}

TEST(Siblings, BackOverABendSlowly) {
  // Slower against the gear than is granted, so only the bend (or the distance) shows.
  expect_refused(12000, [](Rng& rng, Case& c) {
    const double l = c.length, sharp = c.model.max_curvature() * rng.uniform(1.2, 3.0);
    const double pace = std::min({1.0, c.model.limits.speed, c.model.limits.reverse_speed,
                                  std::sqrt(c.model.limits.acceleration * l)});
    Segment segment;  // κ = 6 b w / …: sharp at `out`
    const double out = between(rng, 1e-3, 0.05);
    segment.curve = {{Quintic{0.0, l}, Quintic{0.0, 0.0, 0.0, sharp * l * l / (6.0 * out)}}};
    segment.progress = {{0.0, 0.0, 16.0 * out, -32.0 * out, 16.0 * out}};
    segment.piece_duration = 4.0 * out * l / (rng.uniform(0.05, 0.9) * 1e-3 * pace);
    c.way.segments = {segment};
  });
}

TEST(Siblings, ManySmallStepsBack) {
  // Each below every threshold of speed: forwards and back, in all more than is granted.
  expect_refused(13000, [](Rng& rng, Case& c) {
    const double l = c.length, out = between(rng, 1e-5, 1e-3);
    Segment segment = standing_at({}, l, 1.0);
    segment.progress.assign(400, {0.0, 0.0, 16.0 * out, -32.0 * out, 16.0 * out});
    const double pace = std::min({1.0, c.model.limits.speed, c.model.limits.reverse_speed,
                                  std::sqrt(c.model.limits.acceleration * l)});
    segment.piece_duration = 4.0 * out * l / (rng.uniform(0.05, 0.9) * 1e-3 * pace);
    c.way.segments = {segment};
  });
}

TEST(Siblings, WaitsOrArrivesBeyondAKnot) {
  // u stands at a knot, which belongs to the piece on its right, metres away, while it comes from or goes to
  // the left.
  expect_refused(13500, [](Rng& rng, Case& c) {
    const double l = c.length, far = between(rng, 1e-3, 10.0) * l;
    Segment segment;
    segment.curve = {{Quintic{0.0, l}, Quintic{}}, {Quintic{l, l}, Quintic{far}}};
    segment.piece_duration = 100.0;
    segment.progress = {hermite({0, 0, 0}, {1, 0, 0})};
    if (rng.below(2) == 0) {  // from there, backwards by next to nothing
      segment.wait = 1.0;
      segment.progress = {{1.0, 0.0, -1e-9}};
    }
    c.way.segments = {segment};
  });
}

TEST(Siblings, SpeedAtTheEnds) {
  // A slow car that starts and arrives at its full speed.
  expect_refused(14000, [](Rng& rng, Case& c) {
    const double speed = between(rng, 1e-5, 1e-3);
    c.model.limits.speed = c.model.limits.reverse_speed = speed;
    c.model.limits.acceleration = between(rng, 1e-6, 1.0);
    Segment segment = standing_at({}, c.length, c.length / speed);
    segment.progress = {{0.0, rng.uniform(0.2, 1.0)}};
    c.way.segments = {segment};
  });
}

TEST(Siblings, JumpOfTheProgressInABend) {
  // Short in metres, but it turns the car or its wheel.
  expect_refused(15000, [](Rng& rng, Case& c) {
    const double size = between(rng, 1e-4, 2e-3);
    c.model.footprint = vehicle::rectangle_footprint(size, 0.5 * size, 0.2 * size);
    c.model.wheelbase = 0.6 * size;
    c.length = size;
    const double kappa = 0.8 * c.model.max_curvature(), l = 0.5 / kappa;
    Segment segment;
    const Bent from{{}, kappa}, to = drive(from, kappa, 1, l);
    segment.curve = {curve_piece(from, to, 1, l)};
    const double jump = between(rng, 2e-4, 1e-2) / (kappa * l);
    segment.progress = {hermite({0, 0, 0}, {0.4, 0, 0}), hermite({0.4 + jump, 0, 0}, {1, 0, 0})};
    segment.piece_duration = 100.0;
    c.way.segments = {segment};
  });
}

TEST(Siblings, TinyCarsThroughEachOther) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(16000 + static_cast<std::uint64_t>(trial));
    const double size = between(rng, 1e-4, 1e-2);
    traj::TeamTrajectory plan{
        {straight({0, 0, 0}, 20.0 * size, 10.0),
         straight({20.0 * size, rng.uniform(-0.45, 0.45) * size, std::numbers::pi}, 20.0 * size, 10.0)}};
    const world::Scenario scenario = scenario_for(plan, car(size, size), 1.0);
    const Certificate certificate = certify(scenario, world::StaticMap(scenario), plan);
    EXPECT_TRUE(breaks(certificate, Kind::robot_clearance)) << summary(certificate);
  }
}

TEST(Siblings, RoundingIsNoPlace) {
  // Coefficients so large that u, and with it the car, is known to metres only.
  expect_refused(17000, [](Rng& rng, Case& c) {
    Segment segment = standing_at({}, c.length * between(rng, 1e6, 1e8), 1.0);
    const double big = between(rng, 1e6, 1e8);
    segment.progress = {{0.0, big, -big, -big, big}};
    c.way.segments = {segment};
  });
}

}  // namespace
}  // namespace seine::certify::test
