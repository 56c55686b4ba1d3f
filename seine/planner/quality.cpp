#include <cmath>

#include "seine/planner/planner.hpp"

namespace seine::planner {
namespace {

// Gauss-Legendre nodes and weights of order 5 on [0, 1].
constexpr double kNode[5] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
constexpr double kWeight[5] = {0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                               0.118463442528095};

}  // namespace

Quality measure(const traj::TeamTrajectory& plan) {
  constexpr int kPanels = 8;  // a piece of progress
  Quality quality;
  quality.makespan = plan.makespan();
  for (const traj::RobotTrajectory& robot : plan.robots) {
    quality.mean_travel += robot.arrival() / static_cast<double>(plan.robots.size());
    int gear = 0;  // 0: none yet
    for (const traj::Segment& segment : robot.segments) {
      quality.gear_changes += gear == -segment.gear ? 1 : 0;
      gear = segment.gear;
      const int panels = kPanels * static_cast<int>(segment.progress.size());
      const double width = segment.duration() / panels;
      for (int panel = 0; panel < panels; ++panel)
        for (int k = 0; k < 5; ++k) {
          const traj::State state = traj::evaluate(segment, (panel + kNode[k]) * width);
          quality.distance += width * kWeight[k] * std::abs(state.speed);
          quality.acceleration_cost += width * kWeight[k] *
                                       (state.acceleration * state.acceleration +
                                        state.lateral_acceleration * state.lateral_acceleration);
        }
    }
  }
  return quality;
}

}  // namespace seine::planner
