#include "seine/planner/net_question.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "seine/constraint/net_spread.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/hanging.hpp"

namespace seine::planner {
namespace {

using geom::Vec2;

constexpr int kDirections = 64;
// An obstacle is low when the loaded net clears it at this opening.
constexpr double kPassOpening = 0.92;
// Low obstacles this much beyond the net's reach count at a catch, m.
constexpr double kNearCatch = 0.15;
// What the optimiser keeps of the windows that the certificate checks, m and m/s; a fast object's depth is
// always at its limit, where a penalty gives way a little.
constexpr double kDepthSlack = 0.008, kRadiusSlack = 0.005, kSpeedSlack = 0.1;
// What keeps the load in the net, m² (docs/net.md), and at most this share of what a wide open net has.
constexpr double kHoldingReserve = 0.3, kReserveShare = 0.7;
// Sideways speed asked for on top of what the guess expects, m/s.
constexpr double kSidewaysRoom = 0.6;
// The best plan lies on the limits it is given: what is asked is a little more than what the certificate
// wants, as a net that closes under an object that lies near its edge may lose it (docs/simulation.md).
constexpr double kContactReserve = 0.03;  // m
constexpr double kHeldOpen = 0.90;        // for net::kHoldTime
constexpr double kCruise = 0.9;           // of the top speed: what the formation is expected to drive

std::string text(const char* pattern, auto... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, pattern, values...);
  return buffer;
}

double spread_of(std::span<const Vec2> ring) {
  std::vector<Vec2> unused(ring.size());
  return constraint::net_spread(ring, unused);
}

// Depth of the net's middle when it is scaled as a whole.
double depth_at(double spread, double opening) {
  return spread * std::sqrt(std::max(0.0, 1.0 - opening * opening));
}

double team_speed(const world::Scenario& scenario) {
  double speed = std::numeric_limits<double>::infinity();
  for (const world::Robot& robot : scenario.robots) {
    const vehicle::Limits& limits = scenario.model_of(robot).limits;
    speed = std::min(speed, std::max(limits.speed, limits.reverse_speed));
  }
  return speed;
}

Vec2 start_middle(const world::Scenario& scenario) {
  std::vector<Vec2> ring;
  search::attachments_at(scenario, search::start_formation(scenario), search::formation_frame(scenario),
                         ring);
  Vec2 sum;
  for (const Vec2 a : ring) sum += a;
  return sum / static_cast<double>(ring.size());
}

double inradius(std::span<const Vec2> ring) {
  Vec2 middle;
  for (const Vec2 a : ring) middle += a / static_cast<double>(ring.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 a = ring[k], e = ring[(k + 1) % ring.size()] - a;
    least = std::min(least, geom::cross(e, middle - a) / geom::norm(e));
  }
  return least;
}

// How fast, relative to the formation, an object may come, given that the net must hang deep enough to hold
// it and high enough to stop it: the window of depths for that speed.
struct Window {
  double least_depth, most_depth;  // m
  bool open() const { return least_depth <= most_depth; }
};

Window window_at(double speed, const net::Net& net, const net::Target& target, double spread, double ground) {
  Window w{net::stopping_depth(speed, target.radius, net.rebound),
           net.rim() - net.clearance - ground - net::impact_drop(speed, target.mass)};
  w.least_depth = std::max(w.least_depth + kDepthSlack, depth_at(spread, net.stretch - 0.003));
  w.most_depth = std::min(w.most_depth - kDepthSlack, depth_at(spread, net::kLeastOpening + 0.002));
  return w;
}

double fastest_catch(const net::Net& net, const net::Target& target, double spread, double ground) {
  double low = 0.0, high = net::kMaxSpeed;
  if (window_at(high, net, target, spread, ground).open()) return high;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (window_at(middle, net, target, spread, ground).open() ? low : high) = middle;
  }
  return low;
}

class Asking {
 public:
  Asking(const world::Scenario& scenario, const Ablation& without)
      : scenario_(scenario), without_(without), net_(*scenario.net), spread_(spread_of(net_.rest)) {}

