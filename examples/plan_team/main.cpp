// Two cars change places in a yard with a pillar between them: state the task, plan, read the answer.
#include <cstdio>

#include "seine/base/error.hpp"
#include "seine/planner/planner.hpp"
#include "seine/world/scenario.hpp"

namespace {

seine::world::Scenario two_cars_and_a_pillar() {
  seine::vehicle::Model
      car;  // the numbers not set here are the defaults: 2.5 m/s, 3 m/s², 0.70 rad of steering
  car.footprint = seine::vehicle::rectangle_footprint(0.60, 0.40, 0.10);
  car.limits.lateral_acceleration = 3.0;

  seine::world::Scenario task;
  task.name = "two cars and a pillar";
  task.bounds = {{-5.0, -3.0}, {5.0, 3.0}};
  task.models = {car};
  task.obstacles.push_back({.name = "pillar", .shape = seine::world::Circle{{0.0, 0.0}, 0.5}, .motion = {}});
  // Headings: +x is 0, counter-clockwise. The second car faces the first.
  task.robots.push_back(
      {.name = "left", .start = {-4.0, 0.0, 0.0}, .goal = seine::geom::Pose2{4.0, 0.0, 0.0}});
  task.robots.push_back(
      {.name = "right", .start = {4.0, 0.0, 3.1416}, .goal = seine::geom::Pose2{-4.0, 0.0, 3.1416}});
  return task;
}

}  // namespace

int main() {
  const seine::world::Scenario task = two_cars_and_a_pillar();
  try {
    // Whatever comes back certified has been proved in continuous time, by code that shares nothing with the
    // optimiser.
    const seine::planner::PlanResult result = seine::planner::plan(task, {.deadline_s = 5.0, .threads = 1});
    if (!result.certified) {
      std::printf("no plan: %s\n", result.reason.c_str());
      return 1;
    }
    std::printf("planned in %.3f s, everybody has arrived after %.2f s\n", result.times.compute,
                result.quality.makespan);
    std::printf("closest to each other: %.3f m, to the pillar: %.3f m\n", result.certificate.robots.clearance,
                result.certificate.obstacles.clearance);
    // Any instant can be asked for: the trajectory is a function of time, not a list of samples.
    for (double t = 0.0; t <= result.quality.makespan; t += 1.0) {
      std::printf("%4.1f s", t);
      for (const seine::traj::RobotTrajectory& robot : result.plan.robots) {
        const seine::traj::State state = robot.at(t);
        std::printf("   (%6.2f, %6.2f) %5.2f m/s", state.pose.x, state.pose.y, state.speed);
      }
      std::printf("\n");
    }
  } catch (
      const seine::InputError& wrong) {  // the task itself is wrong: a start in an obstacle, a negative width
    std::printf("%s\n", wrong.what());
    return 2;
  }
  return 0;
}
