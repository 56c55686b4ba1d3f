#include "seine/trajopt/joint_problem.hpp"

#include <algorithm>
#include <iterator>

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
// The net looks at every so many ticks; it refreshes from the coarse ones of the pairs.
constexpr int kNetStride = Proximity::kStride;
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
      needed_(task.robots.size()),
      states_(task.robots.size() * static_cast<std::size_t>(task.ticks)),
      costs_(task.robots.size()),
      chunk_costs_(Proximity::kChunks + NetTerms::kChunks),
      tick_(task.tick / units_.time),
      ticks_(task.ticks) {
  for (std::size_t k = 0; k < task.robots.size(); ++k) {
    robots_.emplace_back(*task.robots[k], units_, settings,
                         task.demands.empty() ? Demand{} : task.demands[k]);
    offsets_.push_back(offsets_.back() + robots_.back().variables());
  }
  variables_ = offsets_.back();
  if (task.one_timing) tie();
  if (task.net == nullptr) return;
  net_.emplace(*task.net, units_, settings, tick_, kNetStride);
  moments_.resize(robots_.size() * net_->moments().size());
}

// The first robot's timing is everybody's.
void JointProblem::tie() {
  tied_.assign(static_cast<std::size_t>(offsets_.back()), -1);
  const std::vector<int> first = robots_.front().timing();
  variables_ = 0;
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    const std::vector<int> timing = robots_[k].timing();
    const auto begin = static_cast<std::size_t>(offsets_[k]);
    for (std::size_t j = 0; k > 0 && j < timing.size(); ++j)
      tied_[begin + static_cast<std::size_t>(timing[j])] = tied_[static_cast<std::size_t>(first[j])];
    for (std::size_t i = begin; i < static_cast<std::size_t>(offsets_[k + 1]); ++i)
      if (tied_[i] < 0) tied_[i] = variables_++;
  }
  own_x_.resize(tied_.size()), own_gradient_.resize(tied_.size());
  shared_moments_.resize(static_cast<std::size_t>(ticks_));
}

std::vector<double> JointProblem::initial() const {
  std::vector<double> x(static_cast<std::size_t>(offsets_.back()));
  for (std::size_t k = 0; k < robots_.size(); ++k)
    robots_[k].initial(std::span(x).subspan(static_cast<std::size_t>(offsets_[k]),
                                            static_cast<std::size_t>(robots_[k].variables())));
  if (tied_.empty()) return x;
  std::vector<double> sum(static_cast<std::size_t>(variables_)), count(sum.size());
  for (std::size_t i = 0; i < tied_.size(); ++i) {
    sum[static_cast<std::size_t>(tied_[i])] += x[i];
    count[static_cast<std::size_t>(tied_[i])] += 1.0;
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= count[i];
  return sum;
}

// The robots' own variables, all of them in a row.
std::span<const double> JointProblem::own(std::span<const double> x) {
  if (tied_.empty()) return x;
  for (std::size_t i = 0; i < tied_.size(); ++i) own_x_[i] = x[static_cast<std::size_t>(tied_[i])];
  return own_x_;
}

std::span<const double> JointProblem::of(std::span<const double> own_x, std::size_t robot) const {
  return own_x.subspan(static_cast<std::size_t>(offsets_[robot]),
                       static_cast<std::size_t>(robots_[robot].variables()));
}

void JointProblem::load(std::span<const double> x) {
  const std::span<const double> all = own(x);
  workers_.run(static_cast<int>(robots_.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    robots_[i].load(of(all, i));
  });
}

void JointProblem::refresh(std::span<const double> x) {
  load(x);
  workers_.run(static_cast<int>(robots_.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    for (int tick = 0; tick < ticks_; tick += Proximity::kStride)
      robots_[i].locate(robots_[i].moment(tick * tick_), state(i, tick));
  });
  int net_ticks = 0;
  if (net_) {
    // Until everybody rests, and a little longer.
    double last = 0.0;
    for (const RobotProblem& robot : robots_) last = std::max(last, robot.arrival());
    net_ticks = std::min(ticks_, static_cast<int>(last / tick_) + 2 * kNetStride);
    net_->rebuild(states_, net_ticks, ticks_);
  }
  proximity_.rebuild(states_, kSkin, kClose, net_ && !proximity_.has_bodies() ? net_ticks : ticks_);
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    std::vector<int>& needed = needed_[k];
    needed.clear();
    for (int tick = 0; tick < net_ticks; tick += kNetStride) needed.push_back(tick);
    std::vector<int> merged;
    std::ranges::set_union(needed, proximity_.ticks_of(static_cast<int>(k)), std::back_inserter(merged));
    needed = std::move(merged);
  }
  if (!tied_.empty()) find_shared_ticks();
}

