// Where tolerances in metres meet small cars, and where a map ends.
#include <numbers>

#include "bench/deceive/construction.hpp"

namespace seine::deceive {
namespace {

using geom::Vec2;
using traj::Segment;

Segment drive(Vec2 from, Vec2 to, double duration) {
  Segment segment;
  segment.curve = {along(from, to - from, linear(0.0, 1.0))};
  segment.progress = {ramp(0.0, 1.0)};
  segment.piece_duration = duration;
  return segment;
}

/// Two tiny cars head-on, or side by side and overlapping.
Case tiny(Genes genes) {
  const double length = genes.log(1e-4, 0.1), way = genes.uniform(3.0, 30.0) * length;
  const vehicle::Model model = car(length);
  const double aside = genes.uniform(0.0, 0.7) * length;
  Segment there = drive({}, {way, 0.0}, 10.0), back = drive({way, aside}, {0.0, aside}, 10.0);
  Case made = case_of("tiny", model, {{{{there}}, {{back}}}});
  made.scenario.margins.robot = genes.coin() ? 0.0 : genes.uniform(0.0, 0.2) * length;
  return made;
}

/// A tiny car by a wall it touches.
Case scraping(Genes genes) {
  const double length = genes.log(1e-4, 1.0), way = genes.uniform(3.0, 30.0) * length;
  const double wall = (1.0 / 3.0 - genes.log(1e-6, 0.3)) * length;
  Case made = case_of("scraping", car(length), {{{{drive({}, {way, 0.0}, 10.0)}}}});
  made.scenario.margins.obstacle = genes.coin() ? 0.0 : genes.uniform(0.0, 0.2) * length;
  made.scenario.obstacles.push_back(
      {.name = "wall",
       .shape = std::vector<Vec2>{
           {0.0, wall}, {way, wall}, {way, 2.0 * wall + length}, {0.0, 2.0 * wall + length}}});
  return made;
}

/// Arrives, starts or changes gear at a speed that is little in metres and all the car has.
Case slow(Genes genes) {
  const double length = genes.log(1e-3, 1.0), speed = genes.log(1e-4, 1e-2);
  vehicle::Model model = car(length);
  model.limits.speed = model.limits.reverse_speed = speed;
  model.limits.acceleration = genes.log(0.1, 10.0) * speed;
  const double lasts = genes.log(1.0, 300.0), way = genes.uniform(0.1, 1.0) * speed * lasts;
  const double rest_share = genes.uniform(0.0, 1.0);
  Segment segment = drive({}, {way, 0.0}, lasts);
  // between rest to rest and steady
  segment.progress = {{0.0, 1.0 - rest_share, 0.0, 10.0 * rest_share, -15.0 * rest_share, 6.0 * rest_share}};
  Case made = case_of("slow", model, {{{{segment}}}});
  made.scenario.robots[0].start_speed = 0.0;
  if (genes.coin()) {
    Segment back = segment;
    back.gear = -1;
    back.curve = {along({way, 0.0}, {-way, 0.0}, linear(0.0, 1.0))};
    made.plan.robots[0].segments.push_back(back);
    made.scenario.robots[0].goal = made.scenario.robots[0].start;
  }
  return made;
}

/// Starts and ends a little beside where it should.
Case beside_the_goal(Genes genes) {
  const double length = genes.log(1e-4, 1.0), way = genes.uniform(1.0, 10.0) * length;
  Case made = case_of("beside_the_goal", car(length), {{{{drive({}, {way, 0.0}, 10.0)}}}});
  world::Robot& robot = made.scenario.robots[0];
  const double off = genes.log(1e-6, 1e-4);
  const double angle = genes.uniform(-std::numbers::pi, std::numbers::pi);
  geom::Pose2& pose = genes.coin() ? robot.start : *robot.goal;
  pose.x += off * std::cos(angle), pose.y += off * std::sin(angle);
  return made;
}

/// Curves on which a jump of the progress by the granted distance turns a small car a good deal.
Case tiny_arc(Genes genes) {
  const double length = genes.log(1e-4, 0.1);
  vehicle::Model model = car(length);
  const double curvature = genes.uniform(0.3, 0.99) * std::tan(0.7) / model.wheelbase;
  const double hop = genes.log(1e-8, 1e-5), size = genes.uniform(0.5, 1.0) / curvature;
  Segment segment;
  segment.curve = {{{{0.0, size, 0.0, -curvature * curvature * size * size * size / 6.0, 0.0, 0.0},
                     {0.0, 0.0, 0.5 * curvature * size * size, 0.0, 0.0, 0.0}}}};
  const double most = 0.3, there = genes.uniform(0.05, 0.25);
  segment.progress = {ramp(0.0, there), ramp(std::min(there + hop / size, most), most)};
  segment.piece_duration = genes.log(1.0, 100.0);
  return case_of("tiny_arc", model, {{{{segment}}}});
}

/// A picture with walls up to its edges; straight across it from outside to outside.
Case solid_map(Genes genes) {
  const double length = 0.6;
  geom::OccupancyGrid map;
  map.width = 10 + genes.below(40), map.height = 10 + genes.below(40);
  map.resolution = genes.log(0.03, 0.4);
  const double width = map.width * map.resolution, height = map.height * map.resolution;
  map.origin = {-0.5 * width, -0.5 * height, genes.coin() ? 0.0 : genes.uniform(-3.1, 3.1)};
  map.occupied.assign(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height), 0);
  const int sort = genes.below(4), thick = 1 + genes.below(std::min(map.width, map.height) / 2);
  const int low = genes.below(map.height), high = low + 1 + genes.below(map.height - low);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const bool rim = x < thick || x >= map.width - thick || y < thick || y >= map.height - thick;
      const bool band = y >= low && y < high;
      const bool corner = x < 2 * thick && y < 2 * thick;
      const bool blocked = sort == 0 ? rim : sort == 1 ? band : sort == 2 ? corner : rim && band;
      map.occupied[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                   static_cast<std::size_t>(x)] = blocked ? 1 : 0;
    }
  }
  const double reach = 0.5 * std::hypot(width, height) + 2.0 * length, angle = genes.uniform(-3.1, 3.1);
  const double aside = genes.uniform(-0.5, 0.5) * std::min(width, height);
  const Vec2 middle = map.origin * Vec2{0.5 * width, 0.5 * height};
  const Vec2 d = geom::unit(angle), from = middle - reach * d + aside * geom::left_normal(d);
  const double part = genes.coin() ? 2.0 : genes.uniform(0.2, 2.0);  // all across, or parked on the way
  Case made = case_of("solid_map", car(length), {{{{drive(from, from + part * reach * d, 5.0 * reach)}}}});
  made.scenario.map = map;
  return made;
}

}  // namespace

void add_world_constructions(std::vector<Construction>& all) {
  for (const Construction& c : {Construction{"tiny", tiny},
                                {"scraping", scraping},
                                {"slow", slow},
                                {"beside_the_goal", beside_the_goal},
                                {"tiny_arc", tiny_arc},
                                {"solid_map", solid_map}})
    all.push_back(c);
}

}  // namespace seine::deceive
