#include "seine/mpc/tracking_qp.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "seine/base/effort.hpp"
#include "seine/base/rng.hpp"
#include "seine/mpc/test/drive.hpp"

namespace seine::mpc {
namespace {

constexpr std::uint64_t kSeed = 20292;

Options odd_options() {
  Options options;
  options.horizon = 7;
  options.weights = {{3.0, 4.0, 5.0, 6.0}, {0.7, 0.8}, {0.09, 0.11}, {0.2, 0.3}};
  options.acceleration_change = 0.4, options.steering_change = 0.15;
  return options;
}

std::vector<Sample> wavy_reference(Rng& rng, int samples) {
  std::vector<Sample> reference(static_cast<std::size_t>(samples));
  State s{rng.normal(), rng.normal(), rng.uniform(-3, 3), rng.uniform(-2, 2)};
  for (Sample& sample : reference) {
    sample = {s, {rng.uniform(-2, 2), rng.uniform(-0.5, 0.5)}};
    s = advance(s, sample.input, 0.4, 0.05);
    s.heading =
        geom::wrap_angle(s.heading + 0.01 * rng.normal());  // not quite drivable, wrapped like a plan's
  }
  return reference;
}

double squared(double w, double x) {
  return w * x * x;
}

// The supplement's cost, written down once more, in absolute states and inputs.
double cost(const Options& o, const std::vector<Sample>& reference, const std::vector<State>& states,
            const std::vector<Input>& inputs, const Input& last) {
  double sum = 0.0;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const State &x = states[k + 1], &r = reference[k + 1].state;
    sum += squared(o.weights.state[0], x.x - r.x) + squared(o.weights.state[1], x.y - r.y) +
           squared(o.weights.state[2], geom::wrap_angle(x.heading - r.heading)) +
           squared(o.weights.state[3], x.speed - r.speed);
    const InputVector u = vector_of(inputs[k]), w = vector_of(reference[k].input),
                      before = vector_of(k == 0 ? last : inputs[k - 1]);
    for (std::size_t j = 0; j < 2; ++j)
      sum += squared(o.weights.input[j], u[j] - w[j]) + squared(o.weights.effort[j], u[j]) +
             squared(o.weights.change[j], u[j] - before[j]);
  }
  return sum;
}

struct Candidate {
  std::vector<State> states;
  std::vector<Input> inputs;
  std::vector<double> z;
};

// Random inputs, and the states that the linear models make of them.
Candidate random_candidate(Rng& rng, const Options& o, const State& now,
                           const std::vector<Sample>& reference) {
  Candidate c{.states = {now}, .inputs = {}, .z = {}};
  for (std::size_t k = 0; k + 1 < reference.size(); ++k) {
    const Sample& r = reference[k];
    const LinearModel m = linearise(r.state, r.input, 0.4, o.step, o.discretisation);
    c.inputs.push_back({rng.uniform(-3, 3), rng.uniform(-0.7, 0.7)});
    const State& x = c.states.back();
    const StateVector e{x.x - r.state.x, x.y - r.state.y, geom::wrap_angle(x.heading - r.state.heading),
                        x.speed - r.state.speed};
    const InputVector w{c.inputs[k].acceleration - r.input.acceleration,
                        c.inputs[k].steering - r.input.steering};
    StateVector next = vector_of(m.next);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) next[i] += m.A[i][j] * e[j];
      for (std::size_t j = 0; j < 2; ++j) next[i] += m.B[i][j] * w[j];
    }
    c.states.push_back({next[0], next[1], next[2], next[3]});
    const State& to = reference[k + 1].state;
    c.z.insert(c.z.end(), {w[0], w[1], next[0] - to.x, next[1] - to.y, geom::wrap_angle(next[2] - to.heading),
                           next[3] - to.speed});
  }
  return c;
}

TEST(TrackingQp, CostAndModelAreTheSupplements) {
  Rng rng(kSeed);
  const Options options = odd_options();
  TrackingQp qp(small_car(), options);
  for (int i = 0; i < 50; ++i) {
    const std::vector<Sample> reference = wavy_reference(rng, options.horizon + 1);
    State now = reference[0].state;
    now.x += 0.3 * rng.normal(), now.heading += 0.3 * rng.normal(), now.speed += 0.3 * rng.normal();
    const Input last{rng.uniform(-1, 1), rng.uniform(-0.5, 0.5)};
    qp.set(now, last, reference);
    std::vector<double> ax(static_cast<std::size_t>(qp.problem().rows()));
    const Candidate a = random_candidate(rng, options, now, reference),
                    b = random_candidate(rng, options, now, reference);
    std::vector<double> objective;
    for (const Candidate* c : {&a, &b}) {
      // The rows of the model hold, and only they need to.
      multiply(qp.problem().A, c->z, ax);
      for (int k = 0; k < options.horizon; ++k)
        for (int r = 0; r < 4; ++r) {
          const auto row = static_cast<std::size_t>(TrackingQp::kRows * k + r);
          EXPECT_NEAR(ax[row], qp.problem().lower[row], 1e-12);
          EXPECT_EQ(qp.problem().lower[row], qp.problem().upper[row]);
        }
      const std::vector<double> no_multipliers(ax.size());
      objective.push_back(kkt_residuals(qp.problem(), c->z, no_multipliers).objective);
    }
    // Up to a constant.
    EXPECT_NEAR(objective[0] - objective[1],
                cost(options, reference, a.states, a.inputs, last) -
                    cost(options, reference, b.states, b.inputs, last),
                1e-9)
        << "seed " << kSeed << ", case " << i;
  }
}

