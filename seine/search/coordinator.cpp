#include "seine/search/coordinator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seine/geom/convex.hpp"

namespace seine::search {
namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

// Per tick, the unit where the car is by this profile.
std::vector<int> units_by_tick(const SpeedLattice& lattice, std::span<const ProfileKnot> profile) {
  const double tick = lattice.grid().half_step();
  std::vector<int> units;
  std::size_t knot = 0;
  int unit = 0;
  for (int q = 0; q * tick <= profile.back().t; ++q) {
    const double t = q * tick;
    while (knot + 2 < profile.size() && profile[knot + 1].t <= t) ++knot;
    const ProfileKnot &a = profile[knot], &b = profile[std::min(knot + 1, profile.size() - 1)];
    const double dt = t - a.t, rate = b.t > a.t ? (b.v - a.v) / (b.t - a.t) : 0.0;
    const double s = a.s + dt * (a.v + 0.5 * dt * rate);
    while (unit < lattice.units() && lattice.s_at(unit + 1) <= s) ++unit;
    units.push_back(unit);
  }
  return units;
}

const SpeedLattice::Group& group_of(const SpeedLattice& lattice, int unit) {
  const auto group = std::lower_bound(lattice.groups().begin(), lattice.groups().end(), unit,
                                      [](const SpeedLattice::Group& g, int u) { return g.last < u; });
  return *group;
}

}  // namespace

Coordinator::Coordinator(const world::Scenario& scenario, const LatticeOptions& lattice,
                         double extra_clearance)
    : scenario_(scenario), extra_clearance_(extra_clearance) {
  for (const vehicle::Model& model : scenario.models) {
    const SpeedGrid grid = speed_grid(model, lattice);
    const double tick = grid.half_step();
    std::size_t clock = 0;
    while (clock < clocks_.size() && clocks_[clock] != tick) ++clock;
    if (clock == clocks_.size()) clocks_.push_back(tick);
    kinds_.push_back({grid, SweptFootprint(model.footprint), clock});
  }
  for (const world::Robot& robot : scenario.robots) {
    const geom::Convex body{scenario.model_of(robot).footprint, 0.0};
    cars_.push_back({&kinds_[idx(robot.model)],
                     {},
                     {},
                     geom::placed(body, robot.start).core,
                     geom::placed(body, robot.goal).core});
  }
  const std::vector<MovingPart> parts = moving_parts(scenario);
  obstacles_.resize(clocks_.size());
  for (std::size_t c = 0; c < clocks_.size(); ++c)
    for (const MovingPart& part : parts) obstacles_[c].emplace_back(part.shape, part.motion, clocks_[c]);
}

bool Coordinator::add_way(int robot, Path path) {
  Car& car = cars_[idx(robot)];
  auto way = std::make_unique<Way>(Way{SpeedLattice(std::move(path), car.kind->grid, car.kind->footprint,
                                                    scenario_.robots[idx(robot)].start_speed),
                                       0.0,
                                       {},
                                       {}});
  if (!way->lattice.drivable()) return false;
  VelocityWorkspace workspace;
  workspace.occupied.reset(way->lattice, 1);
  constexpr int kEndless = 1 << 20;
  VelocityPlan plan = plan_velocity(way->lattice, workspace, {.ticks = kEndless, .want_reach = true});
  if (!plan.found) return false;
  way->alone = plan.arrival;
  way->reach = std::move(plan.reach);
  way->unhindered = units_by_tick(way->lattice, plan.profile);
  car.ways.push_back(std::move(way));
  return true;
}

double Coordinator::alone(int robot) const {
  if (fixed(robot)) return car(robot).fixed->arrival();
  double best = std::numeric_limits<double>::infinity();
  for (const auto& way : ways(robot)) best = std::min(best, way->alone);
  return best;
}

void Coordinator::fix(int robot, const TimedPath& motion, TeamState& state) {
  Car& car = cars_[idx(robot)];
  car.fixed = motion;
  auto placement = std::make_shared<Placement>();
  placement->profile = motion.profile;
  placement->arrival = motion.arrival();
  placement->bodies = bodies_of(motion.path, motion.profile, *car.kind);
  state[idx(robot)] = std::move(placement);
}

std::vector<MovingBody> Coordinator::bodies_of(const Path& path, std::span<const ProfileKnot> profile,
                                               const Kind& kind) const {
  std::vector<MovingBody> bodies;
  bodies.reserve(clocks_.size());
  for (const double tick : clocks_) bodies.emplace_back(path, profile, kind.footprint, tick);
  return bodies;
}

// More than the margin only as far as nobody's start or goal denies it.
double Coordinator::clearance(int a, int b) const {
  const double margin = scenario_.margins.robot;
  if (extra_clearance_ <= 0.0) return margin;
  double room = margin + extra_clearance_;
  for (const auto* mine : {&car(a).at_start, &car(a).at_goal})
    for (const auto* other : {&car(b).at_start, &car(b).at_goal}) {
      const double distance = geom::distance(*mine, *other);
      if (distance >= margin) room = std::min(room, distance);
    }
  return room;
}

