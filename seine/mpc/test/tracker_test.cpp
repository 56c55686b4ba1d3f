// The loop closed round an exact simulation of the bicycle.
#include "seine/mpc/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/effort.hpp"
#include "seine/base/error.hpp"
#include "seine/base/rng.hpp"
#include "seine/mpc/test/drive.hpp"

namespace seine::mpc {
namespace {

constexpr std::uint64_t kSeed = 20293;
const vehicle::Model kCar = small_car();

double worst_distance(const std::vector<Moment>& moments, double from) {
  return worst_after(moments, from, &Moment::distance);
}

TEST(Tracker, SteadyStateHasNoErrorOnStraightsAndCirclesForwardAndBackward) {
  for (const double speed : {2.4, 0.5, -0.5, -2.4})
    for (const double steering : {0.0, 0.3, -0.6}) {
      Tracker tracker(kCar);
      const Course course = circle(speed, steering, kCar.wheelbase);
      State start = course(0).state;
      start.x += 0.1, start.heading -= 0.1;
      const auto moments = drive(tracker, kCar, course, {.start = start, .duration = 8.0});
      EXPECT_LT(worst_distance(moments, 6.0), 1e-3) << speed << " m/s, " << steering << " rad";
      EXPECT_LT(worst_after(moments, 6.0, &Moment::heading), 1e-3);
    }
}

// The supplement's forward Euler step cuts corners: kept as an option, not as the default.
TEST(Tracker, TheExactStepIsWhatMakesTheSteadyStateExact) {
  const Course course = circle(2.0, 0.4, kCar.wheelbase);
  double worst[2];
  for (const Discretisation d : {Discretisation::euler, Discretisation::exact}) {
    Options options;
    options.discretisation = d;
    Tracker tracker(kCar, options);
    worst[d == Discretisation::exact] =
        worst_distance(drive(tracker, kCar, course, {.start = course(0).state}), 3.0);
  }
  std::printf("circle at 2 m/s: euler %.4f m, exact %.1e m\n", worst[0], worst[1]);
  EXPECT_GT(worst[0], 0.005);
  EXPECT_LT(worst[1], 1e-3);
}

// R pulls the inputs to zero, off the reference: with it the circle is left by as much as the weights say.
TEST(Tracker, EffortHasItsPrice) {
  const Course course = circle(2.0, 0.4, kCar.wheelbase);
  Options options;
  options.weights.effort = {0.5, 5.0};
  Tracker tracker(kCar, options);
  const double off = worst_distance(drive(tracker, kCar, course, {.start = course(0).state}), 3.0);
  EXPECT_GT(off, 0.002);
  EXPECT_LT(off, 0.2);
}

TEST(Tracker, AStepAsideIsTakenBackWithoutOvershoot) {
  for (const double speed : {2.0, -2.0}) {
    Tracker tracker(kCar);
    const auto moments =
        drive(tracker, kCar, straight(speed), {.start = {0.0, 0.3, 0.0, speed}, .duration = 4.0});
    EXPECT_LT(worst_distance(moments, 1.0), 0.03) << speed;
    EXPECT_LT(worst_distance(moments, 2.5), 0.002) << speed;
    for (const Moment& m : moments) EXPECT_GT(m.state.y, -0.01) << speed;
  }
}

TEST(Tracker, FarOffItStillComesBack) {
  struct Start {
    State state;
    const char* what;
  };
  for (const Start& start :
       {Start{{0.0, 2.0, 0.0, 2.0}, "2 m aside"}, Start{{0.0, 0.0, 1.7, 2.0}, "1.7 rad off"},
        Start{{-1.0, 0.5, -0.5, 0.0}, "at rest, a metre behind"}}) {
    Tracker tracker(kCar);
    const auto moments = drive(tracker, kCar, straight(2.0), {.start = start.state, .duration = 10.0});
    EXPECT_LT(worst_distance(moments, 8.0), 0.01) << start.what;
  }
}

TEST(Tracker, ASteadyPushLeavesASmallOffsetAndAShoveIsForgotten) {
  Tracker steady(kCar);
  const auto drift = [](double, State& s) { s.y += 0.2 * 0.05; };  // 0.2 m/s sideways
  const auto pushed =
      drive(steady, kCar, straight(2.0), {.start = {0.0, 0.0, 0.0, 2.0}, .duration = 8.0, .pushed = drift});
  std::printf("pushed sideways at 0.2 m/s: %.3f m off\n", pushed.back().distance());
  EXPECT_LT(worst_distance(pushed, 4.0), 0.08);

  Tracker tracker(kCar);
  const auto shove = [](double t, State& s) {
    if (std::abs(t - 2.0) < 0.01) s.y += 0.2, s.heading += 0.3, s.speed -= 0.5;
  };
  const auto shoved =
      drive(tracker, kCar, circle(2.0, 0.3, kCar.wheelbase),
            {.start = circle(2.0, 0.3, kCar.wheelbase)(0).state, .duration = 6.0, .pushed = shove});
  EXPECT_LT(worst_distance(shoved, 4.5), 0.005);
}

TEST(Tracker, NoiseDoesNotGrow) {
  Rng rng(kSeed);
  Tracker tracker(kCar);
  const auto misread = [&](double, State& s) {
    s.x += 0.02 * rng.normal(), s.y += 0.02 * rng.normal();
    s.heading += 0.02 * rng.normal(), s.speed += 0.05 * rng.normal();
  };
  const Course course = circle(1.5, 0.2, kCar.wheelbase);
  const auto moments =
      drive(tracker, kCar, course, {.start = course(0).state, .duration = 60.0, .misread = misread});
  std::printf("2 cm, 1.1 deg of noise: %.4f m rms\n", rms_distance(moments));
  EXPECT_LT(rms_distance(moments), 0.03) << "seed " << kSeed;
}

TEST(Tracker, DeadTimeAndLagAreLookedThrough) {
  const Course course = circle(2.0, 0.4, kCar.wheelbase);
  for (const double dead_time : {0.05, 0.1, 0.12}) {
    Options options;
    options.dead_time = dead_time;
    Tracker tracker(kCar, options);
    State start = course(0).state;
    start.y += 0.05;
    // drive() delays commands by whole periods.
    if (std::abs(dead_time / options.period - std::round(dead_time / options.period)) > 1e-6) {
      EXPECT_NO_THROW(tracker.step(start, std::vector<Sample>(21)));
      continue;
    }
    tracker.reset(course(0).input);
    const auto moments = drive(tracker, kCar, course, {.start = start, .duration = 6.0});
    EXPECT_LT(worst_distance(moments, 4.0), 1e-3) << dead_time;
  }
}

// Actuators() knows the plant that drive() does not have: inputs that follow with a lag.
TEST(Tracker, LagIsPlannedAround) {
  constexpr double kLag = 0.08;
  double rms[2];
  for (const bool knows : {false, true}) {
    Options options;
    options.lag = knows ? kLag : 0.0;
    Tracker tracker(kCar, options);
    State state{0.0, 0.0, 0.0, 1.5};
    Input acting;
    double sum = 0.0;
    int count = 0;
    // A slalom: the steering always has somewhere to go.
    const auto steering = [](double t) { return 0.4 * std::sin(2.0 * t); };
    std::vector<State> course{state};
    for (int i = 0; i < 400; ++i)
      course.push_back(advance(course.back(), {0.0, steering((i + 0.5) * 0.05)}, kCar.wheelbase, 0.05));
    for (std::size_t i = 0; i < 300; ++i) {
      std::vector<Sample> reference;
      for (std::size_t k = 0; k <= 20; ++k)
        reference.push_back({course[i + k], {0.0, steering((static_cast<double>(i + k) + 0.5) * 0.05)}});
      const Command command = tracker.step(state, reference);
      for (int fine = 0; fine < 50; ++fine) {
        const double share = 1.0 - std::exp(-0.001 / kLag);
        acting.acceleration += share * (command.input.acceleration - acting.acceleration);
        acting.steering += share * (command.input.steering - acting.steering);
        state = advance(state, acting, kCar.wheelbase, 0.001);
      }
      if (i < 40) continue;
      sum += std::pow(state.x - course[i + 1].x, 2) + std::pow(state.y - course[i + 1].y, 2), ++count;
    }
    rms[knows] = std::sqrt(sum / count);
  }
  std::printf("slalom with 80 ms of lag: %.4f m rms, %.4f m when it is known\n", rms[0], rms[1]);
  EXPECT_LT(rms[1], 0.25 * rms[0]);
  EXPECT_LT(rms[1], 0.005);
}

// A plan that starts as hard as the car can: what lags must be told before the plan begins, and is, as the
// programme knows what the actuators reach.
TEST(Tracker, AHardStartIsBegunEarlyEnough) {
  constexpr double kLag = 0.1, kCountdown = 0.3, kHardest = 3.0;
  Options options;
  options.lag = kLag;
  Tracker tracker(kCar, options);
  const auto course = [](double t) {
    const double pushed = std::clamp(t, 0.0, 0.7), rolled = std::max(t - 0.7, 0.0);
    const double speed = kHardest * pushed;
    return Sample{{0.5 * speed * pushed + speed * rolled, 0.0, 0.0, speed},
                  {t > 0.0 && t < 0.7 ? kHardest : 0.0, 0.0}};
  };
  State state;
  Input acting;
  double worst = 0.0;
  for (double t = -kCountdown; t < 1.5; t += 0.05) {
    std::vector<Sample> reference;
    for (int k = 0; k <= 20; ++k) {
      const double then = t + 0.05 * k;
      reference.push_back({course(then).state, course(then + 0.025).input});
    }
    tracker.observe(acting);
    const Command command = tracker.step(state, reference);
    EXPECT_EQ(command.source, Source::tracking);
    for (int fine = 0; fine < 50; ++fine) {
      const double share = 1.0 - std::exp(-0.001 / kLag);
      acting.acceleration += share * (command.input.acceleration - acting.acceleration);
      state = advance(state, acting, kCar.wheelbase, 0.001);
      worst = std::max(worst, std::abs(state.x - course(t + 0.001 * (fine + 1)).state.x));
    }
  }
  std::printf("a start at the limit with 100 ms of lag: %.4f m off at most\n", worst);
  EXPECT_LT(worst, 0.03);
}

TEST(Tracker, LimitsHoldToTheBitWhateverHappens) {
  Rng rng(kSeed + 1);
  vehicle::Model model = kCar;
  model.limits.steering_rate = 2.0;
  model.limits.reverse_speed = 1.0;
  for (int run = 0; run < effort(20, 2); ++run) {
    Options options;
    options.acceleration_change = 0.3;
    Tracker tracker(model, options);
    const double speed = rng.uniform(-1.0, 2.5), steering = rng.uniform(-0.7, 0.7);
    const State start{rng.normal(), rng.normal(), rng.uniform(-3, 3), rng.uniform(-1.0, 2.5)};
    const auto kick = [&](double, State& s) {
      if (rng.below(20) == 0) s.x += 0.3 * rng.normal(), s.heading += 0.5 * rng.normal();
    };
    const auto moments = drive(tracker, model, circle(speed, steering, model.wheelbase),
                               {.start = start, .duration = 6.0, .pushed = kick});
    Input before;
    for (const Moment& m : moments) {
      const Input& u = m.command.input;
      EXPECT_LE(std::abs(u.acceleration), model.limits.acceleration);
      EXPECT_LE(std::abs(u.steering), model.limits.steering);
      EXPECT_LE(std::abs(u.acceleration - before.acceleration), 0.9 + 1e-5);
      EXPECT_LE(std::abs(u.steering - before.steering), 0.1 + 1e-5);
      EXPECT_LE(m.state.speed, 2.5 + 1e-5);
      EXPECT_GE(m.state.speed, -1.0 - 1e-5);
      before = u;
    }
  }
}

TEST(Tracker, TooFastItBrakesIntoTheLimit) {
  Tracker tracker(kCar);
  const auto moments = drive(tracker, kCar, straight(2.4), {.start = {0.0, 0.0, 0.0, 4.0}, .duration = 4.0});
  EXPECT_EQ(moments[0].command.source, Source::tracking);
  EXPECT_LT(moments[0].command.input.acceleration, -2.9);
  EXPECT_LT(moments.back().state.speed, 2.5 + 1e-6);
}

TEST(Tracker, AnyHorizonStepAndPeriod) {
  struct Case {
    int horizon;
    double step, period;
  };
  for (const Case& c :
       {Case{5, 0.1, 0.1}, Case{40, 0.025, 0.025}, Case{20, 0.05, 0.01}, Case{2, 0.2, 0.05}}) {
    Options options;
    options.horizon = c.horizon, options.step = c.step, options.period = c.period;
    Tracker tracker(kCar, options);
    const Course course = circle(1.0, 0.2, kCar.wheelbase);
    State start = course(0).state;
    start.y += 0.1;
    const auto moments = drive(tracker, kCar, course, {.start = start, .duration = 8.0});
    EXPECT_LT(worst_distance(moments, 6.0), 2e-3) << c.horizon << " x " << c.step;
  }
}

TEST(Tracker, RefusesOptionsThatMakeNoSense) {
  const auto refuses = [](auto&& spoil) {
    Options options;
    spoil(options);
    EXPECT_FALSE(options.validate().empty());
    EXPECT_THROW(Tracker(kCar, options), InputError);
  };
  refuses([](Options& o) { o.horizon = 1; });
  refuses([](Options& o) { o.step = 0.0; });
  refuses([](Options& o) { o.step = NAN; });
  refuses([](Options& o) { o.period = 0.06; });
  refuses([](Options& o) { o.dead_time = -0.1; });
  refuses([](Options& o) { o.lag = -0.1; });
  refuses([](Options& o) { o.weights.state[1] = -1.0; });
  refuses([](Options& o) { o.weights.change[0] = NAN; });
  refuses([](Options& o) { o.steering_change = 0.0; });
  Options several;
  several.horizon = 0, several.step = -1.0, several.reuse = -1;
  EXPECT_GE(several.validate().size(), 3u);
}

}  // namespace
}  // namespace seine::mpc
