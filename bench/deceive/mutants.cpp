#include "bench/deceive/mutants.hpp"

#include <algorithm>
#include <numbers>

namespace seine::deceive {
namespace {

using geom::Vec2;
using traj::Quintic;
using traj::Segment;

double magnitude(Rng& rng, double low, double high) {
  return (rng.below(2) == 0 ? 1.0 : -1.0) * low * std::pow(high / low, rng.uniform());
}

int pick(Rng& rng, std::size_t count) {
  return rng.below(static_cast<int>(count));
}

/// Adds to a quintic what changes its value and two derivatives at one end and nothing at the other.
void bend_end(Quintic& c, bool end, const std::array<double, 3>& by) {
  const double d0 = by[0], d1 = by[1], d2 = by[2];
  if (end) {
    c[3] += 10.0 * d0 - 4.0 * d1 + 0.5 * d2;
    c[4] += -15.0 * d0 + 7.0 * d1 - d2;
    c[5] += 6.0 * d0 - 3.0 * d1 + 0.5 * d2;
  } else {
    c[0] += d0, c[1] += d1, c[2] += 0.5 * d2;
    c[3] += -10.0 * d0 - 6.0 * d1 - 1.5 * d2;
    c[4] += 15.0 * d0 + 8.0 * d1 + 1.5 * d2;
    c[5] += -6.0 * d0 - 3.0 * d1 - 0.5 * d2;
  }
}

std::array<double, 3> push(Rng& rng, double size) {
  std::array<double, 3> by{};
  by[static_cast<std::size_t>(rng.below(3))] = magnitude(rng, 1e-9, 0.1) * size;
  return by;
}

class Mutation {
 public:
  Mutation(Case& mutant, Rng& rng)
      : case_(mutant),
        rng_(rng),
        robot_(pick(rng, mutant.plan.robots.size())),
        way_(mutant.plan.robots[static_cast<std::size_t>(robot_)]),
        asked_(mutant.scenario.robots[static_cast<std::size_t>(robot_)]),
        model_(mutant.scenario.models[static_cast<std::size_t>(asked_.model)]),
        length_(model_.length()) {}

  void run() {
    if (way_.segments.empty() || rng_.below(4) == 0) return change_question();
    Segment& segment = way_.segments[static_cast<std::size_t>(pick(rng_, way_.segments.size()))];
    switch (rng_.below(10)) {
      case 0:
        return one_coefficient(segment);
      case 1:
        return curve_knot(segment);
      case 2:
        return progress_knot(segment);
      case 3:
        segment.piece_duration *= 1.0 + magnitude(rng_, 1e-9, 0.1);
        return;
      case 4:
        segment.wait = std::max(0.0, segment.wait + magnitude(rng_, 1e-6, 1.0));
        return;
      case 5:
        return halve_progress(segment);
      case 6:
        return jump_progress(segment);
      case 7:
        return stand_between();
      case 8:
        return jump_everywhere(segment);
      default:
        return odd_things(segment);
    }
  }

 private:
  void one_coefficient(Segment& segment) {
    const std::size_t k = static_cast<std::size_t>(rng_.below(6));
    if (rng_.below(2) == 0) {
      auto& piece = segment.curve[static_cast<std::size_t>(pick(rng_, segment.curve.size()))];
      piece[static_cast<std::size_t>(rng_.below(2))][k] += magnitude(rng_, 1e-12, 0.1) * length_;
    } else {
      segment.progress[static_cast<std::size_t>(pick(rng_, segment.progress.size()))][k] +=
          magnitude(rng_, 1e-12, 0.1);
    }
  }

  void curve_knot(Segment& segment) {
    const std::size_t i = static_cast<std::size_t>(pick(rng_, segment.curve.size() + 1));
    const std::size_t axis = static_cast<std::size_t>(rng_.below(2));
    const auto by = push(rng_, length_);
    if (i > 0) bend_end(segment.curve[i - 1][axis], true, by);
    if (i < segment.curve.size()) bend_end(segment.curve[i][axis], false, by);
  }

  void progress_knot(Segment& segment) {
    const std::size_t i = static_cast<std::size_t>(pick(rng_, segment.progress.size() + 1));
    const auto by = push(rng_, 1.0);
    if (i > 0) bend_end(segment.progress[i - 1], true, by);
    if (i < segment.progress.size()) bend_end(segment.progress[i], false, by);
  }

  /// The same motion with twice as many joints.
  void halve_progress(Segment& segment) {
    if (segment.progress.size() > 2000) return;
    std::vector<Quintic> halves;
    for (const Quintic& c : segment.progress) {
      Quintic first, second{};
      double scale = 1.0;
      for (std::size_t k = 0; k < 6; ++k, scale *= 0.5) first[k] = c[k] * scale;
      const double binomial[6][6] = {{1, 0, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0}, {1, 2, 1, 0, 0, 0},
                                     {1, 3, 3, 1, 0, 0}, {1, 4, 6, 4, 1, 0}, {1, 5, 10, 10, 5, 1}};
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t i = 0; i <= k; ++i) second[i] += binomial[k][i] * first[k];
      halves.push_back(first);
      halves.push_back(second);
    }
    segment.progress = std::move(halves);
    segment.piece_duration *= 0.5;
  }