  NetQuestion run() {
    question_.task.net = net_;
    question_.task.size = !without_.size;
    question_.task.topology = !without_.topology;
    question_.task.delivery = scenario_.delivery;
    question_.task.holding_reserve = reserve();
    if (scenario_.payload) question_.task.loaded_from = 0.0;
    sort_obstacles();
    Vec2 from = start_middle(scenario_);
    double leave = 0.0;
    for (std::size_t i = 0; i < scenario_.targets.size(); ++i) {
      if (!add_catch(i, from, leave)) break;
      from = question_.meetings.back().point, leave = question_.meetings.back().time;
    }
    if (!question_.task.catches.empty()) question_.task.loaded_from = question_.task.catches.front().time;
    if (without_.catching) question_.task.catches.clear(), question_.meetings.clear();
    return std::move(question_);
  }

 private:
  // What the net has when it is nearly as open as it goes bounds what can be asked.
  double reserve() const {
    std::vector<Vec2> open = net_.rest;
    for (Vec2& r : open) r *= net_.stretch;
    return std::min(kHoldingReserve, kReserveShare * net::holding_reserve(net_, open));
  }

  void sort_obstacles() {
    const double passes = net_.rim() - net_.clearance - depth_at(spread_, kPassOpening);
    world::Scenario tall = scenario_;
    tall.obstacles.clear();
    for (const world::Obstacle& obstacle : scenario_.obstacles) {
      if (!obstacle.motion.empty()) continue;
      if (obstacle.height > passes) tall.obstacles.push_back(obstacle);
    }
    question_.tall = std::make_unique<world::StaticMap>(tall);
    question_.task.tall = question_.tall.get();
    world::Scenario low = scenario_;
    low.map.reset();
    std::erase_if(low.obstacles,
                  [&](const world::Obstacle& o) { return !o.motion.empty() || o.height > passes; });
    const world::StaticMap pieces(low);
    for (const world::StaticMap::Piece& piece : pieces.pieces())
      question_.task.low.push_back(
          {piece.shape, low.obstacles[static_cast<std::size_t>(piece.obstacle)].height});
  }

  bool refuse(std::string reason) {
    question_.refusal = std::move(reason);
    return false;
  }

  bool add_catch(std::size_t index, Vec2 from, double leave) {
    const net::Target& target = scenario_.targets[index];
    const std::string name =
        scenario_.targets.size() == 1 ? "the target" : "target " + std::to_string(index + 1);
    const auto crossing = net::Flight(target).crossing(net_.rim());
    if (!crossing || crossing->state.time <= 0.0)
      return refuse(name + " never falls through the net's rim plane while the team is there");
    const net::FlightState& at = crossing->state;
    const Vec2 point = at.position.ground(), velocity = at.velocity.ground();
    const double down = -at.velocity.z, error = target.radius + crossing->error;
    trajopt::CatchTask task;
    task.time = at.time, task.point = point, task.velocity = velocity;
    task.margin = net::kRimMargin + error;
    task.contact_margin = net::kContactMargin + kContactReserve + error;
    const double needed = least_time(scenario_, point, task.margin);
    if (needed > task.time)
      return refuse(name + text(" cannot be reached: the team needs at least %.2f s to hold the net around "
                                "(%.2f, %.2f), it has %.2f s",
                                needed, point.x, point.y, task.time));
    // What the formation is expected to drive when the target comes.
    carry_ = std::min(carry_, net::carry_speed(target.drag));
    if (std::isfinite(net::carry_speed(target.drag)))
      question_.task.carries.push_back({at.time, net::carry_speed(target.drag)});
    const double top = std::min(team_speed(scenario_), carry_);
    const Vec2 way = point - from;
    const double pace = std::min(kCruise * top, 1.3 * geom::norm(way) / std::max(task.time - leave, 0.1));
    const Vec2 drive = geom::norm(way) > 1e-9 ? pace * (way / geom::norm(way)) : Vec2{};
    ground_ = highest_near(point);
    if (!allow_speed(name, target, down, velocity, drive, top, task)) return false;
    // The deepest the net may hang: what is inside there and at the rim is inside between.
    task.contact_delay = most_depth_ / down;
    task.lean = most_depth_ / net::kGravity;
    task.contact_margin += task.lean * target.drag * geom::squared_norm(drive);  // the air's push
    task.least_opening = net::kLeastOpening;
    task.held_opening = kHeldOpen, task.hold = net::kHoldTime;
    task.least_spread = std::sqrt(std::max(0.0, spread_ * spread_ - most_depth_ * most_depth_));
    task.most_radius =
        std::sqrt(std::max(0.0, spread_ * spread_ - least_depth_ * least_depth_)) - kRadiusSlack;
    question_.task.catches.push_back(task);
    const double room = 0.92 * inradius(net_.rest) - task.margin;
    question_.meetings.push_back({point + 0.5 * task.contact_delay * (velocity - drive),
                                  std::clamp(0.8 * room, 0.08, 0.4), task.time, carry_});
    return true;
  }

