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

// Where a goal is further off the units of the way are longer.
constexpr double kMostUnitsAhead = 100e3;

// m, by model: the furthest that a goal lies from its start.
std::vector<double> furthest_goals(const world::Scenario& scenario) {
  std::vector<double> furthest(scenario.models.size(), 0.0);
  for (const world::Robot& robot : scenario.robots) {
    double& most = furthest[idx(robot.model)];
    most = std::max(most, geom::norm(robot.goal->position() - robot.start.position()));
  }
  return furthest;
}

// The first tick at which the unhindered drive hits a mark, or −1.
int first_hit(const VelocityPlan& plan, std::span<const Mark> marks) {
  const int last = static_cast<int>(plan.tested.size()) - 1;
  int first = -1;
  for (const Mark& mark : marks) {
    const int until = std::min(mark.end, last + 1);
    for (int q = mark.begin; q < until && (first < 0 || q < first); ++q)
      if (mark.first <= plan.tested[idx(q)] && plan.tested[idx(q)] <= mark.last) first = q;
    // After its arrival the car stands at its goal.
    const int later = std::max(mark.begin, last + 1);
    if (mark.end > later && mark.last >= plan.tested[idx(last)] && (first < 0 || later < first))
      first = later;
  }
  return first;
}

}  // namespace

Coordinator::Coordinator(const world::Scenario& scenario, const LatticeOptions& lattice,
                         double extra_clearance, const Deadline& deadline)
    : scenario_(scenario), extra_clearance_(extra_clearance), deadline_(deadline) {
  const std::vector<double> furthest = furthest_goals(scenario);
  for (std::size_t m = 0; m < scenario.models.size(); ++m) {
    const vehicle::Model& model = scenario.models[m];
    LatticeOptions fitting = lattice;
    fitting.least_unit = std::max(lattice.least_unit, furthest[m] / kMostUnitsAhead);
    const SpeedGrid grid = speed_grid(model, fitting);
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
                     geom::placed(body, *robot.goal).core});
  }
  const std::vector<MovingPart> parts = moving_parts(scenario);
  for (const MovingPart& part : parts) part_of_.push_back(part.obstacle);
  obstacles_.resize(clocks_.size());
  for (std::size_t c = 0; c < clocks_.size(); ++c)
    for (const MovingPart& part : parts) obstacles_[c].emplace_back(part.shape, part.motion, clocks_[c]);
}

std::shared_ptr<Way> Coordinator::make_way(int robot, Path path, bool careful) const {
  const Kind& kind = *car(robot).kind;
  const double start_speed = scenario_.robots[idx(robot)].start_speed;
  auto way = std::make_shared<Way>(
      Way{SpeedLattice(std::move(path), kind.grid, kind.footprint, start_speed, careful), 0.0, {}, {}, 0});
  if (!way->lattice.drivable()) return nullptr;
  way->reach = way->lattice.reach();
  way->alone = kind.grid.half_step() * static_cast<double>(std::max<std::size_t>(way->reach.size(), 1) - 1);
  way->serial = ++serial_;
  return way;
}

bool Coordinator::finish_way(Way& way) const {
  VelocityWorkspace workspace;
  workspace.occupied.reset(way.lattice, 1);
  // The plan is the same for every horizon that admits one; a near one leaves little to look at.
  const int least = static_cast<int>(way.reach.size());
  for (int more = 64; !way.unhindered.found && more <= 4 * least + 1024 && !deadline_.expired(); more *= 4)
    way.unhindered = plan_velocity(way.lattice, workspace, {.ticks = least + more, .deadline = deadline_});
  way.alone = way.unhindered.arrival;
  return way.unhindered.found;
}

