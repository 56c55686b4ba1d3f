#include "seine/io/svg_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "seine/io/number_text.hpp"
#include "seine/net/flight.hpp"

namespace seine::io {
namespace {

void include_car(const vehicle::Model& model, const geom::Pose2& pose, geom::Box& box) {
  for (const geom::Vec2 corner : model.footprint) box.include(pose * corner);
}

/// Where targets fall through the rim, and where they are brought.
void include_net_task(const world::Scenario& scenario, geom::Box& box) {
  if (!scenario.net) return;
  for (const net::Target& target : scenario.targets) {
    if (const auto crossing = net::Flight(target).crossing(scenario.net->rim()))
      box.include(crossing->state.position.ground());
  }
  if (!scenario.delivery) return;
  const geom::Vec2 reach{scenario.delivery->radius, scenario.delivery->radius};
  box.include(scenario.delivery->center - reach);
  box.include(scenario.delivery->center + reach);
}

/// Where obstacles go while the plan lasts; without a plan, everywhere they go.
void include_movers(const world::Scenario& scenario, const traj::TeamTrajectory* plan, geom::Box& box) {
  for (const world::Obstacle& obstacle : scenario.obstacles) {
    if (obstacle.motion.empty() || world::stands_still(obstacle)) continue;
    geom::Box body;
    if (const auto* circle = std::get_if<world::Circle>(&obstacle.shape)) {
      body = geom::Box{circle->center, circle->center}.inflated(circle->radius);
    } else {
      for (const geom::Vec2 p : std::get<std::vector<geom::Vec2>>(obstacle.shape)) body.include(p);
    }
    const double reach = std::max(geom::norm(body.low), geom::norm(body.high));
    const double end = plan != nullptr ? plan->makespan() : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < obstacle.motion.size(); ++i) {
      const world::Waypoint& waypoint = obstacle.motion[i];
      const bool before = i + 1 < obstacle.motion.size() && obstacle.motion[i + 1].t <= 0.0;
      const bool after = i > 0 && obstacle.motion[i - 1].t >= end;
      if (before || after) continue;
      box.include(waypoint.pose.position() - geom::Vec2{reach, reach});
      box.include(waypoint.pose.position() + geom::Vec2{reach, reach});
    }
  }
}

/// Where the cars are at any time, m.
geom::Box used_part(const world::Scenario& scenario, const traj::TeamTrajectory* plan) {
  constexpr int kSamples = 60;  // a car; the room around hides what lies between
  geom::Box box;
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const world::Robot& robot = scenario.robots[k];
    const vehicle::Model& model = scenario.model_of(robot);
    include_car(model, robot.start, box);
    if (robot.goal) include_car(model, *robot.goal, box);
    if (plan == nullptr || k >= plan->robots.size() || plan->robots[k].segments.empty()) continue;
    const double arrival = plan->robots[k].arrival();
    for (int i = 0; i <= kSamples; ++i)
      include_car(model, plan->robots[k].at(arrival * i / kSamples).pose, box);
  }
  include_net_task(scenario, box);
  include_movers(scenario, plan, box);
  return box;
}

}  // namespace

SvgView choose_view(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                    const SvgOptions& options, geom::Vec2 corner) {
  SvgView view{scenario.bounds, 1.0, corner};
  geom::Box part = used_part(scenario, plan);
  if (!options.whole && !part.empty()) {
    part = part.inflated(0.12 * std::max(part.size().x, part.size().y) + 1.0);
    const geom::Box& all = scenario.bounds;
    part = {{std::max(part.low.x, all.low.x), std::max(part.low.y, all.low.y)},
            {std::min(part.high.x, all.high.x), std::min(part.high.y, all.high.y)}};
    const bool small = !part.empty() && part.size().x * part.size().y < 0.5 * all.size().x * all.size().y;
    if (small) view.world = part;
  }
  view.scale = options.size / std::max({view.world.size().x, view.world.size().y, 1e-6});
  return view;
}

std::string px(double value) {
  return rounded_text(value, 2);
}

std::string px(geom::Vec2 point) {
  return px(point.x) + " " + px(point.y);
}

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (static_cast<unsigned char>(c) >= 0x20) {
      out += c;
    }
  }
  return out;
}

double round_below(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  const double digits = value / decade;
  return decade * (digits >= 5.0 ? 5.0 : digits >= 2.0 ? 2.0 : 1.0);
}

}  // namespace seine::io
