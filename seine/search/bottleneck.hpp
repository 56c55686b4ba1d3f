#pragma once

#include <optional>

#include "seine/geom/vec2.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// The narrowest place on the widest way of a point from one place to another: where a disc that cannot pass
/// gets stuck last.
struct Bottleneck {
  geom::Vec2 at;             ///< in its middle
  double width = 0.0;        ///< m, between what stands on its two sides; 0 where there is no opening at all
  double upper_width = 0.0;  ///< m, proved: no way anywhere is wider at its narrowest place
  bool nearer_to_goal = false;  ///< which side of it is the smaller one: that of `to`, or that of `from`
  double smaller_side = 0.0;    ///< m², ground on that side
};

/// Looks from both ends at once, widest ground first, on square cells. The way crosses cells one after the
/// other, and no point of a cell is further from everything than its middle is plus half its diagonal: that
/// makes `upper_width` a proof. Distances are to everything that stands still and to the bounds.
/// @param cell m, side of a cell; made larger in worlds with too many of them
/// @param needed m, a width of interest: cells get smaller while it is in doubt whether there is one so wide
/// @param cap  m, half of the largest width that is of interest, more than half of `needed`
/// @return nothing when the widest way is wider than 2·cap everywhere, or an end lies out of the bounds
std::optional<Bottleneck> bottleneck(const world::StaticMap& map, geom::Vec2 from, geom::Vec2 to, double cell,
                                     double needed, double cap);

}  // namespace seine::search
