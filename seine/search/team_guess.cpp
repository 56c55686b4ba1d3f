#include "seine/search/team_guess.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "seine/base/workers.hpp"
#include "seine/search/coordinator.hpp"
#include "seine/search/path_planner.hpp"
#include "seine/search/side_step.hpp"
#include "seine/search/team_search.hpp"

namespace seine::search {
namespace {

std::size_t idx(int i) {
  return static_cast<std::size_t>(i);
}

// One guess from the question to the answer.
class Guess {
 public:
  Guess(const world::Scenario& scenario, const world::StaticMap& map, const GuessOptions& options)
      : scenario_(scenario),
        options_(options),
        coordinator_(scenario, options.lattice, options.extra_robot_clearance),
        state_(scenario.robots.size()) {
    Stopwatch watch;
    for (const vehicle::Model& model : scenario.models) {
      planners_.emplace_back(map, model);
      side_steps_.emplace_back(map, model, scenario.margins.obstacle);
    }
    guess_.seconds.field = watch.seconds();
  }

  TeamGuess run();

 private:
  std::optional<Path> find_path(int robot, std::span<const Bump> bumps,
                                std::span<const std::vector<geom::Vec2>> parked, int expansions) const;
  bool find_first_ways();
  void answer(bool complete);

  const world::Scenario& scenario_;
  const GuessOptions& options_;
  std::vector<PathPlanner> planners_;  // one for each model
  std::deque<SideStep> side_steps_;    // likewise
  Coordinator coordinator_;
  TeamState state_;
  TeamGuess guess_;
};

std::optional<Path> Guess::find_path(int robot, std::span<const Bump> bumps,
                                     std::span<const std::vector<geom::Vec2>> parked, int expansions) const {
  const world::Robot& who = scenario_.robots[idx(robot)];
  return planners_[idx(who.model)].plan(who.start, who.goal,
                                        {.max_expansions = expansions,
                                         .clearance = scenario_.margins.obstacle,
                                         .bumps = bumps,
                                         .parked = parked,
                                         .parked_clearance = scenario_.margins.robot,
                                         .deadline = options_.deadline});
}

// The shortest path of everybody, and the motions that are given. False: somebody has none.
bool Guess::find_first_ways() {
  const int count = coordinator_.robots();
  if (options_.fixed != nullptr)
    for (int i = 0; i < count; ++i)
      if ((*options_.fixed)[idx(i)]) coordinator_.fix(i, *(*options_.fixed)[idx(i)], state_);
  Workers workers(std::max(1, options_.threads));
  workers.run(count, [this](int robot) {
    if (state_[idx(robot)]) return;
    constexpr int kPatience = 20000;
    if (std::optional<Path> path = find_path(robot, {}, {}, kPatience))
      coordinator_.add_way(robot, std::move(*path));
  });
  for (int i = 0; i < count; ++i)
    if (!state_[idx(i)] && coordinator_.ways(i).empty())
      guess_.reason +=
          (guess_.reason.empty() ? "no path even alone: " : ", ") + scenario_.robots[idx(i)].name;
  return guess_.reason.empty();
}

void Guess::answer(bool complete) {
  for (int i = 0; i < coordinator_.robots(); ++i) {
    guess_.alone.push_back(coordinator_.alone(i));
    const auto& placement = state_[idx(i)];
    guess_.robots.push_back(placement ? coordinator_.motion(i, *placement) : TimedPath{});
    if (!placement && guess_.reason.empty()) guess_.reason = "no motion among the others: ";
    if (!placement) guess_.reason += scenario_.robots[idx(i)].name + " ";
  }
  guess_.complete = complete;
}

TeamGuess Guess::run() {
  Stopwatch watch;
  const bool all = find_first_ways();
  guess_.seconds.paths = watch.seconds();
  if (!all) {
    answer(false);
    return std::move(guess_);
  }
  Stopwatch coordination;
  const auto find = [this](int robot, std::span<const Bump> bumps,
                           std::span<const std::vector<geom::Vec2>> parked,
                           int expansions) { return find_path(robot, bumps, parked, expansions); };
  const auto beside = [this](int robot, const Path& path, double s, double offset) {
    return side_steps_[idx(scenario_.robots[idx(robot)].model)].around(path, s, offset);
  };
  TeamSearch search(coordinator_, {find, beside}, options_.team, options_.seed);
  const bool solved = search.solve(state_, options_.deadline);
  if (solved) search.improve(state_, options_.deadline);
  guess_.effort = search.effort();
  guess_.seconds.coordinate = coordination.seconds();
  answer(solved);
  return std::move(guess_);
}

}  // namespace

TeamGuess guess_team(const world::Scenario& scenario, const world::StaticMap& map,
                     const GuessOptions& options) {
  return Guess(scenario, map, options).run();
}

}  // namespace seine::search
