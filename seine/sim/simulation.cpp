#include "seine/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "seine/base/deadline.hpp"
#include "seine/base/rng.hpp"
#include "seine/net/shape.hpp"
#include "seine/sim/car.hpp"
#include "seine/sim/clearance.hpp"
#include "seine/sim/conductor.hpp"
#include "seine/sim/preconditions.hpp"
#include "seine/sim/scene.hpp"

namespace seine::sim {
namespace {

using geom::Vec2;
using geom::Vec3;

constexpr double kAfterCatch = 2.6;          // s watched after the last target crossed the rim …
constexpr double kAfterEnd = 1.0;            // … and after the team should have come to rest
constexpr double kAtRest = 1e-3;             // m/s
constexpr double kGoalTolerance = 0.1;       // m, of cars' goals
constexpr double kDeliveryTolerance = 0.05;  // m beyond the delivery's radius, for driving errors

// A team that moves already when its plan begins has no time for a countdown.
double countdown_of(const traj::TeamTrajectory& plan) {
  const bool rests =
      std::all_of(plan.robots.begin(), plan.robots.end(),
                  [](const traj::RobotTrajectory& way) { return std::abs(way.at(0.0).speed) < kAtRest; });
  return rests ? kCountdown : 0.0;
}

class Loop {
 public:
  Loop(const world::Scenario& scenario, const traj::TeamTrajectory& plan, const Controller& controller,
       const SimulationOptions& options);
  SimulationResult run();

 private:
  void sense(double time);
  void control(double time);
  void step(double time);
  void measure(double time);
  void record(double time);
  void tell(double time, const std::vector<std::string>& news);
  void conclude();
  double end() const;
  double goal_error() const;
  std::vector<Vec3> corners() const;

