#include "seine/planner/session.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "seine/certify/certificate.hpp"
#include "seine/planner/arc_plan.hpp"
#include "seine/planner/faults.hpp"
#include "seine/planner/groups.hpp"
#include "seine/planner/moving_bodies.hpp"
#include "seine/planner/straight_hop.hpp"
#include "seine/world/check.hpp"

namespace seine::planner {
namespace {

constexpr double kGuessShare = 0.7;  // of the time that is left
// A team that so many guesses could not solve is given up: without a deadline, and with one.
constexpr int kFailedGuesses = 2, kMostFailedGuesses = 40;
constexpr int kPolishRounds = 8, kBriefRounds = 4;
constexpr int kStuckRounds = 3, kHopelessRounds = 6;
constexpr double kHardlySlower = 1.03;  // a plan slowed by so little is not worth another attempt …
constexpr int kBetterAttempts = 2;      // … others are worth so many
constexpr double kTick = 0.0667;        // of the time a car takes to drive its own length
constexpr double kMostTicks = 40e3;     // of a plan; one that takes longer is looked at less often
constexpr double kCloseGap = 0.25;      // car lengths: cars that come this close are optimised jointly
constexpr double kPenaltyRaise = 3.0, kMostPenalty = 100.0;
constexpr double kTightenRaise = 0.005, kMostTighten = 0.03;
constexpr double kClearanceRaise = 0.01;  // car lengths, on top of what was missed
constexpr int kLargeGroup = 6;            // a group this large is worth all threads

// With nobody to give way to and nothing to dodge, one search for a way is like the next.
bool searches_differ(const world::Scenario& scenario) {
  return scenario.robots.size() > 1 ||
         std::ranges::any_of(scenario.obstacles, [](const auto& o) { return !o.motion.empty(); });
}

// What no spline of ours can follow is driven arc by arc, with a stop between them: among hundreds of metres
// that is little.
std::optional<traj::RobotTrajectory> long_drive(const search::TimedPath& guess, const vehicle::Model& model,
                                                double start_speed) {
  if (start_speed != 0.0 || !too_long_to_fit(guess, model)) return std::nullopt;
  traj::RobotTrajectory drive = drive_arcs(guess.path, model, 0.0);
  if (drive.segments.empty()) return std::nullopt;
  for (const search::ProfileKnot& knot : guess.profile)
    if (knot.s <= 0.0) drive.segments.front().wait = knot.t;
  return drive;
}

}  // namespace

Session::Session(const world::Scenario& scenario, const Options& options)
    : scenario_(scenario),
      options_(options),
      deadline_(options.deadline_s, options.cancelled),
      workers_(options.threads),
      map_(scenario),
      asked_(scenario) {}

PlanResult Session::run() {
  result_.reason = world::expect_sound(scenario_, map_);
  guess_.impossible = !result_.reason.empty();
  if (!guess_.impossible) climb();
  return finish();
}

// The ladder of attempts, until one holds.
void Session::climb() {
  const bool timed = std::isfinite(options_.deadline_s);
  const int most_failed = timed && searches_differ(scenario_) ? kMostFailedGuesses : kFailedGuesses;
  int failed_guesses = 0, better = 0;
  for (int rung = 0; rung < (timed ? kMostRungs : kRungs) && !deadline_.expired(); ++rung) {
    const Attempt now = attempt(rung);
    // For a better plan than one that holds no new search is worth its time.
    if (slowed_ && !guessed_for(now)) break;
    if (now.roomier > 0.0 && attempts_ == 0) continue;  // where no way is found there is none with more room
    if (!have_guess(now)) {
      if (guess_.impossible && now.roomier == 0.0) break;
      // That there is no way with more room says nothing.
      if (now.roomier == 0.0 && !now.gently && now.finer == 1.0 && ++failed_guesses == most_failed) break;
      continue;
    }
    if (deadline_.expired()) break;
    ++attempts_;
    const bool brief = attempts_ == 1 && wriggles();
    if (brief) stop_and_steer();
    prepare(now);
    optimise(now.gently);
    if (deadline_.expired()) break;
    if (brief && slowed_) {
      polish_briefly();
      break;
    }
    polish(kPolishRounds);
    if (result_.certified) break;
    slow_down();
    if (now.gently) stop_and_steer();
    if (slowed_ && (slowed_by_ < kHardlySlower || ++better > kBetterAttempts)) break;
    ++result_.repairs;
  }
  settle();
}

// Guesses are kept for the attempts that begin from the same one.
bool Session::have_guess(const Attempt& now) {
  if (guessed_for(now)) return guess_.complete;
  asked_.margins = scenario_.margins;
  const double room = now.roomier * scenario_.models.front().length();
  asked_.margins.robot += room, asked_.margins.obstacle += room;
  guessed_ = now;
  // Who starts or ends nearer than that has no such way.
  guess_.complete = now.roomier == 0.0 || world::check(asked_, map_).empty();
  return guess_.complete && guess(now.guess);
}

bool Session::guessed_for(const Attempt& now) const {
  return guessed_ && guessed_->guess == now.guess && guessed_->roomier == now.roomier;
}

bool Session::guess(std::uint64_t attempt) {
  const Stopwatch watch;
  report("guess", 0.0);
  search::GuessOptions options;
  // Without time left to optimise a guess is worth nothing.
  options.deadline = deadline_.within(kGuessShare * deadline_.remaining());
  options.threads = workers_.count();
  options.seed = options_.seed + attempt;
  options.quickest = attempt == 0;  // where it failed, the way the search found first may do
  options.extra_robot_clearance = 0.01 * static_cast<double>(attempt) * scenario_.models.front().length();
  // A no to more room than was asked for proves nothing and explains nothing; one explanation is enough.
  const bool as_asked = asked_.margins.obstacle == scenario_.margins.obstacle;
  options.explain = as_asked && !explained_;
  options.explain_until = deadline_;
  guess_ = search::guess_team(asked_, map_, options);
  guess_.impossible = guess_.impossible && as_asked;
  result_.times.guess += watch.seconds();
  // Of a search that was cut short nothing is known; the reason of an earlier one stands.
  if (!guess_.complete && attempts_ == 0 && options.explain) {
    explained_ = explained_ || !options.deadline.expired();
    if (guess_.impossible || !options.deadline.expired())
      result_.reason = guess_.reason;
    else if (attempt == 0)
      result_.reason = late_reason();
  }
  return guess_.complete;
}

void Session::prepare(const Attempt& now) {
  const Stopwatch watch;
  const std::size_t count = scenario_.robots.size();
  tasks_.assign(count, {});
  given_.assign(count, {});
  const bool waits_matter =
      guess_.effort.rescues > 0 || !std::ranges::all_of(scenario_.obstacles, world::stands_still);
  workers_.run(static_cast<int>(count), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    const world::Robot& robot = scenario_.robots[i];
    given_[i] = straight_hop(guess_.robots[i], scenario_.model_of(robot), robot.start_speed);
    if (!given_[i]) given_[i] = long_drive(guess_.robots[i], scenario_.model_of(robot), robot.start_speed);
    if (given_[i])
      tasks_[i].model = scenario_.model_of(robot);
    else
      tasks_[i] = fit(guess_.robots[i], asked_, asked_.robots[i], map_, {.finer = now.finer});
    // What leaves early meets what it waits for: where that happened once, waits stay as they are.
    tasks_[i].fixed_waits = now.gently && waits_matter;
  });
  settings_ = {};
  units_ = trajopt::units_of(tasks_);
  double last = 0.0;
  for (const search::TimedPath& path : guess_.robots) last = std::max(last, path.arrival());
  tick_ = std::max(kTick * units_.time, last / kMostTicks);
  ticks_ = static_cast<int>(std::ceil(1.2 * last / tick_)) + 80;
  bodies_.clear();
  for (const trajopt::RobotTask& task : tasks_)
    bodies_.push_back(car_body(task.model, asked_.margins.robot, units_, settings_.clearance_slack));
  for (trajopt::Body& body : moving_obstacles(asked_, units_, settings_.clearance_slack, tick_, ticks_))
    bodies_.push_back(std::move(body));
  workers_.run(static_cast<int>(count), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    place(bodies_[i], guess_.robots[i], units_, tick_, ticks_);
  });
  extra_.assign(count * bodies_.size(), 0.0);
  demands_.assign(count, {});
  solution_.assign(count, {});
  evaluations_.assign(count, 0);
  fault_rounds_.assign(count, 0);
  result_.plan.robots.assign(count, {});
  for (std::size_t k = 0; k < count; ++k)
    if (given_[k]) result_.plan.robots[k] = *given_[k];
  result_.times.corridor += watch.seconds();
}

