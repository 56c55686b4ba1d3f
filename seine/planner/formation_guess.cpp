#include "seine/planner/formation_guess.hpp"

#include <algorithm>
#include <cmath>

#include "seine/net/catch_rules.hpp"
#include "seine/search/formation_shapes.hpp"

namespace seine::planner {
namespace {

using geom::Vec2;
using search::Formation;

constexpr double kGoalShare = 0.7;       // of the delivery's radius
constexpr double kChangeLength = 5.0;    // car lengths over which the formation changes shape
constexpr int kQuickExpansions = 1500;   // as the crow flies, as at the start
constexpr int kShapeExpansions = 12000;  // around what is tall, in shapes for narrow places too
constexpr double kGreedy = 2.5;          // weight of what is left, for a way soon instead of a fast one
constexpr double kHoldPace = 0.8;        // of the top speed: how far a team drives while it holds a catch

search::FormationProblem problem_for(const world::Scenario& scenario, const world::StaticMap& map,
                                     const NetQuestion& question, const Deadline& deadline) {
  search::FormationProblem problem;
  problem.scenario = &scenario, problem.map = &map, problem.tall = question.tall.get();
  problem.start = search::formation_frame(scenario);
  problem.start_speed = scenario.robots.front().start_speed;
  problem.shapes = {search::start_formation(scenario)};
  // The optimiser opens the net over what is low; narrow shapes leave it no room to.
  problem.shapes.front().lowest = std::numeric_limits<double>::infinity();
  problem.hold = kHoldPace * net::kHoldTime * scenario.models.front().limits.speed;
  for (const trajopt::LowObstacle& low : question.task.low)
    problem.low.push_back({low.shape, low.height + scenario.net->clearance});
  problem.meetings = question.meetings;
  problem.deadline = deadline;
  if (scenario.delivery) {
    problem.goal = search::FormationGoal{scenario.delivery->center, kGoalShare * scenario.delivery->radius,
                                         scenario.delivery->heading};
  }
  return problem;
}

// Where every robot has a goal of its own the formation ends as they stand there.
std::optional<Formation> goal_formation(const world::Scenario& scenario, search::FormationProblem& problem) {
  Vec2 frame, direction;
  for (const world::Robot& robot : scenario.robots) {
    if (!robot.goal) return std::nullopt;
    frame += robot.goal->position() / static_cast<double>(scenario.robots.size());
    direction += robot.goal->direction();
  }
  const double heading = std::atan2(direction.y, direction.x);
  Formation formation;
  for (const world::Robot& robot : scenario.robots)
    formation.offsets.push_back(robot.goal->position() - frame);
  std::vector<Vec2> ring;
  search::attachments_at(scenario, formation, {frame.x, frame.y, heading}, ring);
  Vec2 middle;
  for (const Vec2 a : ring) middle += a / static_cast<double>(ring.size());
  problem.goal = search::FormationGoal{middle, 0.5 * scenario.models.front().length(), heading};
  return formation;
}

// Those that just clear the ground, and those that clear everything low as well.
void add_narrow_shapes(const world::Scenario& scenario, const NetQuestion& question,
                       search::FormationProblem& problem) {
  const bool loaded = std::isfinite(question.task.loaded_from);
  double highest = 0.0;
  for (const search::LowPiece& low : problem.low) highest = std::max(highest, low.height);
  for (const double above : {scenario.net->clearance, highest}) {
    if (above <= 0.0) continue;
    for (Formation& shape : search::narrow_shapes(scenario, problem.start.heading, loaded, above))
      problem.shapes.push_back(std::move(shape));
  }
}

// The lattice changes shape at a point; the guess has changed by then, over a few car lengths.
FormationGuess assemble(search::FormationPath way, const search::FormationProblem& problem,
                        const std::optional<Formation>& last) {
  FormationGuess guess;
  guess.timing = search::time_formation(way, problem);
  const double change = kChangeLength * problem.scenario->models.front().length(), length = way.path.length();
  guess.shapes = {problem.shapes.front()};
  const auto change_to = [&](const Formation& shape, double begin, double end) {
    const double after = guess.changes.empty() ? 0.0 : guess.changes.back().end;
    guess.shapes.push_back(shape);
    guess.changes.push_back({std::max(begin, after), std::max(end, after + 0.1 * change)});
  };
  for (std::size_t i = 1; i < way.shapes.size(); ++i) {
    double earliest = 0.0;
    for (const double s : way.meeting_s)
      if (s < way.shapes[i].s) earliest = std::min(s + problem.hold, way.shapes[i].s);
    const double end = std::max(way.shapes[i].s, earliest + 0.2 * change);
    change_to(problem.shapes[static_cast<std::size_t>(way.shapes[i].shape)], std::max(end - change, earliest),
              end);
  }
  if (last) change_to(*last, std::max(0.0, length - change), length);
  guess.way = std::move(way);
  return guess;
}

}  // namespace

std::optional<FormationGuess> guess_formation(const world::Scenario& scenario, const world::StaticMap& map,
                                              const NetQuestion& question, int attempt,
                                              const Deadline& deadline, std::string& reason) {
  search::FormationProblem problem = problem_for(scenario, map, question, deadline);
  std::optional<Formation> last;
  if (!problem.goal) last = goal_formation(scenario, problem);
  search::FormationSettings settings{.max_expansions = kQuickExpansions};
  if (attempt > 0) {
    settings = {.max_expansions = kShapeExpansions, .field = true};
    if (attempt % 2 == 1) settings.heuristic_weight = kGreedy;
    // The optimiser holds the net open longer than the guess did, if it has to.
    if (attempt >= 3) problem.hold = 0.0;
    add_narrow_shapes(scenario, question, problem);
  }
  auto way = search::search_formation(problem, settings);
  if (!way) {
    if (attempt > 0) reason = "no passage for the formation found";
    return std::nullopt;
  }
  return assemble(std::move(*way), problem, last);
}

}  // namespace seine::planner
