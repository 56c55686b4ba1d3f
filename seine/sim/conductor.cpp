#include "seine/sim/conductor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "seine/net/flight.hpp"
#include "seine/sim/pacing.hpp"
#include "seine/sim/stopping.hpp"

namespace seine::sim {
namespace {

constexpr double kLastAsk = 0.25;      // s before a catch the plan is left alone
constexpr double kSilence = 0.1;       // s without an answer: a car is taken for broken
constexpr double kBlind = 1.0;         // s without a fix are too long to go on
constexpr int kFailures = 3;           // of a controller in a row are too many to go on
constexpr double kOffWay = 0.5;        // m beside its reference a car is lost …
constexpr double kOffWayLong = 0.15;   // … or this part of its length, where that is more
constexpr double kPaceResponse = 0.2;  // s in which the clock is brought to the pace of the slowest
// 1/s: so fast the clock may slow down although a car brakes as hard as it can; that one gets some cm ahead.
constexpr double kAlways = 0.25;
constexpr double kAfterCrossing = 0.2;  // s: flights are not known better

std::string centimetres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.0f cm", 100.0 * metres);
  return text;
}

// What a better plan is better in.
std::string gain(const Worth& now, const Worth& then) {
  constexpr double kWorthTelling = 0.005;  // m
  if (now.shortfall > then.shortfall + kWorthTelling)
    return "margins lack " + centimetres(then.shortfall) + " instead of " + centimetres(now.shortfall);
  char text[64];
  std::snprintf(text, sizeof text, "margins kept, at rest %.1f s %s", std::abs(now.arrival - then.arrival),
                then.arrival < now.arrival ? "sooner" : "later");
  return text;
}

// When the last thing has happened that does not wait for the team: moving obstacles never wait.
double free_of_time(const world::Scenario& scenario) {
  double free = 0.0;
  for (const world::Obstacle& obstacle : scenario.obstacles)
    if (!world::stands_still(obstacle)) free = 1e300;
  for (const net::Target& target : scenario.targets) {
    const auto crossing = net::Flight(target).crossing(scenario.net->rim());
    if (crossing) free = std::max(free, crossing->state.time + kAfterCrossing);
  }
  return free;
}

}  // namespace

Conductor::Conductor(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                     const SimulationOptions& options, double start)
    : scenario_(scenario),
      options_(options),
      plan_(plan),
      clock_(start),
      free_from_(free_of_time(scenario)) {}

void Conductor::advance(double duration) {
  const double before = clock_.time();
  clock_.advance(duration);
  if (!stopping_) waited_ += duration - (clock_.time() - before);
}

std::string Conductor::name(std::size_t robot) const {
  const std::string& given = scenario_.robots[robot].name;
  return given.empty() ? "robot " + std::to_string(robot + 1) : given;
}

std::vector<std::string> Conductor::news() {
  return std::exchange(news_, {});
}

void Conductor::decide(double time, std::span<const Car> cars, const std::vector<net::Target>& in_the_air) {
  if (!stopping_) {
    if (const auto why = reason_to_stop(time, cars)) {
      stopping_ = true;
      candidate_.reset();
      news_.push_back(*why + ": the team stops");
    }
  }
  if (stopping_) {
    const CarState silent = silent_ ? cars[*silent_].belief() : CarState{};
    clock_.accelerate(stopping_change(scenario_, plan_, clock_, silent_, silent));
    return;
  }
  keep_together(time, cars);
  if (candidate_ && time >= candidate_->begin - 1e-9) weigh(time, in_the_air);
  if (time_to_ask(time, in_the_air)) ask(time, in_the_air);
}

// Slower than planned is as safe as planned, and leaves the cars that fell behind speed to catch up with.
void Conductor::keep_together(double time, std::span<const Car> cars) {
  if (time < free_from_) return;
  const double pace = pace_of(plan_, clock_, cars);
  const RateChange possible = possible_change(scenario_, plan_, clock_, std::nullopt);
  const double least = std::min(possible.least, -kAlways);
  clock_.accelerate(std::clamp((pace - clock_.rate()) / kPaceResponse, least, possible.most), pace);
}

std::optional<std::string> Conductor::reason_to_stop(double time, std::span<const Car> cars) {
  for (const Faults::Breakdown& fault : options_.faults.breakdowns) {
    if (time < fault.at + kSilence) continue;
    silent_ = fault.robot;
    return name(fault.robot) + " does not answer";
  }
  for (std::size_t k = 0; k < cars.size(); ++k) {
    if (cars[k].since_fix() > kBlind) return name(k) + " does not know where it is";
    if (cars[k].failures() >= kFailures) {
      silent_ = k;
      return name(k) + " has no controller";
    }
    const geom::Vec2 reference = clock_.state_on(plan_.robots[k]).pose.position();
    const double off = geom::norm(cars[k].belief().pose.position() - reference);
    if (off > std::max(kOffWay, kOffWayLong * scenario_.model_of(scenario_.robots[k]).length()))
      return name(k) + " is " + centimetres(off) + " off its way";
  }
  return std::nullopt;
}

bool Conductor::time_to_ask(double time, const std::vector<net::Target>& in_the_air) const {
  if (!options_.replanner || candidate_ || time < std::max(0.0, next_ask_) - 1e-9) return false;
  double next_catch = 1e300;
  for (const net::Target& target : in_the_air) {
    const auto crossing = net::Flight(target).crossing(scenario_.net->rim());
    if (crossing) next_catch = std::min(next_catch, crossing->state.time);
  }
  return next_catch < 1e300 && time + options_.replan_deadline < next_catch - kLastAsk;
}

void Conductor::ask(double time, const std::vector<net::Target>& in_the_air) {
  next_ask_ = time + options_.replan_period;
  ++asked_;
  Candidate candidate;
  candidate.begin = time + options_.replan_deadline;
  const double plan_time = clock_.ahead(options_.replan_deadline).time();
  const Situation situation{task_left(scenario_, plan_, plan_time, candidate.begin, in_the_air), plan_,
                            plan_time, options_.replan_deadline};
  candidate.answer = options_.replanner(situation);
  candidate.late = candidate.answer.seconds > options_.replan_deadline;
  for (const Faults::LateReplan& fault : options_.faults.late_replans)
    candidate.late = candidate.late || (time >= fault.from && time < fault.from + fault.duration);
  candidate_ = std::move(candidate);
}

// The answer is looked at when its plan would begin: by what is known then.
void Conductor::weigh(double time, const std::vector<net::Target>& in_the_air) {
  const Candidate candidate = *std::exchange(candidate_, std::nullopt);
  if (candidate.late) {
    ++late_;
    if (!std::exchange(was_late_, true)) news_.push_back("a new plan came too late and is not used");
    return;
  }
  was_late_ = false;
  if (!candidate.answer.certified) return;
  const Worth now = worth_of(scenario_, plan_, begin_, in_the_air);
  const Worth then = worth_of(scenario_, candidate.answer.plan, candidate.begin, in_the_air);
  if (!better(then, now)) return;
  plan_ = candidate.answer.plan;
  begin_ = candidate.begin;
  clock_ = PlanClock(time - begin_);
  waited_ = 0.0;
  ++adopted_;
  news_.push_back("a new plan is followed: " + gain(now, then));
}

}  // namespace seine::sim
