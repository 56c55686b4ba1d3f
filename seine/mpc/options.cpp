#include "seine/mpc/options.hpp"

#include <cmath>

namespace seine::mpc {

std::vector<std::string> Options::validate() const {
  std::vector<std::string> all;
  const auto require = [&](bool holds, const char* text) {
    if (!holds) all.emplace_back(text);
  };
  const auto weight = [](double w) { return std::isfinite(w) && w >= 0.0; };
  require(horizon >= 2 && horizon <= 1000, "horizon must be from 2 to 1000 steps");
  require(std::isfinite(step) && step > 0.0, "step must be positive");
  require(period > 0.0 && period <= step, "period must be positive and at most a step");
  require(dead_time >= 0.0 && dead_time <= 10.0, "dead_time must be from 0 to 10 s");
  require(lag >= 0.0 && lag <= 10.0, "lag must be from 0 to 10 s");
  require(acceleration_change > 0.0 && steering_change > 0.0, "the largest changes must be positive");
  require(authority > 0.0, "authority must be positive");
  require(reuse >= 0, "reuse must not be negative");
  bool weights_are_fine = true;
  for (const double w : weights.state) weights_are_fine = weights_are_fine && weight(w);
  for (const auto* row : {&weights.input, &weights.effort, &weights.change})
    for (const double w : *row) weights_are_fine = weights_are_fine && weight(w);
  require(weights_are_fine, "weights must be finite and not negative");
  return all;
}

}  // namespace seine::mpc
