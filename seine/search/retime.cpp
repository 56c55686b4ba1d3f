#include "seine/search/retime.hpp"

#include "seine/search/coordinator.hpp"
#include "seine/search/team_search.hpp"

namespace seine::search {

std::optional<std::vector<TimedPath>> retime(const world::Scenario& scenario, std::span<const Path> paths,
                                             std::span<const int> order, const RetimeOptions& options) {
  Coordinator coordinator(scenario, options.lattice, options.extra_robot_clearance);
  TeamState state(scenario.robots.size());
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    const int robot = static_cast<int>(i);
    if (options.fixed != nullptr && (*options.fixed)[i])
      coordinator.fix(robot, *(*options.fixed)[i], state);
    else if (!coordinator.add_way(robot, paths[i]))
      return std::nullopt;
  }
  TeamSearch search(coordinator, {}, {}, options.seed);
  if (!search.solve(state, options.deadline, order)) return std::nullopt;
  search.improve(state, options.deadline);
  std::vector<TimedPath> motions;
  for (std::size_t i = 0; i < state.size(); ++i)
    motions.push_back(coordinator.motion(static_cast<int>(i), *state[i]));
  return motions;
}

}  // namespace seine::search