void Session::place_bodies() {
  workers_.run(static_cast<int>(tasks_.size()), [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    place(bodies_[i], result_.plan.robots[i], units_, tick_, ticks_);
  });
}

void Session::optimise(bool gently) {
  const Stopwatch watch;
  report("optimise", 0.0);
  std::vector<Group> alone;
  for (int k = 0; k < static_cast<int>(tasks_.size()); ++k) alone.push_back({k});
  solve_groups(movers(std::move(alone)), gently ? Start::gentle_guess : Start::guess);
  report("optimise", 0.5);
  std::vector<Group> close = movers(close_groups(kCloseGap * units_.length));
  std::erase_if(close, [](const Group& group) { return group.size() < 2; });
  solve_groups(close, Start::solution);
  result_.times.optimise += watch.seconds();
}

// Groups do not see each other's changes until all are done.
void Session::solve_groups(const std::vector<Group>& groups, Start start) {
  std::vector<const Group*> small;
  for (const Group& group : groups) {
    if (group.size() >= kLargeGroup)
      solve(group, start, workers_);
    else
      small.push_back(&group);
  }
  workers_.run(static_cast<int>(small.size()), [&](int k) {
    Workers serial(1);
    solve(*small[static_cast<std::size_t>(k)], start, serial);
  });
  for (const Group& group : groups)
    result_.iterations += evaluations_[static_cast<std::size_t>(group.front())];
  if (!deadline_.expired()) place_bodies();
}

