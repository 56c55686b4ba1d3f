#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "seine/certify/clearance.hpp"
#include "seine/certify/formation.hpp"
#include "seine/certify/report.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/flight.hpp"
#include "seine/traj/trajectory.hpp"

namespace seine::certify {

/// Where each target falls through the rim plane, in their order; none where it never does.
std::vector<std::optional<net::Crossing>> crossings_of(const world::Scenario& scenario);

/// From when on something lies in the net: at once with a payload, else from the first catch on. Targets that
/// are never caught count for nothing here.
Phases phases_of(const world::Scenario& scenario, const std::vector<std::optional<net::Crossing>>& crossings);

/// How slowly what has been caught must be carried; only targets with drag ask for that.
std::vector<Context::Carry> carries_of(const world::Scenario& scenario,
                                       const std::vector<std::optional<net::Crossing>>& crossings);

/// Every target against the rules of a physical catch.
class CatchCheck {
 public:
  CatchCheck(Context& context, const traj::TeamTrajectory& plan, const Scene& scene)
      : context_(context), net_(*context.scenario.net), plan_(plan), scene_(scene) {}

  /// @return one a target, in their order; NaN throughout where it is never in reach
  std::vector<net::Catch> run(const std::vector<std::optional<net::Crossing>>& crossings);
  std::vector<Finding> take_findings() { return std::move(findings_); }

 private:
  void look_at_team(double t);
  double margin_where_it_lands(std::size_t target, const net::Crossing& crossing, double depth);
  /// The highest of the obstacles under the net at time t that the net passes over, m.
  double highest_under(double t) const;
  void judge(std::size_t target, const net::Catch& caught);
  /// Notes a target that is released below the rim and rises through the net or a car, each taken to be as
  /// tall as the rim. Looked at by conservative advancement: nothing is met between two looks.
  void check_rise(std::size_t target, double crossing);
  /// How far a point on the ground is from the net's polygon and from all cars at time t, m, and from which.
  std::pair<double, std::string> nearest_of_team(geom::Vec2 at, double t);
  void leave_open(std::size_t target, double time, const std::string& beside);
  void note(std::size_t target, double time, double value, double limit, double excess,
            const std::string& what);

  Context& context_;
  const net::Net& net_;
  const traj::TeamTrajectory& plan_;
  const Scene& scene_;
  std::vector<geom::Vec2> attachments_;
  net::Motion motion_;  // of their mean
  std::vector<Finding> findings_;
};

/// Whether there is room for the payload in the net when it is spread flat.
std::vector<Finding> check_payload(const Context& context);

/// Where the payload comes to rest with the team, and which way every car then faces.
std::vector<Finding> check_delivery(const Context& context, const traj::TeamTrajectory& plan);

}  // namespace seine::certify
