#include "seine/planner/formation_guess.hpp"

#include <algorithm>
#include <cmath>

#include "seine/net/catch_rules.hpp"
#include "seine/search/formation_shapes.hpp"

namespace seine::planner {
namespace {

using geom::Vec2;
using search::Formation;

constexpr double kGoalShare = 0.7;      // of the delivery's radius
constexpr double kChangeLength = 5.0;   // car lengths over which the formation changes shape
constexpr int kQuickExpansions = 1500;  // as the crow flies; then around what is tall
constexpr int kFieldExpansions = 6000;
constexpr int kShapeExpansions = 2500;
constexpr std::size_t kShapes = 24;  // tried in one call

search::FormationProblem problem_for(const world::Scenario& scenario, const world::StaticMap& map,
                                     const NetQuestion& question, const Deadline& deadline) {
  search::FormationProblem problem;
  problem.scenario = &scenario, problem.map = &map, problem.tall = question.tall.get();
  problem.start = search::formation_frame(scenario);
  problem.start_speed = scenario.robots.front().start_speed;
  problem.before = problem.after = search::start_formation(scenario);
  problem.meetings = question.meetings;
  problem.deadline = deadline;
  if (scenario.delivery) {
    problem.goal = search::FormationGoal{scenario.delivery->center, kGoalShare * scenario.delivery->radius,
                                         scenario.delivery->heading};
  }
  return problem;
}

// Where every robot has a goal of its own the formation ends as they stand there.
void end_at_goals(const world::Scenario& scenario, search::FormationProblem& problem) {
  Vec2 frame, direction;
  for (const world::Robot& robot : scenario.robots) {
    if (!robot.goal) return;
    frame += robot.goal->position() / static_cast<double>(scenario.robots.size());
    direction += robot.goal->direction();
  }
  const double heading = std::atan2(direction.y, direction.x);
  for (std::size_t k = 0; k < scenario.robots.size(); ++k)
    problem.after.offsets[k] = scenario.robots[k].goal->position() - frame;
  std::vector<Vec2> ring;
  search::attachments_at(scenario, problem.after, {frame.x, frame.y, heading}, ring);
  Vec2 middle;
  for (const Vec2 a : ring) middle += a / static_cast<double>(ring.size());
  problem.goal = search::FormationGoal{middle, 0.5 * scenario.models.front().length(), heading};
}

FormationGuess assemble(search::FormationPath way, const search::FormationProblem& problem) {
  FormationGuess guess;
  guess.timing = search::time_formation(way, problem);
  guess.shapes = {search::start_formation(*problem.scenario)};
  const double change = kChangeLength * problem.scenario->models.front().length(), length = way.path.length();
  // The net stays as it is until it has held its catch for a while.
  const search::TimedPath timed{way.path, guess.timing.profile};
  const double last = way.meeting_s.empty() ? 0.0 : timed.at(problem.meetings.back().time + net::kHoldTime).s;
  const auto change_to = [&](const Formation& shape, double begin) {
    if (shape.offsets == guess.shapes.back().offsets) return;
    guess.shapes.push_back(shape);
    guess.changes.push_back({begin, std::min(begin + change, length)});
  };
  if (last > 0.0) change_to(problem.before, 0.0);
  change_to(problem.after, last);
  guess.way = std::move(way);
  return guess;
}

std::optional<FormationGuess> search_with(search::FormationProblem& problem,
                                          const search::FormationSettings& settings) {
  auto way = search::search_formation(problem, settings);
  if (!way) return std::nullopt;
  return assemble(std::move(*way), problem);
}

// Narrower and turned shapes, those first that are narrow across the narrowest place of the way.
std::optional<FormationGuess> search_narrow(search::FormationProblem problem, bool before_too,
                                            const NetQuestion& question) {
  const auto place = search::narrowest_place(problem);
  if (!place) return std::nullopt;
  const bool loaded = std::isfinite(question.task.loaded_from);
  std::vector<search::NarrowShape> shapes =
      search::narrow_shapes(*problem.scenario, problem.start.heading, loaded);
  const auto off = [&](const search::NarrowShape& shape) {
    return std::abs(std::sin(shape.along - place->along));
  };
  std::stable_sort(shapes.begin(), shapes.end(),
                   [&](const search::NarrowShape& a, const search::NarrowShape& b) {
                     return a.width + off(a) < b.width + off(b);
                   });
  if (shapes.size() > kShapes) shapes.resize(kShapes);
  const search::FormationSettings settings{.max_expansions = kShapeExpansions, .field = true};
  for (const search::NarrowShape& shape : shapes) {
    if (problem.deadline.expired()) break;
    problem.after = shape.formation;
    if (before_too) problem.before = shape.formation;
    if (auto guess = search_with(problem, settings)) return guess;
  }
  return std::nullopt;
}

}  // namespace

std::optional<FormationGuess> guess_formation(const world::Scenario& scenario, const world::StaticMap& map,
                                              const NetQuestion& question, int attempt,
                                              const Deadline& deadline, std::string& reason) {
  search::FormationProblem problem = problem_for(scenario, map, question, deadline);
  if (!problem.goal) end_at_goals(scenario, problem);
  std::optional<FormationGuess> guess;
  switch (attempt) {
    case 0:
      guess = search_with(problem, {.max_expansions = kQuickExpansions});
      break;
    case 1:
      guess = search_with(problem, {.max_expansions = kFieldExpansions, .field = true});
      break;
    case 2:
      guess = search_narrow(problem, false, question);
      break;
    case 3:
      if (!problem.meetings.empty()) guess = search_narrow(problem, true, question);
      break;
    case 4:
      guess = search_with(problem, {.max_expansions = kFieldExpansions, .backward = false, .field = true});
      break;
    default:
      guess = search_with(problem, {.max_expansions = kFieldExpansions, .forward = false, .field = true});
  }
  if (!guess) reason = "no passage for the formation found";
  return guess;
}

}  // namespace seine::planner
