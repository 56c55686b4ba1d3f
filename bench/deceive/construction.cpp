#include "bench/deceive/construction.hpp"

#include "bench/deceive/documented.hpp"

namespace seine::deceive {

using geom::Vec2;
using traj::Quintic;

std::vector<Construction> constructions() {
  std::vector<Construction> all;
  add_tangent_constructions(all);
  add_joint_constructions(all);
  add_world_constructions(all);
  return all;
}

vehicle::Model car(double length) {
  vehicle::Model model;
  const double half = length / 3.0, back = -length / 6.0;
  model.footprint = {{back, -half}, {back + length, -half}, {back + length, half}, {back, half}};
  model.wheelbase = 2.0 / 3.0 * length;
  return model;
}

Quintic ramp(double from, double to) {
  const double d = to - from;
  return {from, 0.0, 0.0, 10.0 * d, -15.0 * d, 6.0 * d};
}

std::array<Quintic, 2> along(Vec2 from, Vec2 direction, const Quintic& c) {
  std::array<Quintic, 2> piece;
  for (std::size_t k = 0; k < 6; ++k) piece[0][k] = direction.x * c[k], piece[1][k] = direction.y * c[k];
  piece[0][0] += from.x, piece[1][0] += from.y;
  return piece;
}

Case case_of(const char* name, const vehicle::Model& model, traj::TeamTrajectory plan) {
  Case made;
  made.name = name;
  made.scenario.name = name;
  made.scenario.models = {model};
  made.scenario.margins = {0.0, 0.0};
  double far = 10.0 * model.length();
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const auto& way = plan.robots[k];
    double end = 0.0;
    for (const auto& segment : way.segments) {
      end += segment.wait + segment.piece_duration * static_cast<double>(segment.progress.size());
      for (const auto& piece : segment.curve) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 6; ++i) sum += std::abs(piece[0][i]) + std::abs(piece[1][i]);
        far = std::max(far, 2.0 * sum);
      }
    }
    const double speed = sight(way.segments.front(), 0, 0.0).speed;
    made.scenario.robots.push_back({.name = "car" + std::to_string(k),
                                    .start = pose_at(way, 0.0),
                                    .start_speed = way.segments.front().wait > 0.0 ? 0.0 : speed,
                                    .goal = pose_at(way, end + 1.0)});
  }
  far = std::min(far, 5e5);
  made.scenario.bounds = {{-far, -far}, {far, far}};
  made.plan = std::move(plan);
  return made;
}

}  // namespace seine::deceive
