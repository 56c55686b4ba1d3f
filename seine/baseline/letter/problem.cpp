#include "seine/baseline/letter/problem.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace seine::baseline::letter {
namespace {

constexpr std::array<const char*, kLimits> kNames{"speed",     "acceleration", "lateral acceleration",
                                                  "curvature", "corridor",     "robots",
                                                  "net size",  "net topology"};

std::vector<RobotTerms> terms_of(const TeamTask& task, const Settings& settings) {
  std::vector<RobotTerms> robots;
  robots.reserve(task.robots.size());
  for (const RobotTask& robot : task.robots) robots.emplace_back(robot, settings);
  return robots;
}

}  // namespace

Problem::Problem(const TeamTask& task, const Settings& settings, Workers& workers)
    : settings_(settings),
      workers_(workers),
      robots_(terms_of(task, settings)),
      team_(robots_, task.robot_clearance, task.net, settings),
      costs_(robots_.size()) {
  for (const RobotTerms& robot : robots_) {
    offsets_.push_back(offsets_.back() + robot.curve().variables());
    total_.push_back(robot.curve().zero_gradient());
  }
  for (int s = 0; s < kShares; ++s) shares_.push_back({total_, Ring(robots_.size())});
}

std::vector<double> Problem::initial() const {
  std::vector<double> x(static_cast<std::size_t>(variables()));
  for (std::size_t k = 0; k < robots_.size(); ++k) robots_[k].curve().initial(part(std::span(x), k));
  return x;
}

double Problem::evaluate(std::span<const double> x, std::span<double> gradient) {
  const int count = static_cast<int>(robots_.size());
  workers_.run(count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    robots_[i].evaluate(part(x, i));
  });
  double cost = 0.0;
  workers_.run(kShares, [&](int s) {
    Share& share = shares_[static_cast<std::size_t>(s)];
    share.worst = {};
    for (CurveGradient& g : share.gradients) g.clear();
    for (int k = s; k < count; k += kShares) team_.add(static_cast<std::size_t>(k), share);
    if (s == 0) cost = team_.add_moments(share);
  });
  workers_.run(count, [&](int k) {
    const auto i = static_cast<std::size_t>(k);
    total_[i].clear();
    for (const Share& share : shares_) total_[i].add(share.gradients[i]);
    costs_[i] = robots_[i].collect(total_[i]);
    robots_[i].curve().gradient(total_[i], part(gradient, i));
  });
  for (const double c : costs_) cost += c;
  return cost;
}

optim::LbfgsSummary Problem::solve(std::span<double> x, const Deadline& deadline) {
  optim::LbfgsOptions options;
  options.memory = settings_.memory;
  options.decrease_tolerance = settings_.decrease;
  options.past = settings_.past;
  options.max_evaluations = settings_.evaluations;
  options.stop = [&](int, double) { return deadline.expired(); };
  return optim::minimize([this](std::span<const double> y, std::span<double> g) { return evaluate(y, g); }, x,
                         options);
}

Claim Problem::claim(std::span<const double> x, const optim::LbfgsSummary& summary) {
  Claim claim;
  std::vector<double> unused(x.size());
  evaluate(x, unused);
  const auto take = [&](const Worst& worst) {
    for (std::size_t i = 0; i < kLimits; ++i) claim.worst[i] = std::max(claim.worst[i], worst[i]);
  };
  for (const RobotTerms& robot : robots_) take(robot.worst());
  for (const Share& share : shares_) take(share.worst);
  claim.reason.clear();
  if (summary.status == optim::LbfgsStatus::evaluation_limit || summary.status == optim::LbfgsStatus::stopped)
    claim.reason = std::string("the solver did not converge: ") + optim::name_of(summary.status);
  for (std::size_t i = 0; i < kLimits && claim.reason.empty(); ++i) {
    const bool relative = i < static_cast<std::size_t>(Limit::corridor);
    if (claim.worst[i] > (relative ? settings_.claim_relative : settings_.claim_distance))
      claim.reason = std::string("a sample breaks the limit on ") + kNames[i] + " by " +
                     std::to_string(claim.worst[i]) + (relative ? " of it" : " m");
  }
  const std::vector<double>& missed = team_.missed();
  for (std::size_t m = 0; m < missed.size() && claim.reason.empty(); ++m)
    if (missed[m] > (m + 1 < missed.size() ? 0.0 : settings_.claim_distance))
      claim.reason = (m + 1 < missed.size() ? "target " + std::to_string(m) + " misses the net by "
                                            : "the team ends outside the delivery region by ") +
                     std::to_string(missed[m]) + " m";
  claim.holds = claim.reason.empty();
  return claim;
}

traj::TeamTrajectory Problem::trajectory(std::span<const double> x) {
  traj::TeamTrajectory team;
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    robots_[k].curve().load(part(x, k));
    team.robots.push_back(robots_[k].curve().trajectory());
  }
  return team;
}

}  // namespace seine::baseline::letter