void JointProblem::find_shared_ticks() {
  needed_by_any_.clear();
  for (const std::vector<int>& needed : needed_) {
    std::vector<int> merged;
    std::ranges::set_union(needed_by_any_, needed, std::back_inserter(merged));
    needed_by_any_ = std::move(merged);
  }
}

void JointProblem::locate(std::size_t robot) {
  const RobotProblem& car = robots_[robot];
  for (const int tick : needed_[robot])
    car.locate(tied_.empty() ? car.moment(tick * tick_) : shared_moments_[static_cast<std::size_t>(tick)],
               state(robot, tick));
  if (!net_) return;
  const std::vector<double>& times = net_->moments();
  for (std::size_t m = 0; m < times.size(); ++m)
    car.locate(car.moment(times[m]), moments_[robot * times.size() + m]);
}

void JointProblem::pull_back(std::size_t robot) {
  const auto pull = [&](const ClockState& s) {
    if (s.g_position != geom::Vec2{} || s.g_direction != geom::Vec2{}) robots_[robot].pull_back(s);
  };
  for (const int tick : needed_[robot]) pull(state(robot, tick));
  if (!net_) return;
  const std::size_t count = net_->moments().size();
  for (std::size_t m = 0; m < count; ++m) pull(moments_[robot * count + m]);
}

// What cars ask of each other, once all states are known. Net and pairs write to the same states: one after
// the other.
double JointProblem::team_cost(double knee) {
  const double weight = settings_.penalty * settings_.pair_penalty * tick_;
  workers_.run(proximity_.chunks(), [&](int chunk) {
    chunk_costs_[static_cast<std::size_t>(chunk)] = proximity_.evaluate(chunk, states_, weight, knee);
  });
  double cost = 0.0;
  if (net_) {
    workers_.run(NetTerms::kChunks, [&](int chunk) {
      chunk_costs_[static_cast<std::size_t>(Proximity::kChunks + chunk)] =
          net_->at_ticks(chunk, states_, ticks_, knee);
    });
    cost = net_->at_moments(moments_, knee) + net_->on_the_way(states_, ticks_, knee);
  }
  for (const double c : chunk_costs_) cost += c;
  return cost;
}

double JointProblem::evaluate(std::span<const double> x, std::span<double> gradient, double knee) {
  const auto count = static_cast<int>(robots_.size());
  const std::span<const double> all = own(x);
  if (!tied_.empty()) {
    RobotProblem& first = robots_.front();
    first.load(of(all, 0));
    for (const int tick : needed_by_any_)
      shared_moments_[static_cast<std::size_t>(tick)] = first.moment(tick * tick_);
  }
  workers_.run(count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    if (tied_.empty() || i > 0) robots_[i].load(of(all, i));
    costs_[i] = robots_[i].evaluate(knee);
    locate(i);
  });
  double cost = team_cost(knee);
  const std::span<double> own_gradient = tied_.empty() ? gradient : std::span(own_gradient_);
  workers_.run(count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    pull_back(i);
    robots_[i].gradient(own_gradient.subspan(static_cast<std::size_t>(offsets_[i]),
                                             static_cast<std::size_t>(robots_[i].variables())));
  });
  if (!tied_.empty()) {
    std::ranges::fill(gradient, 0.0);
    for (std::size_t i = 0; i < tied_.size(); ++i)
      gradient[static_cast<std::size_t>(tied_[i])] += own_gradient_[i];
  }
  for (const double c : costs_) cost += c;
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
    if (tied_.empty()) options.blocks.assign(offsets_.begin(), offsets_.end() - 1);
    options.changed = [&](int iteration) {
      if (refresh_at(iteration)) refresh(x);
      return refresh_at(iteration);
    };
    options.stop = [&](int, double) { return deadline.expired(); };
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
