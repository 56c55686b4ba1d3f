#include "seine/world/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "seine/base/error.hpp"
#include "seine/geom/blocked.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/world/check_parts.hpp"
#include "seine/world/granted_speed.hpp"
#include "seine/world/net_check.hpp"

namespace seine::world {
namespace {

using geom::Convex;
using geom::Vec2;

constexpr double kTolerance = 1e-6;  // m

bool finite(const geom::Pose2& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.heading);
}

bool check_footprint(const vehicle::Model& model, Complaints& out) {
  const std::string what = "the footprint of model " + model.name;
  if (const std::string why = geom::why_not_simple(model.footprint); !why.empty()) {
    out.push_back(what + " is not a simple polygon: " + why);
  } else if (geom::signed_area(model.footprint) < 0.0) {
    out.push_back(what + " is clockwise, expected counter-clockwise");
  } else if (!geom::is_convex(model.footprint)) {
    out.push_back(what + " is not convex");
  } else {
    return true;
  }
  return false;
}

bool check_model(const vehicle::Model& model, Complaints& out) {
  const std::string of = " of model " + model.name;
  const vehicle::Limits& limits = model.limits;
  const auto positive = [&](double value, const char* what) {
    return require(value > 0.0 && std::isfinite(value), what + of, value, "a positive number", out);
  };
  const auto positive_or_none = [&](double value, const char* what) {
    return require(value > 0.0, what + of, value, "a positive number", out);
  };
  bool fine = check_footprint(model, out);
  fine &= positive(model.wheelbase, "the wheelbase");
  fine &= require_limit(limits.speed > 0.0, "the speed limit" + of, limits.speed, "a positive number", out);
  fine &= require(limits.reverse_speed >= 0.0 && std::isfinite(limits.reverse_speed),
                  "the reverse speed limit" + of, limits.reverse_speed, "zero or more", out);
  fine &= positive(limits.acceleration, "the acceleration limit");
  fine &= positive_or_none(limits.lateral_acceleration, "the lateral acceleration limit");
  fine &= require(limits.steering > 0.0 && limits.steering < 0.5 * std::numbers::pi,
                  "the steering limit" + of, limits.steering, "an angle between 0 and pi/2 rad", out);
  fine &= positive_or_none(limits.steering_rate, "the steering rate limit");
  return fine;
}

void check_world(const Scenario& scenario, Complaints& out) {
  const geom::Box& b = scenario.bounds;
  if (!(b.low.x < b.high.x && b.low.y < b.high.y && std::isfinite(b.size().x) && std::isfinite(b.size().y))) {
    out.push_back("the bounds [" + number(b.low.x) + ", " + number(b.low.y) + ", " + number(b.high.x) + ", " +
                  number(b.high.y) + "] hold no area, expected [xmin, ymin, xmax, ymax]");
  }
  for (const auto& [what, margin] :
       {std::pair{"the margin between robots", scenario.margins.robot},
        std::pair{"the margin to obstacles", scenario.margins.obstacle},
        std::pair{"the margin while leaving", scenario.margins.leaving.value_or(0.0)}}) {
    require_limit(margin >= 0.0, what, margin, "zero or more", out);
  }
}

bool check_motion(const Obstacle& obstacle, const std::string& name, Complaints& out) {
  for (std::size_t i = 0; i < obstacle.motion.size(); ++i) {
    const Waypoint& waypoint = obstacle.motion[i];
    const bool later = i == 0 || waypoint.t > obstacle.motion[i - 1].t;
    if (!std::isfinite(waypoint.t) || !finite(waypoint.pose) || !later) {
      out.push_back("waypoint " + std::to_string(i + 1) + " of " + name + " at t = " + number(waypoint.t) +
                    " s is not finite or not later than the one before");
      return false;
    }
  }
  return true;
}

bool check_obstacle_numbers(const Obstacle& obstacle, const std::string& name, Complaints& out) {
  if (const auto* circle = std::get_if<Circle>(&obstacle.shape)) {
    if (!require(circle->radius > 0.0 && std::isfinite(circle->radius), "the radius of " + name,
                 circle->radius, "a positive number", out) ||
        !require(std::isfinite(circle->center.x + circle->center.y), "the centre of " + name,
                 circle->center.x + circle->center.y, "finite numbers", out))
      return false;
  }
  return require(obstacle.height > 0.0, "the height of " + name, obstacle.height, "a positive number", out) &&
         check_motion(obstacle, name, out);
}

bool check_obstacle(const Obstacle& obstacle, const std::string& name, Complaints& out) {
  if (const auto* polygon = std::get_if<std::vector<Vec2>>(&obstacle.shape)) {
    if (const std::string why = geom::why_not_simple(*polygon); !why.empty()) {
      out.push_back(name + " is not a simple polygon: " + why);
      return false;
    }
  }
  return check_obstacle_numbers(obstacle, name, out);
}

// A car at one of its ends.
struct Stand {
  std::string who;  // "car0 at its start"
  std::string car;  // "car0"
  int robot;
  bool goal;
  Convex footprint;  // in the world
  geom::Box box;
};

Stand stand_of(const Scenario& scenario, std::size_t robot, bool goal) {
  const Robot& r = scenario.robots[robot];
  Stand stand{name_of(r, robot) + (goal ? " at its goal" : " at its start"),
              name_of(r, robot),
              static_cast<int>(robot),
              goal,
              geom::placed({scenario.model_of(r).footprint, 0.0}, goal ? *r.goal : r.start),
              {}};
  stand.box = stand.footprint.box();
  return stand;
}

// The map's pieces are the edges of its solid regions: deep inside one nothing is near.
void check_cell(const Stand& stand, const std::optional<geom::OccupancyGrid>& map, Complaints& out) {
  if (!map) return;
  if (geom::is_blocked(*map, stand.footprint.core.front()))
    out.push_back(stand.who + " stands in a blocked cell of the map");
}

// One sentence on a distance that is too small.
void complain_if_near(const std::string& who, const std::string& other, double distance, double margin,
                      Complaints& out) {
  if (distance >= margin - kTolerance) return;
  if (distance < -kTolerance) {
    out.push_back(who + " overlaps " + other + " by " + metres(-distance));
  } else {
    out.push_back(who + " is " + metres(std::max(distance, 0.0)) + " from " + other +
                  ", nearer than the margin of " + metres(margin));
  }
}

/// Says of the complaints from `first` on which place they are about.
void assign(const Stand& stand, std::size_t first, Complaints& out) {
  for (std::size_t i = first; i < out.size(); ++i) out[i].robot = stand.robot, out[i].goal = stand.goal;
}

void check_bounds(const Stand& stand, const geom::Box& bounds, double margin, Complaints& out) {
  const double inside =
      std::min(std::min(stand.box.low.x - bounds.low.x, stand.box.low.y - bounds.low.y),
               std::min(bounds.high.x - stand.box.high.x, bounds.high.y - stand.box.high.y));
  if (inside < -kTolerance) {
    out.push_back(stand.who + " sticks out of the bounds by " + metres(-inside));
  } else {
    complain_if_near(stand.who, "the bounds", inside, margin, out);
  }
}

// Whether a piece of the map is what lies outside its picture.
bool beyond_picture(const geom::OccupancyGrid& grid, const Convex& piece) {
  const Vec2 d = grid.origin.direction(), size{grid.width * grid.resolution, grid.height * grid.resolution};
  return std::any_of(piece.core.begin(), piece.core.end(), [&](Vec2 p) {
    const Vec2 from = p - grid.origin.position();
    const double x = geom::dot(d, from), y = geom::cross(d, from);
    return std::max({-x, -y, x - size.x, y - size.y}) > kTolerance;
  });
}

void check_static(const Scenario& scenario, const Stand& stand, const StaticMap& map, double margin,
                  Complaints& out) {
  struct Worst {
    double distance;
    int piece;
  };
  std::map<int, Worst> worst;  // by obstacle, the map being −1: an obstacle of many pieces is one complaint
  map.for_each_near(stand.box.inflated(margin), [&](const StaticMap::Piece& piece) {
    const double distance = geom::separation(stand.footprint, piece.shape).distance;
    if (distance >= margin - kTolerance) return;
    const int index = static_cast<int>(&piece - map.pieces().data());
    const auto [entry, fresh] = worst.try_emplace(piece.obstacle, Worst{distance, index});
    if (!fresh && distance < entry->second.distance) entry->second = {distance, index};
  });
  for (const auto& [obstacle, found] : worst) {
    const std::size_t before = out.size();
    complain_if_near(stand.who, map.describe(found.piece), found.distance, margin, out);
    const Convex& shape = map.pieces()[static_cast<std::size_t>(found.piece)].shape;
    if (obstacle < 0 && out.size() > before && beyond_picture(*scenario.map, shape))
      out.back().text += " (if that is free, say 'outside: free' under 'world')";
  }
}

// Whether the car touches nothing that stands still, however near it is.
bool stand_clear(const Stand& stand, const StaticMap& map) {
  return map.clear(stand.footprint.core, 0.0);
}

void check_moving(const std::vector<Stand>& stands, const std::vector<Convex>& body, const geom::Pose2& pose,
                  const std::string& name, double margin, Complaints& out) {
  std::vector<double> worst(stands.size(), margin);
  for (const Convex& part : body) {
    const Convex shape = geom::placed(part, pose);
    const geom::Box box = shape.box().inflated(margin);
    for (std::size_t i = 0; i < stands.size(); ++i) {
      if (box.overlaps(stands[i].box)) {
        worst[i] = std::min(worst[i], geom::separation(stands[i].footprint, shape).distance);
      }
    }
  }
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const std::size_t before = out.size();
    complain_if_near(stands[i].who, name, worst[i], margin, out);
    assign(stands[i], before, out);
  }
}