  const world::Scenario& scenario_;
  const Controller& controller_;
  const SimulationOptions& options_;
  Surroundings surroundings_;
  double countdown_;  // s
  Conductor conductor_;
  std::vector<Car> cars_;
  std::optional<Scene> scene_;
  double squares_ = 0.0;  // m², of tracking errors
  int samples_ = 0;
  SimulationResult result_;
};

Loop::Loop(const world::Scenario& scenario, const traj::TeamTrajectory& plan, const Controller& controller,
           const SimulationOptions& options)
    : scenario_(scenario),
      controller_(controller),
      options_(options),
      surroundings_(scenario),
      countdown_(countdown_of(plan)),
      conductor_(scenario, plan, options, -countdown_) {
  Rng seeds(options.seed);
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const vehicle::Model& model = scenario.model_of(scenario.robots[k]);
    const traj::State start = plan.robots[k].at(0.0);
    const CarState state{start.pose, start.speed, std::atan(model.wheelbase * start.curvature)};
    cars_.emplace_back(model, options.noise, state, seeds.next());
  }
  if (scenario.net) scene_.emplace(scenario, corners(), options.noise, seeds);
  result_.min_clearance = Surroundings::kFarEnough;
}

std::vector<Vec3> Loop::corners() const {
  std::vector<Vec3> corners;
  for (std::size_t k = 0; k < cars_.size(); ++k) {
    const net::Attachment& attachment = scenario_.net->attachments[k];
    const Vec2 at = cars_[k].truth().pose * attachment.at;
    corners.push_back({at.x, at.y, attachment.height});
  }
  return corners;
}

double Loop::end() const {
  const double caught = scene_ ? scene_->last_crossing() + kAfterCatch : 0.0;
  return std::max(conductor_.end(), caught) + kAfterEnd;
}

SimulationResult Loop::run() {
  const Stopwatch watch;
  const auto every = [](int tick, double period) {
    return tick % static_cast<int>(std::lround(period / kTick)) == 0;
  };
  if (options_.recorder != nullptr) options_.recorder->begin(scenario_);
  double time = -countdown_;
  const int first = static_cast<int>(std::lround(time / kTick));
  for (int tick = first; time < end(); ++tick) {
    if (every(tick, Localisation::kOdometryPeriod) && tick > first) sense(time);
    if (scene_) scene_->look(time, options_.faults.target_jumps);
    if (every(tick, kControlPeriod)) control(time);
    if (tick >= 0 && every(tick, kRecordPeriod)) {
      measure(time);
      if (options_.progress) options_.progress(time / end());
      if (options_.recorder != nullptr) record(time);
    }
    time = kTick * (tick + 1);
    step(time);
  }
  result_.duration = time;
  conclude();
  result_.real_time_factor = time / watch.seconds();
  if (options_.recorder != nullptr) options_.recorder->end();
  return std::move(result_);
}

void Loop::sense(double time) {
  for (std::size_t k = 0; k < cars_.size(); ++k) {
    bool fix = true;
    for (const Faults::LostFix& fault : options_.faults.lost_fixes)
      fix = fix && !(fault.robot == k && time >= fault.from && time < fault.from + fault.duration);
    cars_[k].sense(fix);
  }
}

void Loop::control(double time) {
  conductor_.decide(time, cars_, scene_ ? scene_->in_the_air() : std::vector<net::Target>{});
  tell(time, conductor_.news());
  for (const Faults::Breakdown& fault : options_.faults.breakdowns)
    if (time >= fault.at) cars_[fault.robot].break_down();
  for (std::size_t k = 0; k < cars_.size(); ++k) {
    bool fails = false;
    for (const Faults::FailedControl& fault : options_.faults.failed_controls)
      fails = fails || (fault.robot == k && time >= fault.at && time < fault.at + fault.duration);
    cars_[k].control(k, time, conductor_.reference_of(k), controller_, fails);
  }
}

// One tick that ends at `time`.
void Loop::step(double time) {
  conductor_.advance(kTick);
  for (std::size_t k = 0; k < cars_.size(); ++k)
    cars_[k].advance(kTick, scene_ ? scene_->pulls()[k].ground() : Vec2{});
  if (!scene_) return;
  scene_->advance(time, kTick, corners());
  tell(time, scene_->news());
}

void Loop::measure(double time) {
  std::vector<geom::Pose2> poses;
  for (std::size_t k = 0; k < cars_.size(); ++k) {
    poses.push_back(cars_[k].truth().pose);
    const geom::Pose2 reference = conductor_.clock().state_on(conductor_.plan().robots[k]).pose;
    const double off = geom::norm(poses.back().position() - reference.position());
    result_.tracking_worst = std::max(result_.tracking_worst, off);
    if (time > conductor_.end()) continue;
    squares_ += off * off;
    ++samples_;
  }
  result_.min_clearance = std::min(result_.min_clearance, surroundings_.clearance(time, poses));
  if (!scene_) return;
  const std::vector<Vec3> held = corners();
  for (std::size_t i = 0; i < held.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      result_.worst_stretch =
          std::max(result_.worst_stretch, norm(held[i] - held[j]) / net::rest_distance(*scenario_.net, i, j));
}

void Loop::record(double time) {
  Record record{.time = time, .plan_time = conductor_.clock().time(), .plan_rate = conductor_.clock().rate()};
  for (std::size_t k = 0; k < cars_.size(); ++k) {
    record.cars.push_back({cars_[k].truth(), cars_[k].belief(),
                           conductor_.clock().state_on(conductor_.plan().robots[k]), cars_[k].command(),
                           scene_ ? scene_->pulls()[k].ground() : Vec2{}});
  }
  if (scene_) scene_->record(record);
  options_.recorder->record(record);
}

void Loop::tell(double time, const std::vector<std::string>& news) {
  for (const std::string& text : news) {
    result_.notes.push_back({time, text});
    if (options_.recorder != nullptr) options_.recorder->note(result_.notes.back());
  }
}

double Loop::goal_error() const {
  double worst = 0.0;
  for (std::size_t k = 0; k < cars_.size(); ++k) {
    const auto& goal = scenario_.robots[k].goal;
    if (goal) worst = std::max(worst, geom::norm(cars_[k].truth().pose.position() - goal->position()));
  }
  if (!scenario_.delivery || !scenario_.net) return worst;
  Vec2 middle;
  for (const Vec3 corner : corners()) middle += corner.ground() / static_cast<double>(cars_.size());
  return std::max(worst, geom::norm(middle - scenario_.delivery->center) - scenario_.delivery->radius);
}

void Loop::conclude() {
  result_.tracking_rms = samples_ > 0 ? std::sqrt(squares_ / samples_) : 0.0;
  result_.stopped = conductor_.stopping();
  result_.replans = conductor_.adopted();
  result_.replans_asked = conductor_.asked();
  result_.replans_late = conductor_.late();
  result_.goal_error = goal_error();
  const bool arrived = result_.goal_error <= (scenario_.delivery ? kDeliveryTolerance : kGoalTolerance) &&
                       std::all_of(cars_.begin(), cars_.end(),
                                   [](const Car& car) { return std::abs(car.truth().speed) < 0.05; });
  if (scene_) result_.outcomes = scene_->outcomes(arrived);
  const auto all = [&](auto what) {
    return std::all_of(result_.outcomes.begin(), result_.outcomes.end(), what);
  };
  result_.caught = all([](const Outcome& outcome) { return outcome.fate == Fate::caught; });
  result_.delivered = arrived && all([](const Outcome& outcome) { return outcome.delivered; });
}

}  // namespace

SimulationResult simulate(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                          const Controller& controller, const SimulationOptions& options) {
  expect_preconditions(scenario, plan, controller, options);
  return Loop(scenario, plan, controller, options).run();
}

}  // namespace seine::sim
