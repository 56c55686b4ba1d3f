// seine check: is the task sound, and can it have an answer?
#include "seine/world/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "apps/seine/command.hpp"
#include "apps/seine/output.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/io/json_text.hpp"
#include "seine/search/refusal.hpp"
#include "seine/world/static_map.hpp"

namespace seine::app {
namespace {

constexpr double kFar = 10.0;  // m: distances are not looked for further away

constexpr const char* kFooter =
    R"(Judges a scenario without planning it: whether its numbers make sense, whether starts and goals are clear, by how much, and
whether a disc as wide as each car has a way to its goal. Slips that can be read all the same are named: angles of more than
a turn, a 'leaving' without effect, goals that are alike.
Exit status 0: sound; 1: sound, but proved to have no answer; 2: wrong, with every reason.
Example
  seine check team.yaml)";

/// Where a car stands and how far it is from everything else.
struct Place {
  std::string car;
  bool goal = false;
  double obstacles = std::numeric_limits<double>::infinity(), cars = obstacles;  // m
  std::string nearest_obstacle, nearest_car;
};

struct Findings {
  std::vector<std::string> errors, impossible, warnings;
  std::vector<Place> places;
};

std::vector<Place> places_of(const world::Scenario& scenario, const world::StaticMap& map, bool goal) {
  std::vector<Place> places;
  std::vector<std::vector<geom::Vec2>> outlines;
  for (const world::Robot& robot : scenario.robots) {
    if (goal && !robot.goal) continue;
    std::vector<geom::Vec2> outline;
    for (const geom::Vec2 corner : scenario.model_of(robot).footprint)
      outline.push_back((goal ? *robot.goal : robot.start) * corner);
    Place place{.car = robot.name, .goal = goal, .nearest_obstacle = {}, .nearest_car = {}};
    const world::StaticMap::Nearest near = map.nearest(outline, kFar);
    if (near.piece >= 0 || near.bounds) {
      place.obstacles = near.distance;
      place.nearest_obstacle = near.bounds ? "the bounds" : map.describe(near.piece);
    }
    places.push_back(std::move(place));
    outlines.push_back(std::move(outline));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (i == j) continue;
      const double apart = geom::separation({outlines[i], 0.0}, {outlines[j], 0.0}).distance;
      if (apart > kFar || !(apart < places[i].cars)) continue;
      places[i].cars = apart;
      places[i].nearest_car = places[j].car;
    }
  }
  return places;
}

std::string located(const world::Complaint& complaint, const io::Reading& reading) {
  const std::string where = place_of(complaint, reading);
  return where.empty() ? complaint.text : where + ": " + complaint.text;
}

Findings examine(const world::Scenario& scenario, const io::Reading& reading) {
  Findings findings;
  findings.warnings = reading.notes;
  const world::StaticMap map(scenario);
  const world::Complaints complaints = world::examine(scenario, map);
  for (const world::Complaint& complaint : complaints)
    (complaint.impossible ? findings.impossible : findings.errors).push_back(located(complaint, reading));
  if (!findings.errors.empty()) return findings;
  findings.places = places_of(scenario, map, false);
  for (Place& place : places_of(scenario, map, true)) findings.places.push_back(std::move(place));
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    if (!scenario.robots[k].goal) continue;
    const search::Refusal refusal = search::why_no_way(scenario, map, static_cast<int>(k));
    if (refusal.proved())
      findings.impossible.push_back(search::sentence(refusal, scenario, static_cast<int>(k)));
  }
  return findings;
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f m", value);
  return text;
}

std::string told(const world::Scenario& scenario, const Findings& findings) {
  std::string text = (!findings.errors.empty()       ? "WRONG  "
                      : !findings.impossible.empty() ? "IMPOSSIBLE  "
                                                     : "SOUND  ") +
                     scenario.name + ", " + std::to_string(scenario.robots.size()) +
                     (scenario.robots.size() == 1 ? " car\n" : " cars\n");
  for (const std::string& error : findings.errors) text += "  error    " + error + "\n";
  for (const std::string& reason : findings.impossible) text += "  no       " + reason + "\n";
  for (const std::string& warning : findings.warnings) text += "  warning  " + warning + "\n";
  for (const Place& place : findings.places) {
    text += std::string(place.goal ? "  goal     " : "  start    ") + place.car;
    if (std::isfinite(place.obstacles))
      text += ", " + metres(place.obstacles) + " from " + place.nearest_obstacle;
    if (std::isfinite(place.cars)) text += ", " + metres(place.cars) + " from " + place.nearest_car;
    text += "\n";
  }
  return text;
}

std::string list_json(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + io::json_string(text);
  return "[" + all + "]";
}

std::string places_json(const std::vector<Place>& places) {
  std::string all;
  for (const Place& place : places) {
    io::JsonObject object;
    object.add("robot", place.car);
    object.add("at", place.goal ? "goal" : "start");
    if (std::isfinite(place.obstacles)) {
      object.add("to_obstacles_m", place.obstacles);
      object.add("obstacle", place.nearest_obstacle);
    }
    if (std::isfinite(place.cars)) {
      object.add("to_cars_m", place.cars);
      object.add("car", place.nearest_car);
    }
    all += (all.empty() ? "" : ", ") + object.line();
  }
  return "[" + all + "]";
}

std::string json_of(const world::Scenario& scenario, const Findings& findings) {
  io::JsonObject object;
  object.add("sound", findings.errors.empty());
  object.add("impossible", !findings.impossible.empty());
  object.add("robots", static_cast<int>(scenario.robots.size()));
  object.add_raw("errors", list_json(findings.errors));
  object.add_raw("reasons", list_json(findings.impossible));
  object.add_raw("warnings", list_json(findings.warnings));
  object.add_raw("places", places_json(findings.places));
  return object.lines() + "\n";
}

int run(const ScenarioChoice& choice, bool json) {
  io::Reading reading;
  const world::Scenario scenario = choice.load_quietly(reading);
  expect_writable("", reading);
  const Findings findings = examine(scenario, reading);
  print(json ? json_of(scenario, findings) : told(scenario, findings));
  if (!findings.errors.empty()) {
    std::fprintf(stderr, "seine: %s\n", findings.errors.front().c_str());
    return kWrong;
  }
  return findings.impossible.empty() ? kDone : kNo;
}

}  // namespace

void add_check(CLI::App& program, Invocation& invocation) {
  CLI::App& command = *program.add_subcommand("check", "judges a scenario without planning it");
  command.footer(kFooter);
  const auto choice = std::make_shared<ScenarioChoice>();
  add_scenario(command, *choice);
  add_json(command, invocation);
  command.callback([&invocation, choice] {
    invocation.run = [choice, &invocation] { return run(*choice, invocation.json); };
  });
}

}  // namespace seine::app
