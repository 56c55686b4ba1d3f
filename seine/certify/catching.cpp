#include "seine/certify/catching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "seine/certify/tolerances.hpp"
#include "seine/geom/convex.hpp"
#include "seine/net/shape.hpp"
#include "seine/world/flight_path.hpp"

namespace seine::certify {

using geom::Vec2;

namespace {
constexpr int kMostRiseSteps = 100000;  // of a target that is released below the rim; sane ones need dozens
}  // namespace

std::vector<std::optional<net::Crossing>> crossings_of(const world::Scenario& scenario) {
  std::vector<std::optional<net::Crossing>> crossings;
  for (const net::Target& target : scenario.targets)
    crossings.push_back(net::Flight(target).crossing(scenario.net->rim()));
  return crossings;
}

Phases phases_of(const world::Scenario& scenario,
                 const std::vector<std::optional<net::Crossing>>& crossings) {
  Phases phases;
  for (const auto& crossing : crossings) {
    if (crossing && crossing->state.time >= 0.0) phases.catches.push_back(crossing->state.time);
  }
  phases.loaded = scenario.payload ? 0.0 : phases.first_catch();
  return phases;
}

std::vector<Context::Carry> carries_of(const world::Scenario& scenario,
                                       const std::vector<std::optional<net::Crossing>>& crossings) {
  std::vector<Context::Carry> carries;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const double drag = scenario.targets[i].drag;
    if (crossings[i] && crossings[i]->state.time >= 0.0 && drag > 0.0)
      carries.push_back({crossings[i]->state.time, net::carry_speed(drag), static_cast<int>(i)});
  }
  std::ranges::stable_sort(carries, {}, &Context::Carry::from);
  double strictest = std::numeric_limits<double>::infinity();
  std::erase_if(carries, [&](const Context::Carry& carry) {
    const bool implied = !(carry.speed < strictest);
    strictest = std::min(strictest, carry.speed);
    return implied;
  });
  // Of more than that the last one kept stands for the rest: it gets the strictest speed from its own,
  // earlier time on, which asks for more than is needed, never for less.
  if (carries.size() > Context::kMostCarries) {
    carries[Context::kMostCarries - 1].speed = carries.back().speed;
    carries[Context::kMostCarries - 1].target = carries.back().target;
    carries.resize(Context::kMostCarries);
  }
  return carries;
}

std::vector<net::Catch> CatchCheck::run(const std::vector<std::optional<net::Crossing>>& crossings) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<net::Catch> catches;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    catches.push_back({kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone});
    const std::string name = context_.target_name(static_cast<int>(i));
    if (!crossings[i]) {
      note(i, 0.0, 0.0, net_.rim(), 1.0, name + " never falls through the rim of the net");
      continue;
    }
    const double time = crossings[i]->state.time;
    if (time < 0.0) {
      note(i, 0.0, time, 0.0, -time,
           format("%s has fallen below the rim of the net at t = %.4f s, before the plan begins",
                  name.c_str(), time));
      continue;
    }
    if (const auto hit = world::flight_obstruction(context_.scenario, context_.scenario.targets[i], time)) {
      if (hit->decided)
        note(i, hit->time, hit->height, 0.0, time - hit->time,
             name + " " + world::describe(context_.scenario, *hit));
      else
        leave_open(i, hit->time, context_.obstacle_name(hit->obstacle));
    }
    check_rise(i, time);
    look_at_team(time);
    catches.back() =
        net::measure_catch(net_, context_.scenario.targets[i], *crossings[i], attachments_, motion_);
    net::Catch& caught = catches.back();
    caught.contact_margin =
        std::min(caught.contact_margin, margin_where_it_lands(i, *crossings[i], caught.depth));
    judge(i, caught);
  }
  return catches;
}

// What falls slowly meets the net long after it has passed the rim: where the flight really is then, and the
// team.
double CatchCheck::margin_where_it_lands(std::size_t target, const net::Crossing& crossing, double depth) {
  const net::Target& falling = context_.scenario.targets[target];
  const auto landing = net::Flight(falling).crossing(net_.rim() - depth);
  if (!landing) return std::numeric_limits<double>::infinity();
  look_at_team(landing->state.time);
  return net::margin_inside(attachments_, landing->state.position.ground()) - falling.radius - crossing.error;
}

