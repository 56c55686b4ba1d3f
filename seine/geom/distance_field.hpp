#pragma once

#include <span>
#include <vector>

#include "seine/geom/box.hpp"
#include "seine/geom/convex.hpp"
#include "seine/geom/vec2.hpp"

namespace seine::geom {

/// How far the nearest of many convex pieces is, tabulated at the nodes of a square grid. A node's value
/// never exceeds the true signed distance capped at `cap`; close to pieces it equals it (to some µm), further
/// away it may fall short by up to a cell's diagonal. Nothing is known about what is not a piece: bounds are
/// the caller's business.
struct DistanceField {
  Vec2 origin;                ///< node (0, 0)
  double cell = 0.1;          ///< m between nodes
  int width = 0;              ///< nodes along x
  int height = 0;             ///< nodes along y
  double cap = 0.0;           ///< m, the largest value
  std::vector<float> values;  ///< m, width × height, row-major from the lowest row; negative inside pieces

  /// Bilinear interpolation; points beyond the grid read its nearest edge.
  double value(Vec2 p) const;
  /// Never more than the true distance of p capped at `cap`, wherever p is. Signed distance is 1-Lipschitz,
  /// so an interpolated value is too large by at most the mean distance of p to the nodes it is made of,
  /// cell·√(s(1−s) + t(1−t)).
  double lower_bound(Vec2 p) const;

 private:
  struct Place {
    std::size_t node;  // lower left
    double s, t;       // in [0, 1]
    double beyond;     // m, from the grid to p
  };
  Place locate(Vec2 p) const;
  double interpolate(const Place& at) const;
};

/// The field of `pieces` over `extent`, nodes `cell` (m) apart, values up to `cap` (m; at most 126 cells,
/// more is reduced to that). Exact up to the cap when the pieces are few; else exact in a band about each,
/// and beyond it a Euclidean distance transform of the nodes that are less than half a cell's diagonal from a
/// piece.
DistanceField distance_field(std::span<const Convex* const> pieces, const Box& extent, double cell,
                             double cap);
DistanceField distance_field(std::span<const Convex> pieces, const Box& extent, double cell, double cap);

}  // namespace seine::geom
