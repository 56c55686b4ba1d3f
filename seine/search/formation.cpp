#include "seine/search/formation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seine/search/formation_steps.hpp"

namespace seine::search {

using geom::Pose2;
using geom::Vec2;

Pose2 formation_frame(const world::Scenario& scenario) {
  Vec2 position, direction;
  for (const world::Robot& robot : scenario.robots) {
    position += robot.start.position();
    direction += robot.start.direction();
  }
  position *= 1.0 / static_cast<double>(scenario.robots.size());
  const bool undecided = geom::squared_norm(direction) < 1e-12;
  return {position.x, position.y,
          undecided ? scenario.robots.front().start.heading : std::atan2(direction.y, direction.x)};
}

Formation start_formation(const world::Scenario& scenario) {
  const Vec2 frame = formation_frame(scenario).position();
  Formation formation;
  for (const world::Robot& robot : scenario.robots)
    formation.offsets.push_back(robot.start.position() - frame);
  return formation;
}

void between(const Formation& from, const Formation& to, double share, Formation& out) {
  const double r = std::clamp(share, 0.0, 1.0), smooth = r * r * (3.0 - 2.0 * r);
  out.lowest = std::min(from.lowest, to.lowest);
  out.offsets.resize(from.offsets.size());
  for (std::size_t k = 0; k < from.offsets.size(); ++k)
    out.offsets[k] = (1.0 - smooth) * from.offsets[k] + smooth * to.offsets[k];
}

void attachments_at(const world::Scenario& scenario, const Formation& formation, const Pose2& frame,
                    std::vector<Vec2>& out) {
  const Vec2 d = frame.direction();
  out.resize(formation.offsets.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Vec2 at = scenario.net->attachments[k].at;
    out[k] = frame.position() + formation.offsets[k] + Vec2{d.x * at.x - d.y * at.y, d.y * at.x + d.x * at.y};
  }
}

TeamLimits limits_of(const world::Scenario& scenario) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  TeamLimits all{kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, 0.0};
  for (const world::Robot& robot : scenario.robots) {
    const vehicle::Model& model = scenario.model_of(robot);
    all.speed = std::min(all.speed, model.limits.speed);
    all.reverse_speed = std::min(all.reverse_speed, model.limits.reverse_speed);
    all.acceleration = std::min(all.acceleration, model.limits.acceleration);
    all.lateral = std::min(all.lateral, model.limits.lateral_acceleration);
    all.curvature = std::min(all.curvature, model.max_curvature());
    all.length = std::max(all.length, model.length());
  }
  return all;
}

}  // namespace seine::search