trajopt::Task Session::task_for(const Group& group) const {
  trajopt::Task task;
  task.units = units_, task.tick = tick_, task.ticks = ticks_;
  task.robot_clearance = asked_.margins.robot;
  std::vector<std::size_t> others;
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    if (!std::binary_search(group.begin(), group.end(), static_cast<int>(body))) others.push_back(body);
  for (const std::size_t body : others) task.bodies.push_back(&bodies_[body]);
  for (const int k : group) {
    const auto i = static_cast<std::size_t>(k);
    task.robots.push_back(&tasks_[i]);
    task.demands.push_back(demands_[i]);
    for (const int other : group)
      task.extra.push_back(extra_[i * bodies_.size() + static_cast<std::size_t>(other)]);
    for (const std::size_t body : others) task.extra.push_back(extra_[i * bodies_.size() + body]);
  }
  return task;
}

void Session::solve(const Group& group, Start start, Workers& workers) {
  if (deadline_.expired()) return;
  trajopt::JointProblem problem(task_for(group), settings_, workers);
  std::vector<double> x = problem.initial();
  const auto slice = [&](std::size_t i) {
    return std::span(x).subspan(static_cast<std::size_t>(problem.offsets()[i]),
                                static_cast<std::size_t>(problem.offsets()[i + 1] - problem.offsets()[i]));
  };
  if (start == Start::solution)
    for (std::size_t i = 0; i < group.size(); ++i)
      std::ranges::copy(solution_[static_cast<std::size_t>(group[i])], slice(i).begin());
  const trajopt::SolveSummary summary = problem.solve(x, deadline_, start != Start::guess);
  const traj::TeamTrajectory solved = problem.trajectory(x);
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto k = static_cast<std::size_t>(group[i]);
    solution_[k].assign(slice(i).begin(), slice(i).end());
    evaluations_[k] = summary.soft_evaluations + summary.stiff_evaluations;
    result_.plan.robots[k] = solved.robots[i];
  }
}

std::vector<Session::Group> Session::close_groups(double gap) const {
  Groups groups(static_cast<int>(tasks_.size()));
  const double limit = gap / units_.length;
  for (std::size_t a = 0; a < tasks_.size(); ++a)
    for (std::size_t b = a + 1; b < tasks_.size(); ++b)
      if (come_within(bodies_[a], bodies_[b], bodies_[a].clearance + limit))
        groups.join(static_cast<int>(a), static_cast<int>(b));
  return groups.all();
}

// A car that stands, or as good as stands, has nothing to optimise: the others see it as a body.
std::vector<Session::Group> Session::movers(std::vector<Group> groups) const {
  for (Group& group : groups)
    std::erase_if(group, [&](int k) { return given_[static_cast<std::size_t>(k)].has_value(); });
  std::erase_if(groups, [](const Group& group) { return group.empty(); });
  return groups;
}