  // Height of what the net may be over when it catches at `point`.
  double highest_near(Vec2 point) const {
    const std::vector<Vec2> at{point};
    double reach = kNearCatch, highest = 0.0;
    for (const Vec2 r : net_.rest) reach = std::max(reach, geom::norm(r) + kNearCatch);
    for (const trajopt::LowObstacle& low : question_.task.low)
      if (geom::distance(at, low.shape.core) - low.shape.radius < reach)
        highest = std::max(highest, low.height);
    return highest;
  }

  // How fast the target may come sideways, and how deep the net must then hang.
  bool allow_speed(const std::string& name, const net::Target& target, double down, Vec2 velocity, Vec2 drive,
                   double top, trajopt::CatchTask& task) {
    const double most = fastest_catch(net_, target, spread_, ground_) - kSpeedSlack;
    const double sideways = geom::norm(velocity);
    const double least_sideways = std::max(0.0, sideways - top);
    if (std::hypot(down, least_sideways) > most)
      return refuse(name + text(" comes too fast for this net: %.1f m/s at the rim even when the team drives "
                                "along, and it holds up to %.1f m/s",
                                std::hypot(down, least_sideways), most));
    if (least_sideways > down * std::tan(net::kMaxAngle))
      return refuse(name +
                    text(" comes too flat: %.0f degrees from vertical even when the team drives along, "
                         "and the net catches up to %.0f",
                         std::atan2(least_sideways, down) * 180.0 / std::numbers::pi,
                         net::kMaxAngle * 180.0 / std::numbers::pi));
    const double wanted = std::hypot(down, geom::norm(velocity - drive) + kSidewaysRoom);
    const double speed = std::min(most, wanted);
    const Window window = window_at(speed, net_, target, spread_, ground_);
    least_depth_ = window.least_depth, most_depth_ = window.most_depth;
    task.most_sideways = std::min(std::sqrt(std::max(0.0, speed * speed - down * down)),
                                  down * std::tan(net::kMaxAngle - 0.01));
    return true;
  }

  const world::Scenario& scenario_;
  const Ablation& without_;
  const net::Net& net_;
  double spread_;
  double carry_ = std::numeric_limits<double>::infinity();  // m/s, with what has been caught by then
  double least_depth_ = 0.0, most_depth_ = 0.0, ground_ = 0.0;
  NetQuestion question_;
};

// The least time to cover `distance` from a speed of at most `v0` towards it.
double least_time_for(double distance, double v0, double top, double acceleration) {
  if (distance <= 0.0) return 0.0;
  const double run_up = (top * top - v0 * v0) / (2.0 * acceleration);
  if (distance <= run_up) return (std::sqrt(v0 * v0 + 2.0 * acceleration * distance) - v0) / acceleration;
  return (top - v0) / acceleration + (distance - run_up) / top;
}

}  // namespace

double least_time(const world::Scenario& scenario, Vec2 point, double margin) {
  double least = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const Vec2 w = geom::unit(2.0 * std::numbers::pi * i / kDirections);
    double soonest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
      const world::Robot& robot = scenario.robots[k];
      const vehicle::Limits& limits = scenario.model_of(robot).limits;
      const Vec2 arm = scenario.net->attachments[k].at;
      // While its car drives a metre, turning as sharply as it can, an attachment moves this far at most.
      const double bend = scenario.model_of(robot).max_curvature();
      const double lever = std::hypot(1.0 + bend * std::abs(arm.y), bend * arm.x);
      const double distance = (geom::dot(w, point - robot.start * arm) + margin) / lever;
      const double top = std::max(limits.speed, limits.reverse_speed);
      soonest = std::min(soonest, least_time_for(distance, std::min(std::abs(robot.start_speed), top), top,
                                                 limits.acceleration));
    }
    least = std::max(least, soonest);
  }
  return least;
}

bool NetQuestion::roomy(const std::vector<net::Catch>& catches) const {
  return std::all_of(catches.begin(), catches.end(), [](const net::Catch& one) {
    return one.contact_margin >= net::kContactMargin + kContactReserve && one.opening >= kHeldOpen;
  });
}

NetQuestion ask_net(const world::Scenario& scenario, const Ablation& without) {
  return Asking(scenario, without).run();
}

}  // namespace seine::planner
