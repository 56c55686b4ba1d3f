#include <array>
#include <cmath>
#include <cstdio>

#include "seine/io/certificate_json.hpp"
#include "seine/io/file_bytes.hpp"
#include "seine/io/json_text.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/plan_file.hpp"

namespace seine::io {
namespace {

constexpr double kStateRate = 20.0;    // Hz, docs/plan-format.md
constexpr double kMostStates = 300e3;  // of a team; long plans of many cars have fewer a second

template <class Range, class Write>
std::string list_text(const Range& range, const char* between, Write&& write) {
  std::string out = "[";
  for (const auto& entry : range) {
    if (out.size() > 1) out += between;
    out += write(entry);
  }
  out += "]";
  return out;
}

std::string quintic_json(const traj::Quintic& quintic) {
  return list_text(quintic, ", ", json_number);
}

std::string segment_json(const traj::Segment& segment) {
  const char* row = ",\n      ";
  JsonObject object;
  object.add("gear", segment.gear);
  object.add("wait", segment.wait);
  object.add("piece_duration", segment.piece_duration);
  const auto curve = [&](const auto& piece) { return list_text(piece, ", ", quintic_json); };
  object.add_raw("curve", list_text(segment.curve, row, curve));
  object.add_raw("progress", list_text(segment.progress, row, quintic_json));
  return object.line();
}

/// Sampled for people and plotters: six decimals are a micrometre.
std::string state_json(const traj::State& state, double wheelbase) {
  const double steering = std::atan(state.curvature * wheelbase);
  std::string out = "[";
  for (const double value :
       {state.t, state.pose.x, state.pose.y, state.pose.heading, state.speed, state.acceleration, steering}) {
    if (out.size() > 1) out += ", ";
    out += std::isfinite(value) ? rounded_text(value, 6) : "null";
  }
  out += "]";
  return out;
}

std::string states_json(const traj::RobotTrajectory& robot, double wheelbase, double rate) {
  std::string out = "[";
  const double arrival = robot.arrival();
  const auto steps = static_cast<long>(std::ceil(arrival * rate - 1e-9));
  for (long i = 0; i <= steps; ++i) {
    const double t = std::min(static_cast<double>(i) / rate, arrival);
    if (i > 0) out += ",\n    ";
    out += state_json(robot.at(t), wheelbase);
  }
  out += "]";
  return out;
}

std::string robot_json(const world::Scenario& scenario, std::size_t index,
                       const traj::RobotTrajectory& trajectory, double rate) {
  const world::Robot& robot = scenario.robots[index];
  JsonObject object;
  object.add("name", robot.name);
  object.add("model", scenario.model_of(robot).name);
  object.add("arrival_s", trajectory.arrival());
  if (trajectory.stands) {
    const geom::Pose2& pose = *trajectory.stands;
    object.add_raw("stands", list_text(std::array{pose.x, pose.y, pose.heading}, ", ", json_number));
  }
  object.add_raw("segments", list_text(trajectory.segments, ",\n    ", segment_json));
  object.add_raw("states", states_json(trajectory, scenario.model_of(robot).wheelbase, rate));
  return object.lines();
}

std::string fingerprint_json(const world::Scenario& scenario) {
  const world::Fingerprint made_for = world::fingerprint(scenario);
  JsonObject object;
  for (const world::FingerprintPart& part : world::kFingerprintParts) {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(made_for.*part.value));
    object.add(part.name, digits);
  }
  return object.line();
}

std::string settings_json(const world::Scenario& scenario, const PlanSettings& settings) {
  JsonObject object;
  object.add("method", settings.method);
  object.add_raw("seed", std::to_string(settings.seed));
  object.add("threads", settings.threads);
  object.add("deadline_s", settings.deadline_s);
  object.add("robot_margin_m", scenario.margins.robot);
  object.add("obstacle_margin_m", scenario.margins.obstacle);
  return object.line();
}

}  // namespace

std::string plan_text(const world::Scenario& scenario, const planner::PlanResult& result,
                      const PlanSettings& settings) {
  double driven = 0.0;  // s, of all cars
  for (const traj::RobotTrajectory& robot : result.plan.robots) driven += robot.arrival();
  const double rate = std::min(kStateRate, kMostStates / std::max(driven, 1.0));
  if (result.plan.robots.size() != scenario.robots.size()) {
    throw Error(joined("a plan for ", result.plan.robots.size(), " robots does not fit a scenario with ",
                       scenario.robots.size()));
  }
  JsonObject object;
  object.add("seine_plan", 1);
  object.add("scenario", scenario.name);
  object.add_raw("made_for", fingerprint_json(scenario));
  object.add_raw("settings", settings_json(scenario, settings));
  object.add_raw("certificate", certificate_json(scenario, result.certificate));
  object.add("makespan_s", result.plan.makespan());
  object.add_raw("state_columns", R"(["t", "x", "y", "heading", "speed", "acceleration", "steering"])");
  std::string robots = "[\n";
  for (std::size_t i = 0; i < result.plan.robots.size(); ++i) {
    if (i > 0) robots += ",\n";
    robots += robot_json(scenario, i, result.plan.robots[i], rate);
  }
  robots += "]";
  object.add_raw("robots", robots);
  return object.lines() + "\n";
}

void save_plan(const world::Scenario& scenario, const planner::PlanResult& result,
               const std::filesystem::path& path, const PlanSettings& settings) {
  write_file(path, plan_text(scenario, result, settings));
}

}  // namespace seine::io
