#include "seine/search/team_guess.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <memory>
#include <numeric>

#include "seine/base/rng.hpp"
#include "seine/base/workers.hpp"
#include "seine/search/blockers.hpp"
#include "seine/search/car_paths.hpp"
#include "seine/search/coordinator.hpp"
#include "seine/search/making_way.hpp"
#include "seine/search/no_passing.hpp"
#include "seine/search/precedence.hpp"
#include "seine/search/refusal.hpp"
#include "seine/search/rolling_start.hpp"
#include "seine/search/roundabout.hpp"
#include "seine/search/side_step.hpp"
#include "seine/search/team_search.hpp"

namespace seine::search {
namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

constexpr std::size_t kMostPairs = 4'000'000;  // of cells in a proof: some tenths of a second

// A set of ways for everybody, and how far it got with them.
struct Attempt {
  std::unique_ptr<Coordinator> coordinator;
  TeamState state;
  bool complete = false;
};

// One guess from the question to the answer.
class Guess {
 public:
  Guess(const world::Scenario& scenario, const world::StaticMap& map, const GuessOptions& options);
  TeamGuess run();

 private:
  TeamSearch::Sources sources();
  Attempt new_attempt() const;
  bool find_first_ways(Attempt& attempt);
  void leave_tried_ways(Attempt& attempt) const;
  std::vector<int> first_order(const Coordinator& coordinator) const;
  void coordinate(Attempt& attempt);
  std::optional<Attempt> go_round(const Attempt& straight);
  Attempt by_ring(const Attempt& straight, const Crossing& crossing, double radius);
  std::string first_meeting(const Attempt& attempt, int robot) const;
  void answer(const Attempt& attempt);