void CatchCheck::look_at_team(double t) {
  attachments_.clear();
  motion_ = {};
  const double share = 1.0 / static_cast<double>(plan_.robots.size());
  for (std::size_t k = 0; k < plan_.robots.size(); ++k) {
    const traj::State state = plan_.robots[k].at(t);
    const Vec2 at = state.pose * net_.attachments[k].at;
    const Vec2 ahead = state.pose.direction(), arm = at - state.pose.position();
    // Of the heading, rad/s and rad/s²; then a rigid body's motion.
    const double turn = state.speed * state.curvature;
    const double twist = state.acceleration * state.curvature + state.speed * state.curvature_rate;
    attachments_.push_back(at);
    motion_.velocity += share * (state.speed * ahead + turn * geom::left_normal(arm));
    motion_.acceleration +=
        share * (state.acceleration * ahead + state.lateral_acceleration * geom::left_normal(ahead) +
                 twist * geom::left_normal(arm) - (turn * turn) * arm);
  }
}

double CatchCheck::highest_under(double t) const {
  double highest = 0.0;
  const auto consider = [&](std::span<const Vec2> core, double radius, double height) {
    if (std::isinf(height) || height <= highest) return;  // what is too tall is not passed over
    if (geom::separation(std::span<const Vec2>(attachments_), core).distance < radius) highest = height;
  };
  context_.map.for_each_near(geom::bounding_box(attachments_), [&](const world::StaticMap::Piece& piece) {
    consider(piece.shape.core, piece.shape.radius, context_.height_of(piece.obstacle));
  });
  std::vector<Vec2> core;
  for (const MovingPart& part : scene_.moving) {
    const auto& cells = part.mover.cells;
    std::size_t c = 0;
    while (c + 1 < cells.size() && cells[c].t1 < t) ++c;
    core.resize(part.mover.core.size());
    part.mover.place(cells[c], t, core);
    consider(core, part.mover.radius, context_.height_of(part.obstacle));
  }
  return highest;
}

void CatchCheck::judge(std::size_t target, const net::Catch& c) {
  const net::Net& net = net_;
  const net::Target& falling = context_.scenario.targets[target];
  struct Rule {
    double value, limit, tolerance;
    bool at_least;
    const char* what;
  };
  const double fastest = net::speed_limit(c.depth, falling.radius, net.rebound);
  const double lowest = net.clearance + highest_under(c.time);
  const Rule rules[] = {
      {c.rim_margin, net::kRimMargin, tolerance::kNetProved, true, "%.4f m inside the rim (%.4f required)"},
      {c.contact_margin, net::kContactMargin, tolerance::kNetProved, true,
       "%.4f m inside where it meets the net (%.4f required)"},
      {c.opening, net::kLeastOpening, tolerance::kNetProved, true, "a net open to %.4f (%.4f required)"},
      {c.angle, net::kMaxAngle, tolerance::kStartHeading, false, "%.4f rad from vertical (%.4f allowed)"},
      {c.speed, fastest, tolerance::kCatchSpeed, false, "%.4f m/s relative to the net (%.4f allowed)"},
      {c.bottom, lowest, tolerance::kNetProved, true,
       "%.4f m above the ground at the deepest (%.4f required)"}};
  std::string all;
  const Rule* first = nullptr;
  double excess = 0.0;
  for (const Rule& rule : rules) {
    const double over = rule.at_least ? rule.limit - rule.value : rule.value - rule.limit;
    if (over <= rule.tolerance) continue;
    if (first == nullptr) first = &rule;
    excess += std::isfinite(over) ? over : 1.0;
    char text[128];
    std::snprintf(text, sizeof text, rule.what, rule.value, rule.limit);
    all += (all.empty() ? "" : ", ") + std::string(text);
  }
  if (first == nullptr) return;
  note(target, c.time, first->value, first->limit, excess,
       format("%s at t = %.4f s: ", context_.target_name(static_cast<int>(target)).c_str(), c.time) + all);
}

void CatchCheck::note(std::size_t target, double time, double value, double limit, double excess,
                      const std::string& what) {
  findings_.push_back({{Kind::target_catch, time, -1, static_cast<int>(target), value, limit, what}, excess});
}

void CatchCheck::leave_open(std::size_t target, double time, const std::string& beside) {
  findings_.push_back({{Kind::undecided, time, -1, static_cast<int>(target), 0.0, 0.0,
                        format("%s could not be shown to clear %s at t = %.4f s",
                               context_.target_name(static_cast<int>(target)).c_str(), beside.c_str(), time)},
                       0.0});
}

