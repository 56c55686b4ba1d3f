#pragma once

#include <vector>

#include "seine/planner/segment_fit.hpp"
#include "seine/search/formation.hpp"

namespace seine::planner {

/// A formation's way and timing, and how the cars stand in it along the way.
struct FormationGuess {
  search::FormationPath way;
  search::FormationTiming timing;
  /// How the cars stand: as in the first shape, and from each change on as in the next.
  struct Change {
    double begin, end;  ///< m driven
  };
  std::vector<search::Formation> shapes;
  std::vector<Change> changes;  ///< one fewer than shapes, in order

  /// Offset of car k at driven length s.
  geom::Vec2 offset(std::size_t k, double s) const;
};

/// One task a car, all with the same segments and pieces, so that they can share one timing.
std::vector<trajopt::RobotTask> fit_formation(const FormationGuess& guess, const world::Scenario& scenario,
                                              const world::StaticMap& map, const FitOptions& options);

}  // namespace seine::planner