  const world::Scenario& scenario_;
  const world::StaticMap& map_;
  const GuessOptions& options_;
  CarPaths paths_;
  std::deque<SideStep> side_steps_;  // one for each model
  MakingWay making_way_;
  TeamGuess guess_;
};

Guess::Guess(const world::Scenario& scenario, const world::StaticMap& map, const GuessOptions& options)
    : scenario_(scenario),
      map_(map),
      options_(options),
      paths_(scenario, map, options),
      making_way_(scenario, map, paths_.planners(),
                  {scenario.margins.robot + options.extra_robot_clearance, options.deadline}) {
  Stopwatch watch;
  for (const vehicle::Model& model : scenario.models) {
    side_steps_.emplace_back(map, model, scenario.margins.obstacle);
  }
  guess_.seconds.field = watch.seconds();
}

TeamSearch::Sources Guess::sources() {
  return {[this](int robot, std::span<const Bump> bumps, std::span<const std::vector<geom::Vec2>> parked,
                 int expansions) { return paths_.around(robot, bumps, parked, expansions); },
          [this](int robot, const Path& path, double s, double offset, double beside) {
            return side_steps_[idx(scenario_.robots[idx(robot)].model)].around(path, s, offset, beside);
          },
          [this](int robot, std::span<const Traffic> traffic, const TeamSearch::Sources::Among& how) {
            return paths_.among(robot, traffic, how);
          },
          [this](int robot, const Path& way, const MakingWay::Other& other) {
            return making_way_.by_bays(robot, way, other);
          },
          [this](int robot, const Path& way, std::span<const MakingWay::Other> others) {
            return making_way_.by_refuges(robot, way, others);
          },
          [this](int a, int b) { return cannot_both_arrive(scenario_, map_, a, b, kMostPairs); }};
}

// Nobody has a way yet; who is fixed has its motion.
Attempt Guess::new_attempt() const {
  Attempt attempt{std::make_unique<Coordinator>(scenario_, options_.lattice, options_.extra_robot_clearance,
                                                options_.deadline),
                  TeamState(scenario_.robots.size())};
  if (options_.fixed != nullptr)
    for (std::size_t i = 0; i < scenario_.robots.size(); ++i)
      if ((*options_.fixed)[i])
        attempt.coordinator->fix(static_cast<int>(i), *(*options_.fixed)[i], attempt.state);
  return attempt;
}

// The shortest path of everybody. False: somebody has none.
bool Guess::find_first_ways(Attempt& attempt) {
  const int count = attempt.coordinator->robots();
  Workers workers(std::max(1, options_.threads));
  workers.run(count, [&](int robot) {
    if (attempt.coordinator->fixed(robot) || options_.deadline.expired()) return;
    if (std::optional<Path> path = paths_.first(robot)) attempt.coordinator->add_way(robot, std::move(*path));
  });
  for (int i = 0; i < count; ++i) {
    const world::Robot& who = scenario_.robots[idx(i)];
    if (who.start_speed == 0.0 || attempt.coordinator->fixed(i) || !attempt.coordinator->ways(i).empty())
      continue;
    const std::string reason = no_room_to_stop(
        {&map_, &scenario_.model_of(who), who.start, who.start_speed, scenario_.margins.obstacle});
    if (!reason.empty() && guess_.reason.empty()) guess_.reason = who.name + " " + reason;
  }
  if (!guess_.reason.empty()) return false;
  for (int i = 0; i < count; ++i)
    if (!attempt.coordinator->fixed(i) && attempt.coordinator->ways(i).empty())
      guess_.without_way.push_back(i);
  return guess_.without_way.empty();
}

// A repair wants something else: some of the robots that were tried before get a way that bends off their
// last one.
void Guess::leave_tried_ways(Attempt& attempt) const {
  if (options_.avoid == nullptr) return;
  Rng rng(options_.seed);
  for (std::size_t i = 0; i < options_.avoid->size(); ++i) {
    const int robot = static_cast<int>(i);
    const std::vector<TimedPath>& tried = (*options_.avoid)[i];
    constexpr double kShare = 0.6;  // if everybody changes sides they meet again
    if (tried.empty() || attempt.coordinator->fixed(robot) || rng.uniform() > kShare) continue;
    const double length = scenario_.model_of(scenario_.robots[i]).length();
    std::vector<Bump> bumps;
    for (const TimedPath& motion : tried) {
      const geom::Pose2 there = pose_at(motion.path, rng.uniform(0.25, 0.75) * motion.path.length());
      bumps.push_back({there.position(), options_.team.bump_lengths * length, options_.team.bump_weight});
    }
    std::optional<Path> path = paths_.around(robot, bumps, {}, options_.team.detour_expansions);
    if (path && attempt.coordinator->add_way(robot, std::move(*path)))
      attempt.coordinator->drop_way(robot, 0);
  }
}

// Empty (the usual order) for the first guess of all; shuffled for every other.
std::vector<int> Guess::first_order(const Coordinator& coordinator) const {
  if (options_.seed == 0 && options_.avoid == nullptr) return {};
  Rng rng(options_.seed);
  std::vector<double> keys;
  for (int i = 0; i < coordinator.robots(); ++i) keys.push_back(coordinator.alone(i) * rng.uniform(0.5, 1.5));
  return Precedence(coordinator).order(keys);
}

void Guess::coordinate(Attempt& attempt) {
  TeamSearch search(*attempt.coordinator, sources(), options_.team, options_.seed);
  attempt.complete = search.solve(attempt.state, options_.deadline, first_order(*attempt.coordinator));
  if (attempt.complete) search.improve(attempt.state, options_.deadline);
  if (search.hopeless()) {
    guess_.reason = cannot_pass_sentence(scenario_, search.hopeless()->first, search.hopeless()->second);
    guess_.impossible = true;
  }
  guess_.effort = search.effort();
}

// Everybody keeps right around the densest crossing; the best of a few rings, when it flows.
std::optional<Attempt> Guess::go_round(const Attempt& straight) {
  const auto crossing = find_crossing(scenario_);
  if (!crossing) return std::nullopt;
  const double alone = std::accumulate(guess_.alone.begin(), guess_.alone.end(), 0.0);
  const double radius = ring_radius(scenario_, *crossing);
  // Smaller as long as that is quicker; if it is not at once, larger.
  constexpr double kSmaller = 0.94, kLarger = 1.12;
  std::optional<Attempt> best;
  const auto quicker = [&](double scale) {
    Attempt attempt = by_ring(straight, *crossing, scale * radius);
    if (!attempt.complete || (best && sum_of_arrivals(attempt.state) >= sum_of_arrivals(best->state)))
      return false;
    best = std::move(attempt);
    return true;
  };
  quicker(1.0);
  double scale = kSmaller;
  while (quicker(scale)) scale *= kSmaller;
  if (scale == kSmaller)
    for (scale = kLarger; scale < 2.0 && quicker(scale);) scale *= kLarger;
  constexpr double kFlows = 1.6;  // of the time alone: beyond, giving way may be quicker
  if (!best || sum_of_arrivals(best->state) > kFlows * alone) return std::nullopt;
  TeamSearch search(*best->coordinator, sources(), options_.team, options_.seed);
  search.improve(best->state, options_.deadline);
  guess_.effort = search.effort();
  return best;
}

// Who can take the ring has no other way yet.
Attempt Guess::by_ring(const Attempt& straight, const Crossing& crossing, double radius) {
  Attempt attempt = new_attempt();
  for (int i = 0; i < straight.coordinator->robots(); ++i) {
    if (attempt.coordinator->fixed(i)) continue;
    if (options_.deadline.expired()) return attempt;
    std::optional<Path> path;
    if (std::binary_search(crossing.robots.begin(), crossing.robots.end(), i))
      path = path_by_ring(scenario_, map_, i, crossing.center, radius);
    if (!path) path = straight.coordinator->ways(i).front()->lattice.path();
    attempt.coordinator->add_way(i, std::move(*path));
  }
  TeamSearchOptions brief = options_.team;  // a ring that needs more does not flow
  brief.passes = 1;
  brief.repairs_each = 1;
  brief.rescuing_paths = 0.0;
  TeamSearch search(*attempt.coordinator, {}, brief, options_.seed);
  attempt.complete = search.solve(attempt.state, options_.deadline);
  return attempt;
}

// " (would meet obstacle 3 at t = 5.2 s)": what is first in the way of its quickest drive.
std::string Guess::first_meeting(const Attempt& attempt, int robot) const {
  const Coordinator& coordinator = *attempt.coordinator;
  if (coordinator.ways(robot).empty()) return "";
  CoordinatorWorkspace workspace;
  const auto conflicts =
      coordinator.conflicts(robot, *coordinator.ways(robot).front(), attempt.state, workspace);
  if (conflicts.empty()) return "";
  const Coordinator::Conflict& first = conflicts.front();
  std::string other = first.robot >= 0 ? scenario_.robots[idx(first.robot)].name
                                       : scenario_.obstacles[idx(first.obstacle)].name;
  if (other.empty()) other = "obstacle " + std::to_string(first.obstacle + 1);
  char text[96];
  std::snprintf(text, sizeof text, " at t = %.1f s", first.tick * coordinator.grid(robot).half_step());
  return "; on its way " + scenario_.robots[idx(robot)].name + " would meet " + other + text;
}

void Guess::answer(const Attempt& attempt) {
  for (int i = 0; i < attempt.coordinator->robots(); ++i) {
    const auto& placement = attempt.state[idx(i)];
    guess_.robots.push_back(placement ? attempt.coordinator->motion(i, *placement) : TimedPath{});
  }
  guess_.complete = attempt.complete;
  if (guess_.complete || !guess_.without_way.empty() || !guess_.reason.empty()) return;
  for (std::size_t i = 0; i < attempt.state.size(); ++i)
    if (!attempt.state[i]) {
      guess_.without_motion.push_back(static_cast<int>(i));
      guess_.meetings += first_meeting(attempt, static_cast<int>(i));
    }
}

TeamGuess Guess::run() {
  Stopwatch watch;
  Attempt attempt = new_attempt();
  const bool all = find_first_ways(attempt);
  guess_.seconds.paths = watch.seconds();
  for (int i = 0; i < attempt.coordinator->robots(); ++i)
    guess_.alone.push_back(attempt.coordinator->alone(i));
  Stopwatch coordination;
  if (all) {
    leave_tried_ways(attempt);
    if (std::optional<Attempt> round = go_round(attempt))
      attempt = std::move(*round);
    else
      coordinate(attempt);
  }
  guess_.seconds.coordinate = coordination.seconds();
  answer(attempt);
  return std::move(guess_);
}

}  // namespace