void bounds_are_the_limits(double lag) {
  Rng rng(kSeed + 1);
  Options options = odd_options();
  options.lag = lag;
  // Of an input: what a step leaves of it, and the mean over the first step of what acts now.
  const double left = lag > 0.0 ? std::exp(-options.step / lag) : 0.0;
  const double mean = lag > 0.0 ? lag / options.step * (1.0 - left) : 0.0;
  const vehicle::Model model = small_car();
  TrackingQp qp(model, options);
  const auto within = [](double value, double low, double high) {
    return value >= low - 1e-12 && value <= high + 1e-12;
  };
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Sample> reference = wavy_reference(rng, options.horizon + 1);
    const Input last{rng.uniform(-1, 1), rng.uniform(-0.5, 0.5)};
    const State now = reference[0].state;
    qp.set(now, last, reference);
    const Candidate c = random_candidate(rng, options, now, reference);
    std::vector<double> ax(static_cast<std::size_t>(qp.problem().rows()));
    multiply(qp.problem().A, c.z, ax);
    for (std::size_t k = 0; k < c.inputs.size(); ++k)
      for (std::size_t row = 4; row < TrackingQp::kRows; ++row) {
        const std::size_t at = TrackingQp::kRows * k + row;
        const bool by_qp = within(ax[at], qp.problem().lower[at], qp.problem().upper[at]);
        const Input before = k == 0 ? last : c.inputs[k - 1];
        const double a = c.inputs[k].acceleration, phi = c.inputs[k].steering, v = c.states[k + 1].speed;
        const double kept = k == 0 ? mean : left, part = 1.0 - kept;
        const bool truth = row == 4   ? within(a - kept * before.acceleration, -3.0 * part, 3.0 * part)
                           : row == 5 ? within(phi - kept * before.steering, -0.7 * part, 0.7 * part)
                           : row == 6 ? within(a - before.acceleration, -1.2, 1.2)
                           : row == 7 ? within(phi - before.steering, -0.15, 0.15)
                                      : within(v, -2.5, 2.5);
        // Beyond the speed limit from the start, as much is allowed as braking cannot prevent.
        if (row == 8 && std::abs(now.speed) > 2.3) continue;
        EXPECT_EQ(by_qp, truth) << "row " << row;
        inside += truth;
      }
  }
  EXPECT_GT(inside, 10000);
}

TEST(TrackingQp, BoundsAreTheLimitsOfInputSpeedAndChange) {
  bounds_are_the_limits(0.0);
}

TEST(TrackingQp, WithLagBoundsAreWhatTheActuatorsReach) {
  bounds_are_the_limits(0.08);
}

void has_a_solution_from_any_state(double lag) {
  Rng rng(kSeed + 2);
  Options options = odd_options();
  options.lag = lag;
  TrackingQp qp(small_car(), options);
  std::unique_ptr<optim::QpSolver> solver;
  for (int i = 0; i < effort(300, 30); ++i) {
    const std::vector<Sample> reference = wavy_reference(rng, options.horizon + 1);
    const State now{10 * rng.normal(), 10 * rng.normal(), rng.uniform(-3, 3), 4 * rng.normal()};
    qp.set(now, {rng.uniform(-3, 3), rng.uniform(-0.7, 0.7)}, reference);
    if (!solver) solver = make_qp_solver(qp.problem(), options.qp);
    solver->update(qp.problem());
    ASSERT_EQ(solver->solve().status, optim::QpStatus::solved) << "seed " << kSeed + 2 << ", case " << i;
    const optim::KktResiduals kkt = kkt_residuals(qp.problem(), solver->x(), solver->y());
    EXPECT_LT(kkt.primal, 1e-5);
    EXPECT_LT(kkt.dual, 1e-3);
  }
}

TEST(TrackingQp, HasASolutionFromAnyState) {
  has_a_solution_from_any_state(0.0);
  has_a_solution_from_any_state(0.1);
}

TEST(TrackingQp, TheReferenceItselfCostsNothingWhenItIsDrivable) {
  Options options;
  TrackingQp qp(small_car(), options);
  const Course course = circle(1.5, 0.3, 0.4);
  std::vector<Sample> reference;
  for (int k = 0; k <= options.horizon; ++k) reference.push_back(course(k * options.step));
  qp.set(reference[0].state, reference[0].input, reference);
  const auto solver = make_qp_solver(qp.problem(), options.qp);
  ASSERT_EQ(solver->solve().status, optim::QpStatus::solved);
  EXPECT_LT(optim::largest(solver->x()), 1e-9);
}

}  // namespace
}  // namespace seine::mpc
