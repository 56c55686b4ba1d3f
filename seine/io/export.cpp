#include "seine/io/export.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/yaml_text.hpp"

namespace seine::io {
namespace {

constexpr double kMostRows = 20e6;

/// Calls `visit(t)` for every k / rate below `until`, and for `until`.
template <class Visit>
void each_instant(double until, double rate, Visit&& visit) {
  for (long k = 0;; ++k) {
    const double t = static_cast<double>(k) / rate;
    // A last step shorter than a nanosecond is rounding.
    if (t >= until - 1e-9) break;
    visit(t);
  }
  visit(until);
}

/// A CSV field: quoted where it has to be [RFC 4180].
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

void append_row(std::string& out, std::initializer_list<double> values, char between) {
  bool first = true;
  for (const double value : values) {
    if (!first) out += between;
    first = false;
    out += number_text(value + 0.0);  // −0 becomes 0
  }
  out += '\n';
}

/// A robot's name as a part of a file name.
std::string file_part(const std::string& name) {
  std::string out = name;
  for (char& c : out) {
    const bool safe =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    if (!safe) c = '_';
  }
  return out;
}

void expect_rate(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double rate) {
  if (plan.robots.size() != scenario.robots.size()) {
    throw InputError(joined("cannot be exported: the plan is for ", plan.robots.size(), " robots, expected ",
                            scenario.robots.size()));
  }
  if (!(rate > 0.0) || !std::isfinite(rate)) throw InputError("the rate is no positive number of hertz");
  if ((plan.makespan() * rate + 2.0) * static_cast<double>(plan.robots.size()) > kMostRows)
    throw InputError(joined("the rate ", number_text(rate), " Hz makes more than 20 million rows"));
}

}  // namespace

std::string states_csv(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double rate) {
  expect_rate(scenario, plan, rate);
  std::string out = "robot,t,x,y,heading,speed,acceleration,steering\n";
  const double makespan = plan.makespan();
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const world::Robot& robot = scenario.robots[k];
    const std::string name = csv_field(robot.name) + ",";
    const double wheelbase = scenario.model_of(robot).wheelbase;
    each_instant(makespan, rate, [&](double t) {
      const traj::State s = plan.robots[k].at(t);
      out += name;
      append_row(out,
                 {t, s.pose.x, s.pose.y, s.pose.heading, s.speed, s.acceleration,
                  std::atan(s.curvature * wheelbase)},
                 ',');
    });
  }
  return out;
}

std::string states_tum(const traj::RobotTrajectory& robot, double makespan, double rate) {
  std::string out;
  each_instant(makespan, rate, [&](double t) {
    const geom::Pose2 pose = robot.at(t).pose;
    append_row(
        out, {t, pose.x, pose.y, 0.0, 0.0, 0.0, std::sin(pose.heading / 2), std::cos(pose.heading / 2)}, ' ');
  });
  return out;
}

std::string clmapf_schedule(const world::Scenario& scenario, const traj::TeamTrajectory& plan, double rate) {
  double flowtime = 0.0;
  for (const traj::RobotTrajectory& robot : plan.robots) flowtime += robot.arrival();
  std::string out =
      joined("statistics:\n  cost: ", number_text(flowtime), "\n  makespan: ", number_text(plan.makespan()),
             "\n  flowtime: ", number_text(flowtime), "\n  runtime: 0\nschedule:\n");
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    out += joined("  ", yaml_scalar(scenario.robots[k].name), ":\n");
    long step = 0;
    // The last step reaches the makespan or lies just after it: the robot is at its goal there.
    each_instant(plan.makespan(), rate, [&](double) {
      const geom::Pose2 pose = plan.robots[k].at(static_cast<double>(step) / rate).pose;
      out += joined("    - x: ", number_text(pose.x), "\n      y: ", number_text(pose.y),
                    "\n      yaw: ", number_text(geom::wrap_angle(-pose.heading)), "\n      t: ", step, "\n");
      ++step;
    });
  }
  return out;
}

std::vector<std::filesystem::path> exported_files(const world::Scenario& scenario,
                                                  const std::filesystem::path& path) {
  if (path.extension() != ".tum" || scenario.robots.size() < 2) return {path};
  std::vector<std::filesystem::path> files;
  std::set<std::string> taken;
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    std::string part = file_part(scenario.robots[k].name);
    if (!taken.insert(part).second) taken.insert(part += joined("-", k));
    files.push_back(path);
    files.back().replace_filename(joined(path.stem().string(), "-", part, path.extension().string()));
  }
  return files;
}

std::vector<std::filesystem::path> export_plan(const world::Scenario& scenario,
                                               const traj::TeamTrajectory& plan, double rate,
                                               const std::filesystem::path& path) {
  expect_rate(scenario, plan, rate);
  const std::string extension = path.extension().string();
  const std::vector<std::filesystem::path> files = exported_files(scenario, path);
  if (extension == ".tum") {
    for (std::size_t k = 0; k < files.size(); ++k)
      write_file(files[k], states_tum(plan.robots[k], plan.makespan(), rate));
  } else if (extension == ".csv") {
    write_file(path, states_csv(scenario, plan, rate));
  } else if (extension == ".yaml" || extension == ".yml") {
    write_file(path, clmapf_schedule(scenario, plan, rate));
  } else {
    throw complaint(path.string(), 0, "has an unknown ending, expected .csv, .tum or .yaml");
  }
  return files;
}

}  // namespace seine::io
