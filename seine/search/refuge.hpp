#pragma once

#include <span>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/motion.hpp"
#include "seine/search/path.hpp"
#include "seine/search/route.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::search {

/// The ground that cars cover on their ways, as footprints a fifth of a car length apart with some slack for
/// what lies between them.
class Lane {
 public:
  /// Adds a way. @param clearance m, to keep off it
  void add(const vehicle::Model& model, const Path& way, double clearance);
  /// m by which `body` (convex, counter-clockwise) keeps off the ground beyond the clearance, at most `cap`;
  /// negative when it does not.
  double room(std::span<const geom::Vec2> body, double cap) const;

 private:
  struct Place {
    std::vector<geom::Vec2> footprint;
    geom::Box box;  // inflated by the clearance
    double clearance;
  };
  std::vector<Place> places_;
};

/// How finely refuges are looked for. Lengths in metres.
struct RefugeSettings {
  double radius = 1.0;  ///< of the tightest turn
  double step = 0.8;
  double cell = 0.45;
  int headings = 24;
  bool reverse = true;  ///< whether the car has a reverse gear
  double room = 0.0;    ///< wished for on top of the clearance to the lane
  int max_expansions = 4000;
  Deadline deadline{};
};

/// Where a car can make way: the nearest poses, by driving, at which it keeps off the lane, and the ways
/// there. A search in all directions over (x, y, heading), so that side roads, far ends and rooms are found
/// as well as what lies beside the way. One route at most to each stretch of ground: refuges are at least a
/// car length apart. The nearest first. Deterministic.
std::vector<Route> refuges(const geom::Pose2& start, const FootprintChecker& checker, const Lane& lane,
                           const RefugeSettings& settings, std::size_t most);

}  // namespace seine::search
