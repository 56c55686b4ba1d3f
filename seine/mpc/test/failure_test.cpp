// What the tracker does when a plan fails, and that it takes no memory while driving.
#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/count_allocations.hpp"
#include "seine/mpc/test/drive.hpp"

namespace seine::mpc {
namespace {

const vehicle::Model kCar = small_car();

// A solver of ours that reports failure while it is told to.
struct Switch {
  bool fails = false;
  bool nonsense = false;  ///< solutions that are not numbers
};
class Failing final : public optim::QpSolver {
 public:
  Failing(const optim::QpProblem& problem, const optim::QpOptions& options, const Switch& how)
      : solver_(make_qp_solver(problem, options)), how_(how), nan_(problem.q.size(), NAN) {}
  void update(const optim::QpProblem& problem) override { solver_->update(problem); }
  void warm_start(std::span<const double> x, std::span<const double> y) override {
    solver_->warm_start(x, y);
  }
  optim::QpSummary solve() override {
    optim::QpSummary summary = solver_->solve();
    if (how_.fails) summary.status = optim::QpStatus::iteration_limit;
    return summary;
  }
  std::span<const double> x() const override {
    return how_.nonsense ? std::span<const double>(nan_) : solver_->x();
  }
  std::span<const double> y() const override { return solver_->y(); }

