#include "seine/mpc/tracking_qp.hpp"

#include <algorithm>
#include <cmath>

#include "seine/geom/pose2.hpp"
#include "seine/mpc/actuators.hpp"

namespace seine::mpc {
namespace {

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// Rows of a step.
constexpr int kDynamics = 0, kInput = 4, kChange = 6, kSpeed = 8;
// Variables of a step: w, then e.
constexpr int kW = 0, kE = 2;
// Entries of A_k and B_k that may differ from 0: with the heading along the first axis of the state's order
// x, y, θ, v.
constexpr bool kStateEntry[4][4] = {{1, 0, 1, 1}, {0, 1, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 1}};
constexpr bool kInputEntry[4][2] = {{1, 1}, {1, 1}, {1, 1}, {1, 0}};
constexpr int kEntries = 4 * 4 + 4 * 2;  // places kept for a step in `dynamics_`

StateVector difference(const State& a, const State& b) {
  return {a.x - b.x, a.y - b.y, geom::wrap_angle(a.heading - b.heading), a.speed - b.speed};
}

double clamp(double value, double most) {
  return std::min(std::max(value, -most), most);
}

}  // namespace

TrackingQp::TrackingQp(const vehicle::Model& model, const Options& options)
    : options_(options),
      model_(model),
      horizon_(options.horizon),
      most_{model.limits.acceleration, model.limits.steering},
      change_{options.acceleration_change * model.limits.acceleration,
              std::min(options.steering_change, model.limits.steering_rate * options.step)},
      kept_(options.lag > 0.0 ? std::exp(-options.step / options.lag) : 0.0),
      first_kept_(Actuators::kept_on_average(options.lag, options.period)),
      prices_(at(options.horizon), 1.0),
      reference_(at(options.horizon)) {
  lay_out();
  price();
}

// The pattern of A, with ones and minus ones where they stay, and the places of what changes.
void TrackingQp::lay_out() {
  std::vector<optim::Triplet> entries;
  std::vector<std::pair<int, int>> places;  // row and column of each of the model's entries; −1: none
  for (int k = 0; k < horizon_; ++k) {
    const int row = kRows * k, w = kVariables * k + kW, e = kVariables * k + kE, before = e - kVariables;
    for (int i = 0; i < 4; ++i) {
      entries.push_back({row + kDynamics + i, e + i, 1.0});
      for (int j = 0; j < 4; ++j)
        places.emplace_back(row + kDynamics + i, k > 0 && kStateEntry[i][j] ? before + j : -1);
      for (int j = 0; j < 2; ++j) places.emplace_back(row + kDynamics + i, kInputEntry[i][j] ? w + j : -1);
    }
    for (int j = 0; j < 2; ++j) {
      entries.push_back({row + kInput + j, w + j, 1.0});
      entries.push_back({row + kChange + j, w + j, 1.0});
      if (k > 0) entries.push_back({row + kChange + j, w + j - kVariables, -1.0});
      if (k > 0 && kept_ > 0.0) entries.push_back({row + kInput + j, w + j - kVariables, -kept_});
    }
    entries.push_back({row + kSpeed, e + 3, 1.0});
  }
  for (const auto& [row, col] : places)
    if (col >= 0) entries.push_back({row, col, 0.0});
  problem_.A = optim::from_triplets(kRows * horizon_, kVariables * horizon_, entries);
  problem_.lower.resize(at(kRows * horizon_));
  problem_.upper.resize(problem_.lower.size());
  for (const auto& [row, col] : places) {
    if (col < 0) {
      dynamics_.push_back(-1);
      continue;
    }
    const auto from = problem_.A.row.begin() + problem_.A.begin[at(col)],
               to = problem_.A.row.begin() + problem_.A.begin[at(col) + 1];
    dynamics_.push_back(static_cast<int>(std::lower_bound(from, to, row) - problem_.A.row.begin()));
  }
}

// Twice the weights, because of the ½ in ½ xᵀP x; only the price of steering hangs on the reference.
void TrackingQp::price() {
  const Weights& weights = options_.weights;
  std::vector<optim::Triplet> entries;
  for (int k = 0; k < horizon_; ++k) {
    const int w = kVariables * k + kW, e = kVariables * k + kE;
    for (int i = 0; i < 4; ++i) entries.push_back({e + i, e + i, 2.0 * weights.state[at(i)]});
    for (int j = 0; j < 2; ++j) {
      const double change = weights.change[at(j)];
      const double both = k + 1 < horizon_ ? 2.0 * change : change;  // to the input before, and from the next
      entries.push_back({w + j, w + j, 2.0 * (weights.input[at(j)] + weights.effort[at(j)] + both)});
      if (k > 0) entries.push_back({w + j - kVariables, w + j, -2.0 * change});
    }
  }
  problem_.P = optim::from_triplets(kVariables * horizon_, kVariables * horizon_, entries);
  problem_.q.resize(at(kVariables * horizon_));
}

// A wheel that turns a fast car sharply is priced as it turns the car: by the lateral acceleration, not by
// the angle. With the price of the angle alone a fast car would steer to and fro at the rate its wheel
// allows.
double TrackingQp::steering_price(double speed) const {
  const double authority = speed * speed / model_.wheelbase / options_.authority;
  return authority > 1.0 ? authority * authority : 1.0;
}

void TrackingQp::price_steering(std::span<const Sample> reference) {
  const Weights& weights = options_.weights;
  for (int k = 0; k < horizon_; ++k) prices_[at(k)] = steering_price(reference[at(k)].state.speed);
  for (int k = 0; k < horizon_; ++k) {
    const double own = prices_[at(k)] * weights.change[1];
    const double next = k + 1 < horizon_ ? prices_[at(k + 1)] * weights.change[1] : 0.0;
    const std::size_t column = at(kVariables * k + kW + 1);
    const auto last = at(problem_.P.begin[column + 1] - 1);  // the diagonal; before it the input before
    problem_.P.value[last] = 2.0 * (prices_[at(k)] * weights.input[1] + weights.effort[1] + own + next);
    if (k > 0) problem_.P.value[last - 1] = -2.0 * own;
  }
}

void TrackingQp::set_model(std::size_t k, const LinearModel& m, const StateVector& drift) {
  const int* place = &dynamics_[k * kEntries];
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j, ++place)
      if (*place >= 0) problem_.A.value[at(*place)] = -m.A[i][j];
    for (std::size_t j = 0; j < 2; ++j, ++place)
      if (*place >= 0) problem_.A.value[at(*place)] = -m.B[i][j];
    const std::size_t row = k * kRows + kDynamics + i;
    problem_.lower[row] = problem_.upper[row] = drift[i];
  }
}

