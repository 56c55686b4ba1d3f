#include "seine/certify/certificate.hpp"

#include <algorithm>
#include <cmath>

#include "seine/base/workers.hpp"
#include "seine/certify/chart.hpp"
#include "seine/certify/clearance.hpp"
#include "seine/certify/form.hpp"
#include "seine/certify/net_proof.hpp"
#include "seine/world/check.hpp"

namespace seine::certify {
namespace {

// Slabs hold about this many cells: fewer, longer slabs let too many pairs through their box test.
constexpr int kCellsPerSlab = 4;
constexpr int kFewestSlabs = 8, kMostSlabs = 1024;
// Where nothing moves at all this long is looked at, s.
constexpr double kShortestHorizon = 1e-3;
// A moving obstacle's cells: it moves this far in one, in car lengths.
constexpr double kMovingGrain = 0.25;

void append(std::vector<Finding>& to, std::vector<Finding> from) {
  for (Finding& finding : from) to.push_back(std::move(finding));
}

/// Findings that stop the proof before it starts: nothing else can be said about such a plan.
std::vector<Finding> malformations(const Context& context, const traj::TeamTrajectory& plan) {
  std::vector<Finding> findings;
  const std::size_t wanted = context.scenario.robots.size();
  if (plan.robots.size() != wanted) {
    const double value = static_cast<double>(plan.robots.size()), limit = static_cast<double>(wanted);
    findings.push_back({{Kind::malformed, 0.0, -1, -1, value, limit,
                         format("the plan has %zu robots, the scenario %zu", plan.robots.size(), wanted)},
                        std::abs(value - limit)});
    return findings;
  }
  if (const std::string why = why_no_net(context.scenario); !why.empty())
    findings.push_back({{Kind::malformed, 0.0, -1, -1, 0.0, 0.0, why}, 1.0});
  for (std::size_t k = 0; k < wanted; ++k) {
    const std::string why = why_malformed(plan.robots[k]);
    if (why.empty()) continue;
    const int robot = static_cast<int>(k);
    findings.push_back({{Kind::malformed, 0.0, robot, -1, 0.0, 0.0,
                         format("%s: %s", context.robot_name(robot).c_str(), why.c_str())},
                        1.0});
  }
  return findings;
}

double horizon_of(const world::Scenario& scenario, const traj::TeamTrajectory& plan, const Phases& phases) {
  double horizon = std::max(plan.makespan(), kShortestHorizon);
  if (!phases.catches.empty()) horizon = std::max(horizon, phases.last_catch() + net::kHoldTime);
  for (const world::Obstacle& obstacle : scenario.obstacles) {
    if (!obstacle.motion.empty()) horizon = std::max(horizon, obstacle.motion.back().t);
  }
  return horizon;
}

double shortest_car(const world::Scenario& scenario) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const world::Robot& robot : scenario.robots) {
    shortest = std::min(shortest, scenario.model_of(robot).length());
  }
  return shortest;
}

class Proof {
 public:
  Proof(Context& context, const traj::TeamTrajectory& plan, Workers& workers)
      : context_(context),
        plan_(plan),
        workers_(workers),
        count_(static_cast<int>(plan.robots.size())),
        with_net_(context.scenario.net.has_value()) {}

  std::vector<Finding> run(Certificate& certificate) {
    if (with_net_) crossings_ = crossings_of(context_.scenario);
    const Phases phases = phases_of(context_.scenario, crossings_);
    context_.braking_from = phases.loaded;
    context_.carries = carries_of(context_.scenario, crossings_);
    scene_.horizon = horizon_of(context_.scenario, plan_, phases);
    chart_robots();
    chart_obstacles();
    cut_into_slabs();
    prove_clearances_of_all(certificate);
    if (context_.expired.load()) {
      findings_.push_back({{Kind::undecided, 0.0, -1, -1, 0.0, 0.0, "the proof ran out of time"}, 0.0});
    }
    return std::move(findings_);
  }

 private:
  void chart_robots() {
    charts_.resize(plan_.robots.size());
    std::vector<std::vector<Finding>> forms(plan_.robots.size());
    workers_.run(count_, [&](int k) {
      const auto index = static_cast<std::size_t>(k);
      forms[index] = check_form(context_, k, plan_.robots[index]);
      charts_[index] = chart_of(context_, k, plan_.robots[index], scene_.horizon);
    });
    for (std::size_t k = 0; k < charts_.size(); ++k) {
      append(findings_, std::move(forms[k]));
      append(findings_, std::move(charts_[k].findings));
      scene_.robots.push_back(charts_[k].complete ? &charts_[k].mover : nullptr);
    }
  }