double distance_at(const Stand& stand, const std::vector<Convex>& body, const geom::Pose2& pose) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Convex& part : body)
    distance = std::min(distance, geom::separation(stand.footprint, geom::placed(part, pose)).distance);
  return distance;
}

// From when on the obstacle is nearer than the margin for good, which it is at its last place.
double near_from(const Stand& stand, const std::vector<Convex>& body, const std::vector<Waypoint>& motion,
                 double margin) {
  constexpr int kSteps = 200;
  for (std::size_t i = motion.size() - 1; i > 0; --i) {
    const Waypoint &a = motion[i - 1], &b = motion[i];
    for (int k = kSteps - 1; k >= 0; --k) {
      const double f = static_cast<double>(k) / kSteps;
      const geom::Pose2 pose{a.pose.x + f * (b.pose.x - a.pose.x), a.pose.y + f * (b.pose.y - a.pose.y),
                             a.pose.heading + f * geom::wrap_angle(b.pose.heading - a.pose.heading)};
      if (distance_at(stand, body, pose) >= margin) return a.t + (f + 1.0 / kSteps) * (b.t - a.t);
    }
  }
  return 0.0;
}

// Obstacles that stop on a goal.
void check_last_place(const std::vector<Stand>& goals, const std::vector<Convex>& body,
                      const std::vector<Waypoint>& motion, const std::string& name, double margin,
                      Complaints& out) {
  for (const Stand& goal : goals) {
    const double distance = distance_at(goal, body, motion.back().pose);
    if (distance >= margin - kTolerance) continue;
    out.push_back("the goal of " + goal.car + " is blocked from t = " +
                  number(std::max(0.0, near_from(goal, body, motion, margin))) + " s on by " + name +
                  ", which comes to rest " + (distance > 0.0 ? metres(distance) + " from it" : "on it"));
    assign(goal, out.size() - 1, out);
    out.back().impossible = true;
  }
}

