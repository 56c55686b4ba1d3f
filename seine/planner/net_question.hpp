#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seine/planner/planner.hpp"
#include "seine/search/formation.hpp"
#include "seine/trajopt/net_task.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::planner {

/// What a scenario's net, targets and delivery ask, worked out once: for the guess, for the optimiser, and
/// whether it can be done at all.
struct NetQuestion {
  trajopt::NetTask task;  ///< `task.tall` points at `tall`
  std::vector<search::Rendezvous> meetings;
  std::unique_ptr<world::StaticMap> tall;  ///< what the net can never pass over
  std::string refusal;                     ///< not empty: proved impossible, and why

  /// Whether certified catches have what is asked of a plan beyond the certificate.
  bool roomy(const std::vector<net::Catch>& catches) const;
};

NetQuestion ask_net(const world::Scenario& scenario, const Ablation& without);

/// The least time, s, in which the net can stand around `point` with `margin` (m) to every edge: the polygon
/// contains that disc, so in every direction some attachment is beyond it, and no car is faster than its
/// limits. Obstacles and steering do not count, so a catch that has less time is impossible
/// (docs/net-planning.md).
double least_time(const world::Scenario& scenario, geom::Vec2 point, double margin);

}  // namespace seine::planner
