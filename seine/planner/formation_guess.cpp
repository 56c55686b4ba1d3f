#include "seine/planner/formation_guess.hpp"

#include <algorithm>
#include <cmath>

#include "seine/net/catch_rules.hpp"
#include "seine/search/formation_shapes.hpp"

namespace seine::planner {
namespace {

using geom::Vec2;
using search::Formation;

constexpr double kGoalShare = 0.7;     // of the delivery's radius
constexpr double kChangeLength = 5.0;  // car lengths over which the formation changes shape
constexpr int kQuickExpansions = 500;  // as the crow flies, as at the start
constexpr int kPatience = 150;
constexpr int kShapeExpansions = 6000;   // around what is tall, in shapes for narrow places too
constexpr int kMostExpansions = 150000;  // the same, when that was not enough
constexpr double kCoarseCell = 0.7;      // car lengths
constexpr int kCoarseHeadings = 20;
constexpr double kCoarsestCell = 0.8;
constexpr int kFewestHeadings = 16;
constexpr double kGreedy = 2.5;    // weight of what is left, for a way soon instead of a fast one
constexpr double kHoldPace = 0.8;  // of the top speed: how far a team drives while it holds a catch

// Where every robot has a goal of its own the formation ends as they stand there.
struct End {
  Formation formation;
  search::FormationGoal goal;
};

std::optional<End> end_of(const world::Scenario& scenario) {
  End end;
  Vec2 frame, direction, middle;
  for (const world::Robot& robot : scenario.robots) {
    if (!robot.goal) return std::nullopt;
    frame += robot.goal->position() / static_cast<double>(scenario.robots.size());
    direction += robot.goal->direction();
  }
  const double heading = std::atan2(direction.y, direction.x);
  for (const world::Robot& robot : scenario.robots)
    end.formation.offsets.push_back(robot.goal->position() - frame);
  std::vector<Vec2> ring;
  search::attachments_at(scenario, end.formation, {frame.x, frame.y, heading}, ring);
  for (const Vec2 a : ring) middle += a / static_cast<double>(ring.size());
  end.goal = {middle, 0.5 * scenario.models.front().length(), heading};
  return end;
}

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
  problem.change = kChangeLength * scenario.models.front().length();
  for (const trajopt::LowObstacle& low : question.task.low)
    problem.low.push_back({low.shape, low.height + scenario.net->clearance});
  problem.meetings = question.meetings;
  problem.deadline = deadline;
  if (scenario.delivery) {
    problem.goal = search::FormationGoal{scenario.delivery->center, kGoalShare * scenario.delivery->radius,
                                         scenario.delivery->heading};
  } else if (const auto end = end_of(scenario)) {
    problem.goal = end->goal;
  }
  return problem;
}

}  // namespace

FormationGuesser::FormationGuesser(const world::Scenario& scenario, const world::StaticMap& map,
                                   const NetQuestion& question, const Deadline& deadline)
    : scenario_(scenario), question_(question), search_(problem_for(scenario, map, question, deadline)) {
  if (scenario.delivery) return;
  if (auto end = end_of(scenario)) last_ = std::move(end->formation);
}

// Those that just clear the ground, and those that clear everything low as well.
void FormationGuesser::offer_narrow_shapes() {
  narrow_ = true;
  const bool loaded = std::isfinite(question_.task.loaded_from);
  double highest = 0.0;
  for (const search::LowPiece& low : search_.problem().low) highest = std::max(highest, low.height);
  std::vector<double> heights{scenario_.net->clearance};
  if (highest > heights.front()) heights.push_back(highest);
  search_.offer(search::narrow_shapes(scenario_, search_.problem().start.heading, loaded, heights));
}

FormationGuess FormationGuesser::assemble(search::FormationPath way) const {
  const search::FormationProblem& problem = search_.problem();
  FormationGuess guess;
  guess.timing = search::time_formation(way, problem);
  const double length = way.path.length();
  guess.shapes = {problem.shapes.front()};
  for (std::size_t i = 1; i < way.shapes.size(); ++i) {
    guess.shapes.push_back(problem.shapes[static_cast<std::size_t>(way.shapes[i].shape)]);
    guess.changes.push_back({way.shapes[i].begin, way.shapes[i].s});
  }
  if (last_) {
    const double before = guess.changes.empty() ? 0.0 : guess.changes.back().end;
    guess.shapes.push_back(*last_);
    guess.changes.push_back({std::min(std::max(before, length - problem.change), 0.9 * length), length});
  }
  guess.way = std::move(way);
  return guess;
}

std::optional<FormationGuess> FormationGuesser::guess(int attempt) {
  search::FormationSettings settings{.max_expansions = kQuickExpansions,
                                     .patience = kPatience,
                                     .cell = kCoarseCell,
                                     .headings = kCoarseHeadings};
  if (attempt > 0) {
    if (!narrow_) offer_narrow_shapes();
    settings = {.max_expansions = kShapeExpansions, .field = true};
    const bool first = attempt % 2 == 1;
    if (first) settings.cell = kCoarsestCell, settings.headings = kFewestHeadings;
    const bool before = found_[static_cast<std::size_t>(attempt - 1)];
    if (attempt == 4 && !before) return std::nullopt;
    if (first || !before) settings.heuristic_weight = kGreedy;
  }
  if (attempt >= 3) {
    // The optimiser holds the net open longer than the guess did, if it has to. Where there is no catch the
    // way would be the one that was found before.
    if (question_.meetings.empty() && found_[static_cast<std::size_t>(attempt - 2)]) return std::nullopt;
    search_.set_hold(0.0);
    settings.max_expansions = kMostExpansions;
  }
  auto way = search_.find(settings);
  if (!way) return std::nullopt;
  found_[static_cast<std::size_t>(attempt)] = true;
  return assemble(std::move(*way));
}

}  // namespace seine::planner