void check_pairs(const std::vector<Stand>& stands, double margin, Complaints& out) {
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const geom::Box box = stands[i].box.inflated(margin);
    for (std::size_t j = i + 1; j < stands.size(); ++j) {
      if (!box.overlaps(stands[j].box)) continue;
      const double distance = geom::separation(stands[i].footprint, stands[j].footprint).distance;
      const std::size_t before = out.size();
      complain_if_near(stands[i].who, stands[j].who, distance, margin, out);
      assign(stands[i], before, out);
    }
  }
}

// Whether the car's poses can be judged at all.
bool check_robot(const Scenario& scenario, std::size_t index, const std::vector<bool>& model_fine,
                 Complaints& out) {
  const Robot& robot = scenario.robots[index];
  const std::string who = name_of(robot, index);
  if (robot.model < 0 || static_cast<std::size_t>(robot.model) >= scenario.models.size()) {
    out.push_back(who + " is of model number " + std::to_string(robot.model) + ", but there are " +
                  std::to_string(scenario.models.size()));
    return false;
  }
  bool fine = model_fine[static_cast<std::size_t>(robot.model)];
  const vehicle::Limits& limits = scenario.model_of(robot).limits;
  const double limit = robot.start_speed < 0.0 ? limits.reverse_speed : limits.speed;
  if (fine && !granted_speed(limits, robot.start_speed)) {
    out.push_back(who + " starts at " + number(robot.start_speed) + " m/s, faster than its limit of " +
                  number(limit) + " m/s and the 1 % granted to measured speeds");
  }
  if (!robot.goal && !scenario.net)
    out.push_back(who + " has no goal, which only a team with a net may lack");
  for (const auto& [pose, what] : {std::pair{&robot.start, " starts"},
                                   std::pair{robot.goal ? &*robot.goal : nullptr, " has its goal"}}) {
    if (pose == nullptr || finite(*pose)) continue;
    out.push_back(who + what + " at a pose that is not finite");
    fine = false;
  }
  return fine;
}

}  // namespace

