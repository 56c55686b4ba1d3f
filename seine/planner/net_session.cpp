#include "seine/planner/net_session.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "seine/net/catch_rules.hpp"
#include "seine/planner/faults.hpp"
#include "seine/planner/formation_guess.hpp"
#include "seine/planner/moving_bodies.hpp"
#include "seine/planner/previous_fit.hpp"
#include "seine/planner/slower.hpp"
#include "seine/search/refusal.hpp"
#include "seine/world/check.hpp"

namespace seine::planner {
namespace {

constexpr int kPolishRounds = 6, kGoOnRounds = 3, kInsistingRounds = 16;
// What missed by less is polished once more, for longer.
constexpr double kWithinReach = 0.3;
// A plan that is worse than this, or that no round brings closer by so much, is not going to hold.
constexpr double kHopeless = 1.0, kProgress = 0.6, kNearly = 0.05;
// Fewer evaluations than with the defaults, for hardly longer travel (docs/net-planning.md).
constexpr double kSoftKnee = 0.3, kSoftDecrease = 4e-3, kDecrease = 3e-3;
constexpr int kPast = 3, kSoftEvaluations = 60;
// A catch happens at a time of the common clock: where everybody is then hangs on the duration.
constexpr double kDurationScale = 0.25;
constexpr double kTighten = 0.021;  // longer pieces, more between samples
constexpr std::size_t kShareCars = 8;
constexpr double kTick = 0.1334;  // of the time a car takes to drive its own length
// One path for all: longer pieces than for a car among others, for nobody has to dodge anybody.
constexpr FitOptions kFit{.piece_length = 2.4};
constexpr double kPenaltyRaise = 3.0, kMostPenalty = 100.0;
constexpr double kTightenRaise = 0.005, kMostTighten = 0.03;
constexpr double kCorridorRaise = 0.001, kSpeedRaise = 0.003;   // m and m/s, on top of what was missed
constexpr double kHoldingRaise = 0.1;                           // m²
constexpr double kNetRaise = 0.01, kCatchRaise = 0.003;         // m, likewise
constexpr double kOpeningRaise = 0.004, kSidewaysRaise = 0.05;  // of the net at rest; m/s
constexpr double kCarryShare = 0.995;                           // of the speed, for each car that is too fast
constexpr double kLeastCarryShare = 0.98;                       // likewise, where the usual did not help
constexpr double kClearanceRaise = 0.01;                        // car lengths, on top of what was missed

// Of a team that does not face one way, for people; empty for others.
std::string hint_at_headings(const world::Scenario& scenario) {
  constexpr double kApart = 0.6;  // rad
  const double heading = search::formation_frame(scenario).heading;
  const world::Robot* furthest = nullptr;
  double most = kApart;
  for (const world::Robot& robot : scenario.robots) {
    const double turn = std::abs(geom::wrap_angle(robot.start.heading - heading));
    if (turn > most) most = turn, furthest = &robot;
  }
  if (furthest == nullptr) return "";
  return "; a team with a net drives as one formation that faces one way, and " + furthest->name +
         " starts " + std::to_string(std::lround(most * 180.0 / std::numbers::pi)) +
         " degrees off it: starts that face the same way, to about 30 degrees, would help";
}

}  // namespace

NetSession::NetSession(const world::Scenario& scenario, const Options& options)
    : scenario_(scenario),
      options_(options),
      deadline_(options.deadline_s, options.cancelled),
      workers_(options.threads),
      map_(scenario) {}

PlanResult NetSession::run() {
  if (const std::string no_answer = world::expect_sound(scenario_, map_); !no_answer.empty()) {
    result_.reason = no_answer;
    result_.impossible = true;
    return finish();
  }
  question_ = ask_net(scenario_, options_.without);
  if (!question_.refusal.empty()) {
    result_.reason = question_.refusal;
    result_.impossible = true;
    return finish();
  }
  if (options_.previous == nullptr && stand()) return finish();
  if (options_.previous != nullptr && go_on()) return finish();
  guess_and_solve();
  return finish();
}

// A team which already stands where it should, and meets there what comes, stays. Where its catches lack what
// is asked beyond the certificate it had better move: then standing is for the case that nothing else is
// found.
bool NetSession::stand() {
  for (const world::Robot& robot : scenario_.robots) {
    if (robot.start_speed != 0.0) return false;
    result_.plan.robots.push_back(traj::RobotTrajectory::standing(robot.start));
  }
  if (certify() && question_.roomy(result_.certificate.catches)) return true;
  if (result_.certified) stay_ = {result_.plan, result_.certificate};
  result_.certified = false;
  result_.certificate = {};
  result_.plan = {};
  return false;
}

void NetSession::guess_and_solve() {
  FormationGuesser guesser(scenario_, map_, question_, deadline_);
  std::vector<FormationGuess> close;  // of attempts that missed by little
  for (int attempt = 0; attempt < FormationGuesser::kAttempts && !deadline_.expired(); ++attempt) {
    if (!guess(guesser, attempt)) continue;
    if (solve_guess(kPolishRounds)) return;
    if (severity(result_.certificate) < kWithinReach) close.push_back(guess_);
    ++result_.repairs;
  }
  insisting_ = true;
  for (FormationGuess& again : close) {
    if (deadline_.expired()) break;
    guess_ = std::move(again);
    if (solve_guess(kInsistingRounds)) return;
    ++result_.repairs;
  }
}

bool NetSession::solve_guess(int rounds) {
  const Stopwatch watch;
  tasks_ = fit_formation(guess_, scenario_, map_, kFit);
  prepare();
  result_.times.corridor += watch.seconds();
  solve(true);
  polish(rounds);
  if (result_.certified || drive_slower()) return true;
  keep_nearest();
  return false;
}

// Of what does not hold the nearest is told, by what it lacks most.
void NetSession::keep_nearest() {
  const certify::Violation* fault = worst(result_.certificate);
  if (fault == nullptr) return;
  if (!fault_.empty() && severity(result_.certificate) >= nearest_) return;
  nearest_ = severity(result_.certificate);
  fault_ = fault->text;
}

// What is over its limits only may hold when everybody drives slower: not where a catch waits for nobody, and
// of that the certificate knows.
bool NetSession::drive_slower() {
  if (deadline_.expired()) return false;
  auto slower = certified_slower(scenario_, map_, result_.certificate, result_.plan,
                                 {.threads = workers_.count(), .deadline = deadline_});
  if (!slower) return false;
  result_.plan = std::move(slower->plan);
  result_.certificate = std::move(slower->certificate);
  return result_.certified = true;
}

// From what is left of an earlier plan.
bool NetSession::go_on() {
  const Stopwatch watch;
  tasks_ = fit_previous(*options_.previous, options_.previous_time, scenario_, map_, kFit);
  if (tasks_.empty()) return false;
  prepare();
  result_.times.corridor += watch.seconds();
  solve(false);
  polish(kGoOnRounds);
  if (!result_.certified) keep_nearest();
  return result_.certified;
}

bool NetSession::guess(FormationGuesser& guesser, int attempt) {
  const Stopwatch watch;
  report("guess", 0.0);
  auto found = guesser.guess(attempt);
  result_.times.guess += watch.seconds();
  if (!found) {
    if (result_.certificate.violations.empty() && result_.reason.find("passage") == std::string::npos)
      result_.reason = "no passage for the formation found" + search::narrowest_for_net(scenario_, map_);
    return false;
  }
  guess_ = std::move(*found);
  return true;
}

// Everything about an attempt that depends on its tasks.
void NetSession::prepare() {
  double duration = 0.0;
  for (const trajopt::SegmentGuess& segment : tasks_.front().segments)
    duration += segment.wait + segment.duration;
  for (trajopt::RobotTask& task : tasks_) {
    const trajopt::SegmentGuess& last = task.segments.back();
    if (options_.without.relaxation && !task.goal)
      task.goal = geom::Pose2{last.points.back().x, last.points.back().y, last.end_heading};
    task.fixed_cusps = options_.without.cusps;
    // What brakes a car with something in the net is limited; the whole plan keeps to it.
    if (!scenario_.targets.empty() || scenario_.payload)
      task.model.limits.acceleration = std::min(task.model.limits.acceleration, net::kBraking);
  }
  settings_ = {};
  settings_.tighten = kTighten, settings_.soft_knee = kSoftKnee, settings_.past = kPast;
  settings_.soft_decrease = kSoftDecrease, settings_.stiff_decrease = kDecrease;
  settings_.soft_evaluations = kSoftEvaluations;
  settings_.duration_scale = kDurationScale;
  net_ = question_.task;
  demands_.assign(tasks_.size(), {});
  units_ = trajopt::units_of(tasks_);
  tick_ = kTick * units_.time;
  ticks_ = static_cast<int>(std::ceil(1.2 * duration / tick_)) + 80;
  bodies_ = moving_obstacles(scenario_, units_, settings_.clearance_slack, tick_, ticks_);
  extra_.assign(tasks_.size() * (tasks_.size() + bodies_.size()), 0.0);
  x_.clear();
}

void NetSession::solve(bool soft) {
  if (deadline_.expired()) return;
  const Stopwatch watch;
  report("optimise", 0.0);
  trajopt::Task task;
  task.units = units_, task.tick = tick_, task.ticks = ticks_;
  task.robot_clearance = scenario_.margins.robot;
  task.extra = extra_;
  task.demands = demands_;
  task.net = &net_;
  task.one_timing = true;
  for (const trajopt::RobotTask& robot : tasks_) task.robots.push_back(&robot);
  for (const trajopt::Body& body : bodies_) task.bodies.push_back(&body);
  // Evaluations of a few cars are shorter than what it takes to share them out.
  Workers serial(1);
  trajopt::JointProblem problem(task, settings_, tasks_.size() < kShareCars ? serial : workers_);
  if (x_.empty()) x_ = problem.initial();
  const trajopt::SolveSummary summary = problem.solve(x_, deadline_, !soft);
  result_.iterations += summary.soft_evaluations + summary.stiff_evaluations;
  result_.plan = problem.trajectory(x_);
  result_.times.optimise += watch.seconds();
}

bool NetSession::certify() {
  const Stopwatch watch;
  report("certify", 0.0);
  certify::Options options;
  options.threads = tasks_.size() < kShareCars ? 1 : workers_.count();
  options.deadline = deadline_;
  result_.certificate = certify::certify(scenario_, map_, result_.plan, options);
  result_.certified = result_.certificate.holds;
  result_.times.certify += watch.seconds();
  return result_.certified;
}

void NetSession::polish(int rounds) {
  double before = kHopeless;
  for (int round = 0; round < rounds; ++round) {
    if (certify() || deadline_.expired()) return;
    const double now = severity(result_.certificate);
    const bool sticks = round > 1 && now > kNearly && now > kProgress * before;
    if (now > kHopeless || (sticks && !insisting_)) return;
    before = now;
    report("repair", static_cast<double>(round) / rounds);
    raise_demands();
    solve(false);
  }
  certify();
}

// Asks more where the certificate found fault.
void NetSession::raise_demands() {
  const double length = units_.length;
  const std::size_t row = tasks_.size() + bodies_.size();
  bool net = false;
  for (const certify::Violation& v : result_.certificate.violations) {
    const auto a = static_cast<std::size_t>(std::max(v.robot, 0));
    const double missed = std::clamp(v.limit - v.value, 0.0, 0.05 * length);
    const double raise = missed + kClearanceRaise * length;
    switch (v.kind) {
      case certify::Kind::robot_clearance: {
        const auto b = static_cast<std::size_t>(v.other);
        extra_[a * row + b] += raise;
        extra_[b * row + a] += raise;
        break;
      }
      case certify::Kind::moving_obstacle_clearance:
        for (std::size_t body = tasks_.size(); body < row; ++body) extra_[a * row + body] += raise;
        break;
      case certify::Kind::obstacle_clearance:
      case certify::Kind::bounds:
        demands_[a].penalty_scale = std::min(demands_[a].penalty_scale * kPenaltyRaise, kMostPenalty);
        for (double& b : tasks_[a].corridor.b)
          b -= std::min(missed, kClearanceRaise * length) + kCorridorRaise;
        break;
      case certify::Kind::speed:
      case certify::Kind::reverse_speed:
      case certify::Kind::acceleration:
      case certify::Kind::lateral_acceleration:
      case certify::Kind::curvature:
      case certify::Kind::steering_rate:
        demands_[a].penalty_scale = std::min(demands_[a].penalty_scale * kPenaltyRaise, kMostPenalty);
        demands_[a].tighten = std::min(demands_[a].tighten + kTightenRaise, kMostTighten);
        break;
      case certify::Kind::gear:
        demands_[a].least_speed += std::abs(v.value - v.limit) + kSpeedRaise;
        break;
      case certify::Kind::net_drag:
        net_.spread_slack += missed + kNetRaise;
        break;
      case certify::Kind::net_holding:
        net_.holding_reserve += kHoldingRaise;
        break;
      case certify::Kind::net_obstacle:
        net_.obstacle_slack += missed + kNetRaise;
        net_.spread_slack += kNetRaise;
        break;
      case certify::Kind::net_opening:
        for (trajopt::CatchTask& c : net_.catches)
          c.held_opening += std::clamp(v.limit - v.value, 0.0, 0.03) + kOpeningRaise;
        break;
      case certify::Kind::carrying:
        for (trajopt::CarryTask& carry : net_.carries)
          carry.speed *=
              insisting_ ? std::clamp(v.limit / v.value, kLeastCarryShare, kCarryShare) : kCarryShare;
        break;
      case certify::Kind::target_catch:
        raise_catch(static_cast<std::size_t>(v.other));
        break;
      default:
        break;
    }
    net = net || v.kind >= certify::Kind::net_stretch;
  }
  if (net) settings_.net_penalty *= 2.0, settings_.catch_penalty *= 2.0;
}

// Which of the catch's rules was broken, and by how much, the certificate has measured.
void NetSession::raise_catch(std::size_t target) {
  if (target >= net_.catches.size() || target >= result_.certificate.catches.size()) return;
  trajopt::CatchTask& task = net_.catches[target];
  const net::Catch& found = result_.certificate.catches[target];
  const net::Target& thrown = scenario_.targets[target];
  const auto missing = [](double have, double want) { return std::clamp(want - have, 0.0, 0.05); };
  if (found.rim_margin < net::kRimMargin)
    task.margin += missing(found.rim_margin, net::kRimMargin) + kCatchRaise;
  if (found.contact_margin < net::kContactMargin)
    task.contact_margin += missing(found.contact_margin, net::kContactMargin) + kCatchRaise;
  if (found.opening < net::kLeastOpening)
    task.least_opening += missing(found.opening, net::kLeastOpening) + kOpeningRaise;
  if (found.speed > net::speed_limit(found.depth, thrown.radius, net_.net.rebound)) {
    // Deeper where every corner is nearer: R² + D² stays as it is.
    const double depth = net::stopping_depth(found.speed, thrown.radius, net_.net.rebound);
    task.most_radius -= missing(found.depth, depth) * depth / task.most_radius + kCatchRaise;
    task.most_sideways -= kSidewaysRaise;
  }
  if (found.angle > net::kMaxAngle) task.most_sideways -= kSidewaysRaise;
  if (found.bottom < net_.net.clearance)
    task.least_spread += missing(found.bottom, net_.net.clearance) + kCatchRaise;
}

void NetSession::report(const char* stage, double fraction) const {
  if (options_.progress) options_.progress({stage, fraction});
}

PlanResult NetSession::finish() {
  if (!result_.certified && stay_) {
    result_.certified = true;
    std::tie(result_.plan, result_.certificate) = *stay_;
  }
  if (result_.certified) {
    result_.reason.clear();
    result_.quality = measure(result_.plan);
  } else if (deadline_.expired()) {
    result_.reason = "no certified plan before the deadline";
  } else if (!fault_.empty()) {
    result_.reason = "no attempt holds; the nearest fails because " + fault_ + hint_at_headings(scenario_);
  }
  result_.times.compute = watch_.seconds();
  return std::move(result_);
}

}  // namespace seine::planner
