#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/world/scenario.hpp"

namespace seine::world {

/// Everything that stands still, as convex pieces in a bucket grid: polygons cut into convex parts, circles as rounded points,
/// occupied map cells as rectangles. Immutable after construction; safe to query from many threads at once.
class StaticMap {
 public:
  struct Piece {
    geom::Convex shape;
    geom::Box box;
    int obstacle = -1;  ///< index into Scenario::obstacles, −1 for the occupancy grid
  };

  /// Throws InputError when an obstacle's polygon is not simple.
  explicit StaticMap(const Scenario& scenario);

  const geom::Box& bounds() const { return bounds_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Calls `visit(const Piece&)` for every piece whose box overlaps `box`: each exactly once, in ascending index order.
  template <class Visit>
  void for_each_near(const geom::Box& box, Visit&& visit) const;

  /// The piece nearest to a convex polygon, and how it stands to it.
  struct Nearest {
    double distance;     ///< exact signed distance, m; `cap` when nothing is nearer
    int piece = -1;      ///< index into pieces(); −1: the bounds, or nothing within cap
    bool bounds = false; ///< the bounds are what is nearest
    geom::Separation separation{};
  };
  /// Looks no further than `cap` metres.
  Nearest nearest(std::span<const geom::Vec2> polygon, double cap) const;
  /// Distance only: true when the polygon keeps `clearance` (m) to every piece and to the bounds.
  bool clear(std::span<const geom::Vec2> polygon, double clearance) const;
  /// "obstacle 3", the user's name of it, or "the map at (x, y)".
  std::string describe(int piece) const;

 private:
  // `collect` gathers the distinct indices of pieces in the buckets under `box`, ascending, in a thread-local scratch list.
  std::span<const int> collect(const geom::Box& box) const;

  geom::Box bounds_;
  std::vector<Piece> pieces_;
  std::vector<std::string> names_;
  double bucket_ = 1.0;  // m
  int columns_ = 0, rows_ = 0;
  std::vector<int> bucket_begin_;  // CSR: columns·rows + 1
  std::vector<int> bucket_items_;
};

template <class Visit>
void StaticMap::for_each_near(const geom::Box& box, Visit&& visit) const {
  for (const int index : collect(box)) {
    const Piece& piece = pieces_[static_cast<std::size_t>(index)];
    if (piece.box.overlaps(box)) visit(piece);
  }
}

}  // namespace seine::world