void TrackingQp::set(const State& now, const Input& last, std::span<const Sample> reference) {
  const StateVector start = difference(now, reference[0].state);
  for (std::size_t k = 0; k < reference_.size(); ++k) {
    reference_[k] = reference[k].input;
    const LinearModel m = linearise(reference[k].state, reference[k].input, model_.wheelbase, options_.step,
                                    options_.discretisation);
    // d_k = f(X^ref, U^ref) − X^ref_{k+1}: what the reference itself is not drivable by; for k = 0 also A
    // e_0.
    StateVector drift = difference(m.next, reference[k + 1].state);
    for (std::size_t i = 0; k == 0 && i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) drift[i] += m.A[i][j] * start[j];
    set_model(k, m, drift);
  }
  price_steering(reference);
  set_bounds(now, last, reference);
}

void TrackingQp::set_bounds(const State& now, const Input& last, std::span<const Sample> reference) {
  std::fill(problem_.q.begin(), problem_.q.end(), 0.0);
  const InputVector most = vector_of(most_), change = vector_of(change_);
  const double first = options_.period / options_.step;  // of a step's change, since the last command
  InputVector before = vector_of(last);
  // The speeds that braking as hard, and speeding up as hard, as is allowed would reach.
  double braked = now.speed, pushed = now.speed, brake = last.acceleration, push = last.acceleration;
  for (std::size_t k = 0; k < reference_.size(); ++k) {
    const std::size_t row = k * kRows, w = k * kVariables + kW;
    const InputVector wanted = vector_of(reference_[k]);
    const double kept = k == 0 ? first_kept_ : kept_;
    for (std::size_t j = 0; j < 2; ++j) {
      const double reach = (1.0 - kept) * most[j], gap = wanted[j] - kept * before[j];
      problem_.lower[row + kInput + j] = -reach - gap;
      problem_.upper[row + kInput + j] = reach - gap;
      const double step = wanted[j] - before[j], allowed = k == 0 ? first * change[j] : change[j];
      problem_.lower[row + kChange + j] = -allowed - step;
      problem_.upper[row + kChange + j] = allowed - step;
      const double price = 2.0 * (j == 1 ? prices_[k] : 1.0) * options_.weights.change[j] * step;
      problem_.q[w + j] += price + 2.0 * options_.weights.effort[j] * wanted[j];
      if (k > 0) problem_.q[w + j - kVariables] -= price;
    }
    const double allowed = k == 0 ? first * change_.acceleration : change_.acceleration;
    const double reach = (1.0 - kept) * most_.acceleration;
    brake = std::max(brake - allowed, kept * brake - reach);
    push = std::min(push + allowed, kept * push + reach);
    braked += brake * options_.step, pushed += push * options_.step;
    const double speed = reference[k + 1].state.speed;
    problem_.lower[row + kSpeed] = std::min(-model_.limits.reverse_speed, pushed) - speed;
    problem_.upper[row + kSpeed] = std::max(model_.limits.speed, braked) - speed;
    before = wanted;
  }
}

Input TrackingQp::input(std::span<const double> solution, int k) const {
  const std::size_t w = at(kVariables * k + kW);
  const Input& wanted = reference_[at(k)];
  return {clamp(wanted.acceleration + solution[w], most_.acceleration),
          clamp(wanted.steering + solution[w + 1], most_.steering)};
}

void TrackingQp::shift(std::span<double> values, int block) {
  std::copy(values.begin() + block, values.end(), values.begin());
}

}  // namespace seine::mpc
