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
// As the crow flies and as at the start; then around what is tall, in shapes for narrow places too: first for
// a way soon, with few poses, then for any, or for a better one; then the same with patience.
constexpr search::FormationSettings kQuick{
    .max_expansions = 500, .patience = 150, .step = 1.2, .cell = 0.7, .headings = 20};
constexpr search::FormationSettings kGreedy{
    .max_expansions = 6000, .heuristic_weight = 2.5, .step = 1.2, .cell = 0.9, .headings = 14, .field = true};
constexpr search::FormationSettings kFine{.max_expansions = 6000, .heuristic_weight = 2.5, .field = true};
constexpr search::FormationSettings kThorough{.max_expansions = 6000, .field = true};
constexpr search::FormationSettings kPatient{
    .max_expansions = 150000, .heuristic_weight = 2.5, .cell = 0.8, .headings = 16, .field = true};
constexpr search::FormationSettings kPatientThorough{.max_expansions = 150000, .field = true};
// Lengths of ways straight to the cars' goals, car lengths.
constexpr double kDetours[FormationGuesser::kStraight] = {0.0, 2.0, 5.0};
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
    problem.goal->exact = true;
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

// Nothing where an attempt would only find what one before has found, or would hardly find anything.
std::optional<search::FormationSettings> FormationGuesser::settings_for(int attempt) const {
  switch (attempt) {
    case 0:
      return kQuick;
    case 1:
      return kGreedy;
    case 2:
      return found_[1] ? kThorough : kFine;
    case 3:
      if (question_.meetings.empty() && found_[1]) return std::nullopt;
      return kPatient;
    default:
      if (!found_[3] || (question_.meetings.empty() && found_[2])) return std::nullopt;
      return kPatientThorough;
  }
}

// Where every car has a goal of its own: straight there; then with room to change places on the way.
std::optional<FormationGuess> FormationGuesser::straight_to_goals(int attempt) {
  if (!last_ || !question_.meetings.empty()) return std::nullopt;
  search::FormationSettings settings = kQuick;
  settings.straight_to_goal = kDetours[attempt];
  auto way = search_.find(settings);
  if (!way) return std::nullopt;
  return assemble(std::move(*way));
}

std::optional<FormationGuess> FormationGuesser::guess(int attempt) {
  if (attempt < kStraight) return straight_to_goals(attempt);
  attempt -= kStraight;
  auto settings = settings_for(attempt);
  if (!settings) return std::nullopt;
  if (attempt > 0 && !narrow_) offer_narrow_shapes();
  // The optimiser holds the net open longer than the guess did, if it has to.
  if (attempt >= 3) search_.set_hold(0.0), settings->wait_at_start = false;
  auto way = search_.find(*settings);
  if (!way) return std::nullopt;
  found_[static_cast<std::size_t>(attempt)] = true;
  return assemble(std::move(*way));
}

}  // namespace seine::planner