  void chart_obstacles() {
    const auto& obstacles = context_.scenario.obstacles;
    const double grain = kMovingGrain * shortest_car(context_.scenario);
    parts_.resize(obstacles.size());
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      if (world::stands_still(obstacles[i])) continue;  // the map has them
      parts_[i] = parts_of(obstacles[i]);
      for (const geom::Convex& part : parts_[i]) {
        scene_.moving.push_back(
            {static_cast<int>(i), moving_part(part, obstacles[i].motion, scene_.horizon, grain)});
      }
    }
  }

  void cut_into_slabs() {
    std::size_t most = 0;
    for (const Mover* robot : scene_.robots) {
      if (robot != nullptr) most = std::max(most, robot->cells.size());
    }
    scene_.slabs = std::clamp(static_cast<int>(most) / kCellsPerSlab, kFewestSlabs, kMostSlabs);
    for (Chart& chart : charts_) {
      if (chart.complete) chart.mover.build_slabs(scene_.slabs, scene_.horizon);
    }
    for (MovingPart& part : scene_.moving) part.mover.build_slabs(scene_.slabs, scene_.horizon);
  }

  void prove_clearances_of_all(Certificate& certificate) {
    const double glimpsed = glimpse(scene_);
    std::vector<Clearances> found(plan_.robots.size());
    NetVerdict net;
    workers_.run(count_ + (with_net_ ? 1 : 0), [&](int k) {
      if (k == count_) {
        net = verdict_on_net();
        return;
      }
      if (context_.out_of_time() || !charts_[static_cast<std::size_t>(k)].complete) return;
      found[static_cast<std::size_t>(k)] = prove_clearances(context_, scene_, k, glimpsed);
    });
    for (Clearances& one : found) {
      append(findings_, std::move(one.findings));
      if (one.robots.clearance < certificate.robots.clearance) certificate.robots = one.robots;
      if (one.obstacles.clearance < certificate.obstacles.clearance) certificate.obstacles = one.obstacles;
    }
    append(findings_, std::move(net.findings));
    certificate.net = net.room;
    certificate.catches = std::move(net.catches);
  }

  /// Only where every car has a chart; where one has none, its findings say so.
  NetVerdict verdict_on_net() {
    const bool all = std::all_of(charts_.begin(), charts_.end(), [](const Chart& c) { return c.complete; });
    if (!all || context_.out_of_time()) return {};
    return prove_net(context_, scene_, plan_, crossings_);
  }

  Context& context_;
  const traj::TeamTrajectory& plan_;
  Workers& workers_;
  int count_;
  bool with_net_;
  std::vector<std::optional<net::Crossing>> crossings_;  // of the targets with the rim plane
  std::vector<Chart> charts_;
  std::vector<std::vector<geom::Convex>> parts_;  // owns the shapes of the moving obstacles
  Scene scene_;
  std::vector<Finding> findings_;
};

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "certified";
    case Verdict::refuted:
      return "refuted";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

Verdict Certificate::verdict() const {
  if (holds) return Verdict::holds;
  const bool open = std::all_of(violations.begin(), violations.end(),
                                [](const Violation& v) { return v.kind == Kind::undecided; });
  return open ? Verdict::undecided : Verdict::refuted;
}

Certificate certify(const world::Scenario& scenario, const world::StaticMap& map,
                    const traj::TeamTrajectory& plan, const Options& options) {
  world::expect_judgeable(scenario);
  const Stopwatch watch;
  Certificate certificate;
  Context context{scenario, map, options};
  std::vector<Finding> findings = malformations(context, plan);
  if (findings.empty() && !plan.robots.empty()) {
    Workers workers(std::max(1, options.threads));
    findings = Proof(context, plan, workers).run(certificate);
  }
  certificate.violations = worst_of_each(std::move(findings), options.violations_per_kind);
  certificate.holds = certificate.violations.empty();
  certificate.seconds = watch.seconds();
  return certificate;
}

}  // namespace seine::certify
