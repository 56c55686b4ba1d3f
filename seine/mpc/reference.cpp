#include "seine/mpc/reference.hpp"

#include <cmath>

namespace seine::mpc {

void sample(const traj::RobotTrajectory& trajectory, double wheelbase, double from, double step,
            std::span<Sample> samples) {
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double t = from + step * static_cast<double>(k);
    const traj::State s = trajectory.at(t), middle = trajectory.at(t + 0.5 * step);
    samples[k] = {{s.pose.x, s.pose.y, s.pose.heading, s.speed},
                  {middle.acceleration, std::atan(wheelbase * middle.curvature)}};
  }
}

}  // namespace seine::mpc