 private:
  std::unique_ptr<optim::QpSolver> solver_;
  const Switch& how_;
  std::vector<double> nan_;
};

Tracker failing_tracker(const Switch& how, const Options& options = {}) {
  return Tracker(kCar, options, [&how](const optim::QpProblem& problem, const optim::QpOptions& qp) {
    return std::make_unique<Failing>(problem, qp, how);
  });
}

Disturbance fail_between(Switch& how, double from, double to) {
  return [&how, from, to](double t, State&) { how.fails = t >= from - 1e-9 && t < to - 1e-9; };
}

TEST(Failure, OneFailedPlanIsBridgedByTheLast) {
  Switch how;
  Tracker tracker = failing_tracker(how);
  const Course course = circle(2.0, 0.3, kCar.wheelbase);
  const auto moments =
      drive(tracker, kCar, course,
            {.start = course(0).state, .duration = 4.0, .misread = fail_between(how, 2.0, 2.05)});
  int reused = 0;
  for (const Moment& m : moments) reused += m.command.source == Source::reused;
  EXPECT_EQ(reused, 1);
  EXPECT_LT(worst_after(moments, 1.5, &Moment::distance), 0.01);
}

TEST(Failure, FailuresThatLastEndInAStopAndDrivingGoesOnAfterwards) {
  Switch how;
  Options options;
  Tracker tracker = failing_tracker(how, options);
  const auto moments =
      drive(tracker, kCar, straight(2.0),
            {.start = {0, 0, 0, 2.0}, .duration = 9.0, .misread = fail_between(how, 2.0, 4.5)});
  double back_at = 0.0;
  Input before{};
  for (const Moment& m : moments) {
    const int failed = static_cast<int>(std::lround((m.t - 2.0) / 0.05));
    const Source expected = failed < 0 || failed >= 50 ? Source::tracking
                            : failed < options.reuse   ? Source::reused
                                                       : Source::stopping;
    EXPECT_EQ(m.command.source, expected) << m.t;
    EXPECT_LE(std::abs(m.command.input.acceleration), kCar.limits.acceleration);
    EXPECT_LE(std::abs(m.command.input.acceleration - before.acceleration), 3.0 + 1e-9);
    EXPECT_GT(m.state.speed, -0.02) << m.t;  // a stop, not a retreat
    if (m.t > 4.0 && m.t < 4.5) {
      EXPECT_LT(std::abs(m.state.speed), 0.01) << m.t;
    }
    before = m.command.input;
    back_at = m.distance() > 0.05 ? m.t : back_at;
  }
  EXPECT_GT(back_at, 4.5);  // it fell behind
  EXPECT_LT(moments.back().state.speed, 2.5 + 1e-6);
}

TEST(Failure, ACarThatDrivesBackwardsStopsToo) {
  Switch how;
  Tracker tracker = failing_tracker(how);
  const Course course = circle(-1.5, 0.3, kCar.wheelbase);
  const auto moments =
      drive(tracker, kCar, course,
            {.start = course(0).state, .duration = 4.0, .misread = fail_between(how, 1.0, 9.0)});
  EXPECT_LT(std::abs(moments.back().state.speed), 0.01);
  for (const Moment& m : moments) EXPECT_LT(m.state.speed, 0.02);
}

TEST(Failure, WithoutEverAPlanTheCarIsHeld) {
  Switch how{.fails = true};
  Tracker tracker = failing_tracker(how);
  const auto moments = drive(tracker, kCar, straight(2.0), {.start = {0, 0, 0, 0}, .duration = 1.0});
  for (const Moment& m : moments) {
    EXPECT_EQ(m.command.source, Source::stopping);
    EXPECT_EQ(m.command.input.acceleration, 0.0);
  }
}

TEST(Failure, LocalisationMayDropOutForAMoment) {
  Tracker tracker(kCar);
  const Course course = circle(1.5, 0.2, kCar.wheelbase);
  const auto lost = [](double t, State& s) {
    if (t > 1.99 && t < 2.19) s = {NAN, NAN, NAN, NAN};
  };
  const auto moments =
      drive(tracker, kCar, course, {.start = course(0).state, .duration = 4.0, .misread = lost});
  for (const Moment& m : moments)
    EXPECT_EQ(m.command.source, m.t > 1.99 && m.t < 2.19 ? Source::reused : Source::tracking) << m.t;
  EXPECT_LT(worst_after(moments, 1.0, &Moment::distance), 0.02);
}

TEST(Failure, LocalisationLostForLongEndsInAStop) {
  Tracker tracker(kCar);
  const auto lost = [](double t, State& s) {
    if (t > 0.99) s.x = INFINITY;
  };
  const auto moments =
      drive(tracker, kCar, straight(2.0), {.start = {0, 0, 0, 2.0}, .duration = 4.0, .misread = lost});
  EXPECT_EQ(moments.back().command.source, Source::stopping);
  EXPECT_LT(std::abs(moments.back().state.speed), 0.02);
}

TEST(Failure, AReferenceThatIsNoneIsAFailure) {
  Tracker tracker(kCar);
  std::vector<Sample> reference(21);
  EXPECT_EQ(tracker.step({}, reference).source, Source::tracking);
  reference[7].state.heading = NAN;
  EXPECT_EQ(tracker.step({}, reference).source, Source::reused);
  EXPECT_EQ(tracker.step({}, std::span(reference).first(5)).source, Source::reused);
}

TEST(Failure, NonsenseOfASolverNeverReachesTheCar) {
  Switch how{.fails = false, .nonsense = true};
  Tracker tracker = failing_tracker(how);
  std::vector<Sample> reference(21);
  const Command command = tracker.step({}, reference);
  EXPECT_NE(command.source, Source::tracking);
  EXPECT_TRUE(std::isfinite(command.input.acceleration) && std::isfinite(command.input.steering));
}

TEST(Failure, DrivingTakesNoMemory) {
  Tracker tracker(kCar);
  const Course course = circle(1.5, 0.2, kCar.wheelbase);
  std::vector<Sample> reference(21);
  State state = course(0).state;
  state.y += 0.3;
  for (int i = 0; i < 100; ++i) {
    for (std::size_t k = 0; k < reference.size(); ++k)
      reference[k] = course(0.05 * (i + static_cast<double>(k)));
    if (i == 50) reference[3].state.x = NAN;
    const long before = allocations;
    const Command command = tracker.step(state, reference);
    EXPECT_EQ(allocations - before, 0);
    state = advance(state, command.input, kCar.wheelbase, 0.05);
  }
}

}  // namespace
}  // namespace seine::mpc