TeamGuess guess_team(const world::Scenario& scenario, const world::StaticMap& map,
                     const GuessOptions& options) {
  TeamGuess guess = Guess(scenario, map, options).run();
  guess.extra_robot_clearance = options.extra_robot_clearance;
  const bool rolling = std::any_of(scenario.robots.begin(), scenario.robots.end(),
                                   [](const world::Robot& robot) { return robot.start_speed != 0.0; });
  if (!guess.complete && !guess.impossible && rolling && !options.deadline.expired()) {
    constexpr double kHard = 0.985;  // of the limits, where a car has to stop at once
    GuessOptions hard = options;
    hard.lattice.acceleration_factor = kHard;
    hard.lattice.speed_factor = std::max(options.lattice.speed_factor, kHard);
    if (TeamGuess other = Guess(scenario, map, hard).run(); other.complete) return other;
  }
  // Cars that start nose to nose may not be able to part with more room than the margin.
  for (const double share : {0.5, 0.0}) {
    if (guess.complete || guess.impossible || options.extra_robot_clearance <= 0.0 ||
        options.deadline.expired())
      break;
    GuessOptions less = options;
    less.extra_robot_clearance = share * options.extra_robot_clearance;
    guess = Guess(scenario, map, less).run();
    guess.extra_robot_clearance = less.extra_robot_clearance;
  }
  if (guess.impossible || (!guess.complete && !options.explain)) return guess;
  if (!guess.without_way.empty()) {
    Verdict verdict = why_no_ways(scenario, map, guess.without_way, options.deadline.expired());
    guess.reason = std::move(verdict.reason);
    guess.impossible = verdict.proved;
  } else if (!guess.without_motion.empty()) {
    guess.reason = why_no_motion(scenario, map, guess.without_motion, options.explain_until) + guess.meetings;
  }
  return guess;
}

}  // namespace seine::search