bool Coordinator::add_way(int robot, Path path) {
  std::shared_ptr<Way> way = make_way(robot, std::move(path));
  if (!way || !finish_way(*way)) return false;
  keep_way(robot, std::move(way));
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
  placement->serial = ++serial_;
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

// What `other` (−1 − p: moving obstacle p) takes of the way.
std::span<const Mark> Coordinator::taken(int robot, const Way& way, int other, const TeamState& state,
                                         CoordinatorWorkspace& workspace) const {
  const std::size_t clock = car(robot).kind->clock;
  const bool obstacle = other < 0;
  const auto part = static_cast<std::uint32_t>(-1 - other);
  const MovingBody& body = obstacle ? obstacles_[clock][part] : state[idx(other)]->bodies[clock];
  const double margin = obstacle ? scenario_.margins.obstacle : clearance(robot, other);
  if (!body.box().inflated(margin).overlaps(way.lattice.box())) return {};
  // Placements count up from 1, obstacles down from the other end.
  const std::uint32_t whose = obstacle ? ~part : state[idx(other)]->serial;
  const std::uint64_t key = std::uint64_t{way.serial} << 32 | whose;
  const auto [entry, fresh] = workspace.marks.try_emplace(key);
  if (fresh) entry->second = marks_of(way.lattice, body, margin, way.reach);
  return entry->second;
}

VelocityPlan Coordinator::plan_on(int robot, const Way& way, const TeamState& state,
                                  CoordinatorWorkspace& workspace, double latest, double delay) const {
  constexpr std::size_t kMostMarks = 50000;
  if (workspace.marks.size() > kMostMarks) workspace.marks.clear();
  const std::size_t clock = car(robot).kind->clock;
  const int parts = static_cast<int>(obstacles_[clock].size());
  workspace.taken.clear();
  int ticks = 1;
  bool hindered = !way.unhindered.found;
  for (int other = -parts; other < robots(); ++other) {
    if (other == robot || (other >= 0 && !state[idx(other)])) continue;
    const std::span<const Mark> marks = taken(robot, way, other, state, workspace);
    if (marks.empty()) continue;
    workspace.taken.push_back(marks);
    hindered = hindered || first_hit(way.unhindered, marks) >= 0;
    for (const Mark& mark : marks)
      ticks = std::max(ticks, mark.end == MovingBody::kForever ? mark.begin + 1 : mark.end + 1);
  }
  const Mark waits{0, static_cast<int>(delay / way.lattice.grid().half_step()), 1, way.lattice.units()};
  if (waits.end > 0) {
    workspace.taken.push_back({&waits, 1});
    hindered = true;
    ticks = std::max(ticks, waits.end + 1);
  }
  if (!hindered) return way.unhindered;
  // Whatever comes later than this stays for good, as far as this car is concerned.
  constexpr int kMostTicks = 1 << 15;
  ticks = std::min(ticks, kMostTicks);
  Occupied& occupied = workspace.velocity.occupied;
  occupied.reset(way.lattice, ticks);
  for (const std::span<const Mark> marks : workspace.taken) occupied.add(marks);
  occupied.finish();
  // When all others rest the car needs no longer than alone, plus what it takes to come to a halt first.
  const std::size_t alone = std::max(way.unhindered.tested.size(), way.reach.size() + way.reach.size() / 4);
  int horizon = ticks + static_cast<int>(alone) + 4 * way.lattice.grid().levels;
  const double tick = way.lattice.grid().half_step();
  if (latest < horizon * tick) horizon = static_cast<int>(latest / tick);
  return plan_velocity(way.lattice, workspace.velocity, {.ticks = horizon, .deadline = deadline_});
}

std::shared_ptr<const Placement> Coordinator::placement(int robot, const WayPtr& way,
                                                        VelocityPlan plan) const {
  if (!plan.found) return nullptr;
  auto placement = std::make_shared<Placement>();
  placement->way = way;
  placement->arrival = plan.arrival;
  placement->profile = std::move(plan.profile);
  placement->bodies = bodies_of(way->lattice.path(), placement->profile, *car(robot).kind);
  placement->serial = ++serial_;
  return placement;
}

std::shared_ptr<const Placement> Coordinator::place_on(int robot, const WayPtr& way, const TeamState& state,
                                                       CoordinatorWorkspace& workspace, double latest) const {
  if (way->alone > latest) return nullptr;
  return placement(robot, way, plan_on(robot, *way, state, workspace, latest));
}

std::shared_ptr<const Placement> Coordinator::place_after(double delay, int robot, const WayPtr& way,
                                                          const TeamState& state,
                                                          CoordinatorWorkspace& workspace) const {
  constexpr double kWhenever = std::numeric_limits<double>::infinity();
  return placement(robot, way, plan_on(robot, *way, state, workspace, kWhenever, delay));
}

std::vector<Traffic> Coordinator::traffic(int robot, const TeamState& state) const {
  const std::size_t clock = car(robot).kind->clock;
  std::vector<Traffic> traffic;
  for (const MovingBody& part : obstacles_[clock]) traffic.push_back({&part, scenario_.margins.obstacle});
  for (int other = 0; other < robots(); ++other)
    if (other != robot && state[idx(other)])
      traffic.push_back({&state[idx(other)]->bodies[clock], clearance(robot, other)});
  return traffic;
}

std::shared_ptr<const Placement> Coordinator::place(int robot, const TeamState& state,
                                                    CoordinatorWorkspace& workspace, double latest) const {
  std::vector<WayPtr> order = ways(robot);
  std::stable_sort(order.begin(), order.end(),
                   [](const WayPtr& a, const WayPtr& b) { return a->alone < b->alone; });
  VelocityPlan best;
  WayPtr best_way;
  for (const WayPtr& way : order) {
    if (way->alone > latest || (best.found && way->alone >= best.arrival)) break;
    VelocityPlan plan = plan_on(robot, *way, state, workspace, latest);
    if (!plan.found || (best.found && plan.arrival >= best.arrival)) continue;
    latest = plan.arrival;
    best = std::move(plan);
    best_way = way;
  }
  return placement(robot, best_way, std::move(best));
}

std::vector<Coordinator::Conflict> Coordinator::conflicts(int robot, const Way& on, const TeamState& state,
                                                          CoordinatorWorkspace& workspace) const {
  const int parts = static_cast<int>(obstacles_[car(robot).kind->clock].size());
  std::vector<Conflict> found;
  for (int other = -parts; other < robots(); ++other) {
    if (other == robot || (other >= 0 && !state[idx(other)])) continue;
    const int tick = first_hit(on.unhindered, taken(robot, on, other, state, workspace));
    if (tick < 0) continue;
    const auto at = std::min(idx(tick), on.unhindered.tested.size() - 1);
    const int obstacle = other < 0 ? part_of_[idx(-1 - other)] : -1;
    found.push_back({std::max(other, -1), tick, on.unhindered.tested[at], obstacle});
  }
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
  if (!placement.way) return *car(robot).fixed;
  return {placement.way->lattice.path(), placement.profile};
}

std::vector<geom::Vec2> Coordinator::footprint_at(int robot, const geom::Pose2& pose) const {
  return geom::placed({scenario_.model_of(scenario_.robots[idx(robot)]).footprint, 0.0}, pose).core;
}

}  // namespace seine::search
