#pragma once

#include <optional>

#include "seine/base/deadline.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/search/motion.hpp"
#include "seine/search/route.hpp"

namespace seine::search {

/// A way between a tight place (a kerbside slot, a garage) and a pose elsewhere.
struct SlotProblem {
  geom::Pose2 inside;   ///< the pose in the tight place
  geom::Pose2 outside;  ///< the other end
  bool leaving = true;  ///< whether the car drives from inside to outside, else from outside to inside
  const FootprintChecker* checker = nullptr;
  double radius = 1.0;  ///< m, of the turns used
  std::span<const Bump> bumps;
  int max_expansions = 500;
  Deadline deadline;
};

struct SlotResult {
  std::optional<Route> route;  ///< as the car drives it
  int expansions = 0;
};

/// Wriggles out of the tight place: the front wheel straight or hard over, forth and back until something is
/// in the way or a part of that, until Reeds-Shepp words lead on to the other end. What takes the least time
/// is looked at first (a best-first search over poses at rest and changes of the wheel). Works for front- and
/// rear-steered cars alike. Deterministic; ties go to the node made first.
SlotResult search_slot(const SlotProblem& problem);

}  // namespace seine::search