  void jump_progress(Segment& segment) {
    const std::size_t from = static_cast<std::size_t>(pick(rng_, segment.progress.size()));
    const double by = magnitude(rng_, 1e-8, 1.0);
    for (std::size_t j = from; j < segment.progress.size(); ++j) segment.progress[j][0] += by;
  }

  /// A jump at each joint of a whole segment, of the progress or of the curve.
  void jump_everywhere(Segment& segment) {
    const double by = magnitude(rng_, 1e-10, 1e-3);
    if (rng_.below(2) == 0) {
      for (std::size_t j = 1; j < segment.progress.size(); ++j)
        segment.progress[j][0] += by * static_cast<double>(j);
      return;
    }
    const std::size_t axis = static_cast<std::size_t>(rng_.below(2)),
                      k = static_cast<std::size_t>(rng_.below(3));
    for (std::size_t i = 1; i < segment.curve.size(); ++i)
      segment.curve[i][axis][k] += by * length_ * static_cast<double>(i);
  }

  /// Standing segments after one of the segments, each off the one before by a little.
  void stand_between() {
    if (way_.segments.size() > 3000) return;
    const std::size_t after = static_cast<std::size_t>(pick(rng_, way_.segments.size()));
    const Segment& before = way_.segments[after];
    const auto& piece = before.curve.back();
    Vec2 at, d;
    for (std::size_t k = 0; k < 6; ++k) {
      at += {piece[0][k], piece[1][k]};
      d += static_cast<double>(k) * Vec2{piece[0][k], piece[1][k]};
    }
    const double turn = rng_.below(2) == 0 ? magnitude(rng_, 1e-8, 1e-4) : 0.0;
    const double slide = rng_.below(2) == 0 ? magnitude(rng_, 1e-9, 1e-5) : 0.0;
    const int count = 1 << rng_.below(9);
    std::vector<Segment> inserted;
    double heading = std::atan2(d.y, d.x);
    for (int i = 0; i < count; ++i) {
      heading += turn;
      at += slide * geom::left_normal(geom::unit(heading));
      Segment still;
      still.gear = before.gear;
      still.piece_duration = 1e-5;
      still.curve = {along(at, geom::unit(heading), linear(0.0, 0.2 * length_))};
      still.progress = {constant(0.0)};
      inserted.push_back(std::move(still));
    }
    way_.segments.insert(way_.segments.begin() + static_cast<std::ptrdiff_t>(after) + 1, inserted.begin(),
                         inserted.end());
  }

  void odd_things(Segment& segment) {
    switch (rng_.below(4)) {
      case 0:
        segment.gear = -segment.gear;
        return;
      case 1:
        if (way_.segments.size() > 1) way_.segments.pop_back();
        return;
      case 2: {  // another unit of u for one piece of curve
        const double unit = 1.0 + magnitude(rng_, 1e-6, 0.5);
        auto& piece = segment.curve[static_cast<std::size_t>(pick(rng_, segment.curve.size()))];
        double scale = 1.0;
        for (std::size_t k = 0; k < 6; ++k, scale *= unit) piece[0][k] *= scale, piece[1][k] *= scale;
        return;
      }
      default:
        std::swap(way_.segments,
                  case_.plan.robots[static_cast<std::size_t>(pick(rng_, case_.plan.robots.size()))].segments);
    }
  }

  void change_question() {
    world::Scenario& scenario = case_.scenario;
    const double tighter = 1.0 - std::abs(magnitude(rng_, 1e-7, 0.2));
    const double by = magnitude(rng_, 1e-7, 0.3) * length_;
    vehicle::Limits& limits = model_.limits;
    switch (rng_.below(9)) {
      case 0:
        limits.speed *= tighter;
        return;
      case 1:
        limits.acceleration *= tighter;
        return;
      case 2:
        limits.steering *= tighter;
        return;
      case 3:
        limits.lateral_acceleration = std::min(10.0, limits.lateral_acceleration) * tighter;
        return;
      case 4:
        limits.steering_rate = std::min(10.0, limits.steering_rate) * tighter;
        return;
      case 5:
        scenario.margins.robot += std::abs(by);
        return;
      case 6:
        scenario.margins.obstacle += std::abs(by);
        return;
      case 7:
        asked_.start.x += by;
        return;
      default:
        move_obstacle(by);
    }
  }

  void move_obstacle(double by) {
    if (case_.scenario.obstacles.empty()) return;
    auto& obstacle =
        case_.scenario.obstacles[static_cast<std::size_t>(pick(rng_, case_.scenario.obstacles.size()))];
    if (auto* circle = std::get_if<world::Circle>(&obstacle.shape)) circle->center.x += by;
    if (auto* polygon = std::get_if<std::vector<Vec2>>(&obstacle.shape))
      for (Vec2& p : *polygon) p.y += by;
  }

  Case& case_;
  Rng& rng_;
  int robot_;
  traj::RobotTrajectory& way_;
  world::Robot& asked_;
  vehicle::Model& model_;
  double length_;
};

}  // namespace

void mutate(Case& mutant, Rng& rng) {
  const int count = 1 + rng.below(3);
  for (int i = 0; i < count; ++i) Mutation(mutant, rng).run();
}

}  // namespace seine::deceive
