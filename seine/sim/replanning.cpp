#include "seine/sim/replanning.hpp"

#include <algorithm>
#include <optional>

#include "seine/net/catch_rules.hpp"
#include "seine/net/flight.hpp"

namespace seine::sim {
namespace {

using geom::Vec2;

constexpr double kSameShortfall = 1e-3;  // m
constexpr double kWorthWhile = 0.05;     // s sooner, for a change of plan that catches no better
constexpr double kMoment = 1e-3;         // s, for velocities and accelerations

double lack(double value, double least) {
  return std::max(0.0, least - value);
}

Vec2 mean(std::span<const Vec2> points) {
  Vec2 sum;
  for (const Vec2 point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::vector<Vec2> attachments_at(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                                 double plan_time) {
  std::vector<Vec2> attachments;
  for (std::size_t k = 0; k < plan.robots.size(); ++k)
    attachments.push_back(plan.robots[k].at(plan_time).pose * scenario.net->attachments[k].at);
  return attachments;
}

Worth worth_of(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double begin,
               std::span<const net::Target> targets) {
  Worth worth{.arrival = begin + plan.makespan()};
  for (const net::Target& target : targets) {
    const auto crossing = net::Flight(target).crossing(scenario.net->rim());
    if (!crossing) continue;
    const double then = crossing->state.time - begin;
    const std::vector<Vec2> held = attachments_at(scenario, plan, then);
    const Vec2 before = mean(attachments_at(scenario, plan, then - kMoment)), now = mean(held),
               after = mean(attachments_at(scenario, plan, then + kMoment));
    const net::Motion motion{(after - before) / (2.0 * kMoment),
                             (after - 2.0 * now + before) / (kMoment * kMoment)};
    const net::Catch c = net::measure_catch(*scenario.net, target, *crossing, held, motion);
    worth.shortfall += lack(c.rim_margin, net::kRimMargin) + lack(c.contact_margin, net::kContactMargin) +
                       lack(c.opening, net::kLeastOpening);
  }
  return worth;
}

bool better(const Worth& candidate, const Worth& current) {
  if (candidate.shortfall < current.shortfall - kSameShortfall) return true;
  return candidate.shortfall <= current.shortfall && candidate.arrival < current.arrival - kWorthWhile;
}

world::Scenario task_left(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double plan_time,
                          double time, std::span<const net::Target> targets) {
  world::Scenario task = scenario;
  for (std::size_t k = 0; k < task.robots.size(); ++k) {
    const traj::State state = plan.robots[k].at(plan_time);
    task.robots[k].start = state.pose;
    task.robots[k].start_speed = state.speed;
  }
  for (world::Obstacle& obstacle : task.obstacles)
    for (world::Waypoint& waypoint : obstacle.motion) waypoint.t -= time;
  task.targets.assign(targets.begin(), targets.end());
  for (net::Target& target : task.targets) target.time -= time;
  if (targets.size() < scenario.targets.size() && !task.payload)
    task.payload = net::Payload{scenario.targets.front().radius, scenario.targets.front().mass};
  return task;
}

}  // namespace seine::sim