// For a better plan than one that holds: what is a little over its limits is slowed at once, and the
// certificate is asked few times.
void Session::polish_briefly() {
  if (certify()) return;
  slow_down();
  if (slowed_by_ < kHardlySlower) return;
  polish(kBriefRounds);
  if (!result_.certified) slow_down();
}

bool Session::certify() {
  const Stopwatch watch;
  report("certify", 0.0);
  if (std::ranges::any_of(result_.plan.robots, folds)) {
    result_.certificate = {};
    return false;
  }
  certify::Options options;
  options.threads = workers_.count();
  options.deadline = deadline_;
  result_.certificate = certify::certify(scenario_, map_, result_.plan, options);
  result_.certified = result_.certificate.holds;
  result_.times.certify += watch.seconds();
  if (!result_.certified) keep_nearest();
  return result_.certified;
}

void Session::polish(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    if (certify() || deadline_.expired() || result_.certificate.violations.empty()) return;
    const Stopwatch watch;
    report("repair", static_cast<double>(round) / rounds);
    std::vector<Group> groups = raise_demands(round), stuck;
    if (round > 0) settings_.pair_penalty *= 2.0;
    // A car that more weight does not help sits in a bad valley: it and its group go back to their guess.
    const auto rounds_of = [&](const Group& group) {
      int most = 0;
      for (const int k : group) most = std::max(most, fault_rounds_[static_cast<std::size_t>(k)]);
      return most;
    };
    for (const Group& group : groups)
      if (rounds_of(group) >= kHopelessRounds) return;
    std::ranges::copy_if(groups, std::back_inserter(stuck),
                         [&](const Group& g) { return rounds_of(g) == kStuckRounds; });
    std::erase_if(groups, [&](const Group& g) { return rounds_of(g) == kStuckRounds; });
    solve_groups(stuck, Start::gentle_guess);
    solve_groups(groups, Start::solution);
    result_.times.optimise += watch.seconds();
  }
  certify();
}

// Asks more where the certificate found fault; returns the cars at fault, grouped by whom they conflict with.
std::vector<Session::Group> Session::raise_demands(int round) {
  const std::size_t count = tasks_.size();
  Groups groups(static_cast<int>(count));
  std::vector<char> at_fault(count, 0);
  const auto raise_penalty = [&](std::size_t robot) {
    demands_[robot].penalty_scale = std::min(demands_[robot].penalty_scale * kPenaltyRaise, kMostPenalty);
  };
  for (const certify::Violation& v : result_.certificate.violations) {
    if (v.robot < 0) continue;
    const auto a = static_cast<std::size_t>(v.robot);
    at_fault[a] = 1;
    const double missed = std::clamp(v.limit - v.value, 0.0, 0.05 * units_.length);
    const double raise = round == 0 ? 0.0 : missed + kClearanceRaise * units_.length;
    switch (v.kind) {
      case certify::Kind::robot_clearance: {
        const auto b = static_cast<std::size_t>(v.other);
        at_fault[b] = 1;
        groups.join(v.robot, v.other);
        extra(a, b) += raise;
        extra(b, a) += raise;
        break;
      }
      case certify::Kind::moving_obstacle_clearance:
        for (std::size_t body = count; body < bodies_.size(); ++body)
          extra(a, body) += missed + kClearanceRaise * units_.length;
        break;
      case certify::Kind::obstacle_clearance:
      case certify::Kind::bounds:
        raise_penalty(a);
        if (round > 0)
          for (double& b : tasks_[a].corridor.b) b -= std::min(missed, kClearanceRaise * units_.length);
        break;
      default:
        raise_penalty(a);
        if (round > 0) demands_[a].tighten = std::min(demands_[a].tighten + kTightenRaise, kMostTighten);
        break;
    }
  }
  for (std::size_t k = 0; k < count; ++k) fault_rounds_[k] = at_fault[k] ? fault_rounds_[k] + 1 : 0;
  std::vector<Group> result = groups.all();
  std::erase_if(result,
                [&](const Group& group) { return !at_fault[static_cast<std::size_t>(group.front())]; });
  return movers(std::move(result));
}

void Session::report(const char* stage, double fraction) const {
  if (options_.progress) options_.progress({stage, fraction});
}

}  // namespace seine::planner