std::vector<std::string> check(const Scenario& scenario, const StaticMap& map) {
  std::vector<std::string> sentences;
  for (Complaint& complaint : examine(scenario, map)) sentences.push_back(std::move(complaint.text));
  return sentences;
}

Complaints examine(const Scenario& scenario, const StaticMap& map) {
  Complaints out;
  check_world(scenario, out);
  std::vector<bool> model_fine;
  for (const vehicle::Model& model : scenario.models) model_fine.push_back(check_model(model, out));
  if (scenario.robots.empty()) out.push_back("the team is empty: expected at least one robot");

  std::vector<Stand> starts, goals;
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    if (!check_robot(scenario, i, model_fine, out)) continue;
    starts.push_back(stand_of(scenario, i, false));
    if (scenario.robots[i].goal) goals.push_back(stand_of(scenario, i, true));
  }
  const auto usable = [](double given) { return given >= 0.0 && std::isfinite(given) ? given : 0.0; };
  const double margin = usable(scenario.margins.obstacle);
  for (const auto* stands : {&starts, &goals}) {
    // A car may start where it is too near to something that stands still, if the scenario says so.
    const bool start = stands == &starts;
    const double least = start ? std::min(margin, scenario.margins.leaving.value_or(margin)) : margin;
    for (const Stand& stand : *stands) {
      const std::size_t before = out.size();
      check_bounds(stand, map.bounds(), least, out);
      check_static(scenario, stand, map, least, out);
      if (start && !scenario.margins.leaving && stand_clear(stand, map))
        for (std::size_t i = before; i < out.size(); ++i)
          out[i].text += " (to let cars leave such places, give 'margins: {leaving: ...}' in m)";
      if (out.size() == before) check_cell(stand, scenario.map, out);
      assign(stand, before, out);
    }
    check_pairs(*stands, usable(scenario.margins.robot), out);
  }
  bool obstacles_fine = true;
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    const Obstacle& obstacle = scenario.obstacles[i];
    const std::string name = name_of(obstacle, i);
    const bool fine = check_obstacle(obstacle, name, out);
    obstacles_fine &= fine;
    if (!fine || stands_still(obstacle)) continue;
    const std::vector<Convex> body = body_of(obstacle);
    check_moving(starts, body, pose_at_start(obstacle.motion), name + " (moving, at t = 0)", margin, out);
    check_last_place(goals, body, obstacle.motion, name, margin, out);
  }
  if (obstacles_fine) check_net(scenario, map, out);
  return out;
}

Complaints check_numbers(const Scenario& scenario) {
  Complaints out;
  check_world(scenario, out);
  std::vector<bool> model_fine;
  for (const vehicle::Model& model : scenario.models) model_fine.push_back(check_model(model, out));
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) check_robot(scenario, i, model_fine, out);
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    check_obstacle_numbers(scenario.obstacles[i], name_of(scenario.obstacles[i], i), out);
  check_net_numbers(scenario, out);
  return out;
}

void expect_numbers(const Scenario& scenario) {
  if (Complaints complaints = check_numbers(scenario); !complaints.empty())
    throw Unsound(scenario.name, std::move(complaints));
}

void expect_judgeable(const Scenario& scenario) {
  Complaints complaints = check_numbers(scenario);
  std::erase_if(complaints, [](const Complaint& complaint) { return complaint.judged; });
  if (!complaints.empty()) throw Unsound(scenario.name, std::move(complaints));
}

Unsound::Unsound(const std::string& scenario, Complaints complaints)
    : InputError(scenario + ": " + complaints.front().text +
                 (complaints.size() > 1 ? " (and " + std::to_string(complaints.size() - 1) + " more)" : "")),
      complaints_(std::make_shared<const Complaints>(std::move(complaints))) {}

std::string expect_sound(const Scenario& scenario, const StaticMap& map) {
  Complaints complaints = examine(scenario, map);
  std::string no_answer;
  for (const Complaint& complaint : complaints)
    if (complaint.impossible && no_answer.empty()) no_answer = complaint.text;
  std::erase_if(complaints, [](const Complaint& complaint) { return complaint.impossible; });
  if (!complaints.empty()) throw Unsound(scenario.name, std::move(complaints));
  return no_answer;
}

}  // namespace seine::world