void CatchCheck::check_rise(std::size_t target, double crossing) {
  const net::Target& rising = context_.scenario.targets[target];
  const net::Flight flight(rising);
  const auto below = [&](double t) { return flight.at(t).position.z - rising.radius < net_.rim(); };
  // Points of cars go no faster than this: the limits are proved elsewhere.
  double fastest = 0.0;
  for (std::size_t k = 0; k < plan_.robots.size(); ++k) {
    const vehicle::Model& model = context_.scenario.model_of(context_.scenario.robots[k]);
    const double reach = std::max(geom::norm(net_.attachments[k].at), model.reach());
    fastest = std::max(fastest, std::max(model.limits.speed, model.limits.reverse_speed) *
                                    (1.0 + model.max_curvature() * reach));
  }
  const double speed = fastest + std::hypot(rising.velocity.x, rising.velocity.y, rising.velocity.z) +
                       net::kGravity * (crossing - rising.time);
  int steps = 0;
  for (double t = rising.time; t < crossing && below(t) && flight.at(t).velocity.z > 0.0; ++steps) {
    const Vec2 at = flight.at(t).position.ground();
    const auto [gap, through] = nearest_of_team(at, std::max(t, 0.0));
    const double left = gap - rising.radius;
    if (steps > kMostRiseSteps) return leave_open(target, t, through);
    if (left < tolerance::kNetProved) {
      note(target, t, left, 0.0, std::max(-left, tolerance::kNetProved),
           format("%s rises through %s at t = %.4f s, below the rim of the net",
                  context_.target_name(static_cast<int>(target)).c_str(), through.c_str(), t));
      return;
    }
    t += left / speed;
  }
}

std::pair<double, std::string> CatchCheck::nearest_of_team(Vec2 at, double t) {
  look_at_team(t);
  std::pair<double, std::string> nearest{geom::distance(std::span(&at, 1), geom::convex_hull(attachments_)),
                                         "the net"};
  for (std::size_t k = 0; k < plan_.robots.size(); ++k) {
    const geom::Convex car = geom::placed(
        {context_.scenario.model_of(context_.scenario.robots[k]).footprint, 0.0}, plan_.robots[k].at(t).pose);
    const double gap = geom::distance(std::span(&at, 1), car.core);
    if (gap < nearest.first) nearest = {gap, context_.robot_name(static_cast<int>(k))};
  }
  return nearest;
}

std::vector<Finding> check_payload(const Context& context) {
  if (!context.scenario.payload) return {};
  const double radius = context.scenario.payload->radius;
  const double widest = net::inradius(context.scenario.net->rest);
  if (radius <= widest) return {};
  return {{{Kind::net_holding, 0.0, -1, -1, widest, radius,
            format("the payload has a radius of %.4f m; the net has room for %.4f m", radius, widest)},
           radius - widest}};
}

std::vector<Finding> check_delivery(const Context& context, const traj::TeamTrajectory& plan) {
  std::vector<Finding> findings;
  if (!context.scenario.delivery) return findings;
  const net::Delivery& delivery = *context.scenario.delivery;
  Vec2 mean;
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const double arrival = plan.robots[k].arrival();
    const geom::Pose2 end = plan.robots[k].at(arrival).pose;
    mean += end * context.scenario.net->attachments[k].at;
    if (!delivery.heading) continue;
    const double off = std::abs(geom::wrap_angle(end.heading - *delivery.heading));
    if (off <= kDeliveryHeading + tolerance::kStartHeading) continue;
    findings.push_back({{Kind::delivery, arrival, static_cast<int>(k), -1, off, kDeliveryHeading,
                         format("%s ends %.4f rad off the heading of the delivery; %.4f rad is allowed",
                                context.robot_name(static_cast<int>(k)).c_str(), off, kDeliveryHeading)},
                        off - kDeliveryHeading});
  }
  mean = mean / static_cast<double>(plan.robots.size());
  const double off = geom::norm(mean - delivery.center), time = plan.makespan();
  if (off <= delivery.radius + tolerance::kNetProved) return findings;
  findings.push_back(
      {{Kind::delivery, time, -1, -1, off, delivery.radius,
        format("the net comes to rest %.4f m from the delivery; %.4f m is allowed", off, delivery.radius)},
       off - delivery.radius});
  return findings;
}

}  // namespace seine::certify