VelocityPlan Coordinator::plan_on(int robot, const Way& way, const TeamState& state,
                                  VelocityWorkspace& workspace) const {
  const std::size_t clock = car(robot).kind->clock;
  int ticks = 1;
  for (const auto& other : state)
    if (other) ticks = std::max(ticks, other->bodies[clock].rest_tick() + 2);
  for (const MovingBody& body : obstacles_[clock]) ticks = std::max(ticks, body.rest_tick() + 2);
  Occupied& occupied = workspace.occupied;
  occupied.reset(way.lattice, ticks);
  for (int other = 0; other < robots(); ++other)
    if (other != robot && state[idx(other)])
      occupied.add(way.lattice, state[idx(other)]->bodies[clock], clearance(robot, other), way.reach);
  for (const MovingBody& body : obstacles_[clock])
    occupied.add(way.lattice, body, scenario_.margins.obstacle, way.reach);
  occupied.finish();
  // When all others rest the car needs no longer than alone, plus what it takes to come to a halt first.
  const int horizon = ticks + static_cast<int>(way.unhindered.size()) + 4 * way.lattice.grid().levels;
  return plan_velocity(way.lattice, workspace, {.ticks = horizon, .want_reach = false});
}

std::shared_ptr<const Placement> Coordinator::place_on(int robot, int way, const TeamState& state,
                                                       VelocityWorkspace& workspace) const {
  const Way& on = *ways(robot)[idx(way)];
  VelocityPlan plan = plan_on(robot, on, state, workspace);
  if (!plan.found) return nullptr;
  auto placement = std::make_shared<Placement>();
  placement->way = way;
  placement->arrival = plan.arrival;
  placement->profile = std::move(plan.profile);
  placement->bodies = bodies_of(on.lattice.path(), placement->profile, *car(robot).kind);
  return placement;
}

std::shared_ptr<const Placement> Coordinator::place(int robot, const TeamState& state,
                                                    VelocityWorkspace& workspace) const {
  std::vector<int> order(ways(robot).size());
  for (std::size_t w = 0; w < order.size(); ++w) order[w] = static_cast<int>(w);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return ways(robot)[idx(a)]->alone < ways(robot)[idx(b)]->alone; });
  VelocityPlan best;
  int best_way = -1;
  for (const int way : order) {
    const Way& on = *ways(robot)[idx(way)];
    if (best.found && on.alone >= best.arrival) break;
    VelocityPlan plan = plan_on(robot, on, state, workspace);
    if (!plan.found || (best.found && plan.arrival >= best.arrival)) continue;
    best = std::move(plan);
    best_way = way;
  }
  if (!best.found) return nullptr;
  auto placement = std::make_shared<Placement>();
  placement->way = best_way;
  placement->arrival = best.arrival;
  placement->profile = std::move(best.profile);
  placement->bodies =
      bodies_of(ways(robot)[idx(best_way)]->lattice.path(), placement->profile, *car(robot).kind);
  return placement;
}

std::vector<Coordinator::Conflict> Coordinator::conflicts(int robot, int way, const TeamState& state) const {
  const Way& on = *ways(robot)[idx(way)];
  const std::size_t clock = car(robot).kind->clock;
  std::vector<Conflict> found;
  const auto look = [&](int other, const MovingBody& body, double clear) {
    if (!body.box().inflated(clear).overlaps(on.lattice.box())) return;
    std::size_t e = 0;
    // Past its arrival the car stands at its goal: one more look at the end of time.
    const int last = static_cast<int>(on.unhindered.size());
    for (int q = 0; q <= std::max(last, body.rest_tick()); ++q) {
      while (e + 1 < body.events().size() && body.events()[e].end <= q) ++e;
      const int unit = q < last ? on.unhindered[idx(q)] : on.lattice.units();
      const SpeedLattice::Group& group = group_of(on.lattice, unit);
      if (!group.box.inflated(clear).overlaps(body.events()[e].box)) continue;
      const auto index = static_cast<std::size_t>(&group - on.lattice.groups().data());
      if (apart(on.lattice.polygon(index), body.polygon(static_cast<int>(e)), clear)) continue;
      found.push_back({other, q, unit});
      return;
    }
  };
  for (int other = 0; other < robots(); ++other)
    if (other != robot && state[idx(other)])
      look(other, state[idx(other)]->bodies[clock], clearance(robot, other));
  for (const MovingBody& body : obstacles_[clock]) look(-1, body, scenario_.margins.obstacle);
  std::stable_sort(found.begin(), found.end(),
                   [](const Conflict& a, const Conflict& b) { return a.tick < b.tick; });
  return found;
}

bool Coordinator::touches(int robot, int other, bool goal) const {
  if (ways(robot).empty()) return false;
  const SpeedLattice& lattice = ways(robot).front()->lattice;
  const std::vector<geom::Vec2>& place = goal ? car(other).at_goal : car(other).at_start;
  const double clear = scenario_.margins.robot;
  const geom::Box near = geom::bounding_box(place).inflated(clear);
  if (!near.overlaps(lattice.box())) return false;
  for (const SpeedLattice::Chunk& chunk : lattice.chunks()) {
    if (!chunk.box.overlaps(near)) continue;
    for (int g = chunk.first; g < chunk.last; ++g)
      if (lattice.groups()[idx(g)].box.overlaps(near) && !apart(lattice.polygon(idx(g)), place, clear))
        return true;
  }
  return false;
}

TimedPath Coordinator::motion(int robot, const Placement& placement) const {
  if (placement.way < 0) return *car(robot).fixed;
  return {ways(robot)[idx(placement.way)]->lattice.path(), placement.profile};
}

std::vector<geom::Vec2> Coordinator::footprint_at(int robot, const geom::Pose2& pose) const {
  return geom::placed({scenario_.model_of(scenario_.robots[idx(robot)]).footprint, 0.0}, pose).core;
}

}  // namespace seine::search
