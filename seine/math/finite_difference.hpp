#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace seine::math {

/// How an analytic gradient compares with central differences.
struct GradientCheck {
  double worst = 0.0;  ///< largest |analytic − numeric| over max(1, largest |analytic|)
  int index = -1;      ///< where
};

/// Compares `gradient` (of f at x) with central differences on a ladder of steps, taking for each entry the
/// step that agrees best: too long a step sees curvature, too short a one sees rounding.
inline GradientCheck check_gradient(const std::function<double(std::span<const double>)>& f,
                                    std::span<const double> x, std::span<const double> gradient) {
  std::vector<double> moved(x.begin(), x.end());
  double scale = 1.0;
  for (const double g : gradient) scale = std::max(scale, std::abs(g));
  GradientCheck check;
  for (std::size_t i = 0; i < x.size(); ++i) {
    double best = std::numeric_limits<double>::infinity();
    for (const double h : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
      const double step = h * std::max(1.0, std::abs(x[i]));
      moved[i] = x[i] + step;
      const double ahead = f(moved);
      moved[i] = x[i] - step;
      const double behind = f(moved);
      moved[i] = x[i];
      const double error = std::abs((ahead - behind) / (2.0 * step) - gradient[i]) / scale;
      if (!(error >= best)) best = error;
    }
    if (!(best <= check.worst)) check = {best, static_cast<int>(i)};
  }
  return check;
}

}  // namespace seine::math
