#include "seine/trajopt/joint_problem.hpp"

#include <algorithm>

namespace seine::trajopt {
namespace {

// Near pairs are found anew after so many iterations, and a few times before, while the steps are large.
constexpr int kRefreshEvery = 32;
constexpr bool refresh_at(int iteration) {
  return iteration % kRefreshEvery == 0 || iteration == 2 || iteration == 6 || iteration == 14;
}
// Car lengths beyond the clearance within which a pair is watched at coarse and at all ticks: what two cars
// can close in between two coarse ticks, and what an iterate moves until the next refresh.
constexpr double kSkin = 1.0, kClose = 0.5;
// Longest change of any variable (car lengths, logarithms, radians) in one iteration: longer ones are never
// useful.
constexpr double kMaxStep = 1.0;

std::vector<Shape> shapes_of(const Task& task, const Units& units) {
  std::vector<Shape> shapes;
  for (const RobotTask* robot : task.robots) shapes.push_back(shape_of(robot->model.footprint, units.length));
  return shapes;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

}  // namespace

Units units_of(std::span<const RobotTask> robots) {
  std::vector<std::pair<double, double>> sizes;
  for (const RobotTask& robot : robots) {
    const double length = robot.model.length();
    sizes.emplace_back(length, length / robot.model.limits.speed);
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return {middle->first, middle->second};
}

JointProblem::JointProblem(const Task& task, const Settings& settings, Workers& workers)
    : settings_(settings),
      workers_(workers),
      units_(task.units),
      offsets_{0},
      proximity_(shapes_of(task, units_), task.bodies, scaled(task.extra, 1.0 / units_.length),
                 task.robot_clearance / units_.length + settings.clearance_slack, task.ticks),
      states_(task.robots.size() * static_cast<std::size_t>(task.ticks)),
      costs_(task.robots.size()),
      chunk_costs_(Proximity::kChunks),
      tick_(task.tick / units_.time),
      ticks_(task.ticks) {
  for (std::size_t k = 0; k < task.robots.size(); ++k) {
    robots_.emplace_back(*task.robots[k], units_, settings,
                         task.demands.empty() ? Demand{} : task.demands[k]);
    offsets_.push_back(offsets_.back() + robots_.back().variables());
  }
}

std::vector<double> JointProblem::initial() const {
  std::vector<double> x(static_cast<std::size_t>(variables()));
  for (std::size_t k = 0; k < robots_.size(); ++k)
    robots_[k].initial(std::span(x).subspan(static_cast<std::size_t>(offsets_[k]),
                                            static_cast<std::size_t>(robots_[k].variables())));
  return x;
}

void JointProblem::load(std::span<const double> x) {
  workers_.run(static_cast<int>(robots_.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    robots_[i].load(
        x.subspan(static_cast<std::size_t>(offsets_[i]), static_cast<std::size_t>(robots_[i].variables())));
  });
}

void JointProblem::refresh(std::span<const double> x) {
  load(x);
  workers_.run(static_cast<int>(robots_.size()), [&](int k) {
    for (int tick = 0; tick < ticks_; tick += Proximity::kStride)
      robots_[static_cast<std::size_t>(k)].locate(tick * tick_,
                                                  states_[static_cast<std::size_t>(k * ticks_ + tick)]);
  });
  proximity_.rebuild(states_, kSkin, kClose);
}

double JointProblem::evaluate(std::span<const double> x, std::span<double> gradient, double knee) {
  const auto count = static_cast<int>(robots_.size());
  workers_.run(count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    RobotProblem& robot = robots_[i];
    robot.load(x.subspan(static_cast<std::size_t>(offsets_[i]), static_cast<std::size_t>(robot.variables())));
    costs_[i] = robot.evaluate(knee);
    for (const int tick : proximity_.ticks_of(k))
      robot.locate(tick * tick_, states_[static_cast<std::size_t>(k * ticks_ + tick)]);
  });
  const double weight = settings_.penalty * settings_.pair_penalty * tick_;
  workers_.run(Proximity::kChunks, [&](int chunk) {
    chunk_costs_[static_cast<std::size_t>(chunk)] = proximity_.evaluate(chunk, states_, weight, knee);
  });
  workers_.run(count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    RobotProblem& robot = robots_[i];
    for (const int tick : proximity_.ticks_of(k)) {
      const ClockState& state = states_[static_cast<std::size_t>(k * ticks_ + tick)];
      if (state.g_position != geom::Vec2{} || state.g_direction != geom::Vec2{}) robot.pull_back(state);
    }
    robot.gradient(
        gradient.subspan(static_cast<std::size_t>(offsets_[i]), static_cast<std::size_t>(robot.variables())));
  });
  double cost = 0.0;
  for (const double c : costs_) cost += c;
  for (const double c : chunk_costs_) cost += c;
  return cost;
}

SolveSummary JointProblem::solve(std::span<double> x, const Deadline& deadline, bool stiff_only) {
  SolveSummary summary;
  const auto stage = [&](double knee, double decrease, int evaluations) {
    refresh(x);
    optim::LbfgsOptions options;
    options.memory = settings_.memory;
    options.max_step = kMaxStep;
    options.max_evaluations = evaluations;
    options.decrease_tolerance = decrease;
    options.past = settings_.past;
    options.blocks.assign(offsets_.begin(), offsets_.end() - 1);
    options.stop = [&](int iteration, double) {
      if (refresh_at(iteration)) refresh(x);
      return deadline.expired();
    };
    const optim::LbfgsSummary result = optim::minimize(
        [&](std::span<const double> y, std::span<double> g) { return evaluate(y, g, knee); }, x, options);
    summary.cost = result.cost;
    summary.finished = result.status != optim::LbfgsStatus::stopped;
    return result.evaluations;
  };
  if (!stiff_only)
    summary.soft_evaluations =
        stage(settings_.soft_knee, settings_.soft_decrease, settings_.soft_evaluations);
  if (!deadline.expired())
    summary.stiff_evaluations =
        stage(settings_.stiff_knee, settings_.stiff_decrease, settings_.stiff_evaluations);
  return summary;
}

traj::TeamTrajectory JointProblem::trajectory(std::span<const double> x) {
  load(x);
  traj::TeamTrajectory team;
  for (const RobotProblem& robot : robots_) team.robots.push_back(robot.trajectory());
  return team;
}

}  // namespace seine::trajopt
