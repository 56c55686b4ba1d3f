#include "seine/planner/formation_guess.hpp"

#include <algorithm>
#include <cmath>

namespace seine::planner {
namespace {

using geom::Vec2;

constexpr double kGoalShare = 0.7;     // of the delivery's radius
constexpr double kLateEnough = -0.35;  // s: a guess later than this at a rendezvous is looked for again
constexpr double kChangeLength = 5.0;  // car lengths over which the formation changes shape

std::optional<search::FormationGoal> goal_of(const world::Scenario& scenario) {
  if (scenario.delivery)
    return search::FormationGoal{scenario.delivery->center, kGoalShare * scenario.delivery->radius,
                                 scenario.delivery->heading};
  return std::nullopt;
}

FormationGuess assemble(search::FormationPath way, const search::FormationProblem& problem) {
  FormationGuess guess;
  guess.timing = search::time_formation(way, problem);
  guess.before = problem.before, guess.after = problem.after;
  guess.change_begin = way.meeting_s.empty() ? 0.0 : way.meeting_s.back();
  const double length = problem.scenario->model_of(problem.scenario->robots.front()).length();
  guess.change_end = std::min(guess.change_begin + kChangeLength * length, way.path.length());
  guess.way = std::move(way);
  return guess;
}

}  // namespace

std::optional<FormationGuess> guess_formation(const world::Scenario& scenario, const world::StaticMap& map,
                                              const NetQuestion& question, int attempt,
                                              const Deadline& deadline, std::string& reason) {
  search::FormationProblem problem;
  problem.scenario = &scenario, problem.map = &map, problem.tall = question.tall.get();
  problem.start = search::formation_frame(scenario);
  problem.start_speed = scenario.robots.front().start_speed;
  problem.before = problem.after = search::start_formation(scenario);
  problem.meetings = question.meetings;
  problem.goal = goal_of(scenario);
  problem.deadline = deadline;
  search::FormationSettings settings;
  settings.field = attempt % 2 == 1;
  if (attempt >= 2) return std::nullopt;
  auto way = search::search_formation(problem, settings);
  if (!way) {
    reason = "no passage for the formation found";
    return std::nullopt;
  }
  FormationGuess guess = assemble(std::move(*way), problem);
  (void)kLateEnough;
  return guess;
}

}  // namespace seine::planner
