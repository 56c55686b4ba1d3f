#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "seine/geom/convex.hpp"
#include "seine/geom/distance_field.hpp"
#include "seine/world/scenario.hpp"

namespace seine::world {

/// Everything that stands still, as convex pieces in a bucket grid: polygons cut into convex parts, circles
/// as rounded points, occupied map cells as rectangles, what lies outside the map's picture as up to four
/// polygons (unless the scenario says that it is free). Immutable after construction; safe to query from many
/// threads at once, and from within a query's own `visit`.
class StaticMap {
 public:
  struct Piece {
    geom::Convex shape;
    geom::Box box;
    int obstacle = -1;  ///< index into Scenario::obstacles, −1 for the map and what lies outside it
  };

  /// Throws InputError when an obstacle's polygon is not simple, or the map has not as many cells as its size
  /// says.
  explicit StaticMap(const Scenario& scenario);

  const geom::Box& bounds() const { return bounds_; }
  const std::vector<Piece>& pieces() const { return pieces_; }

  /// Calls `visit(const Piece&)` for every piece whose box overlaps `box`: each exactly once, in ascending
  /// index order.
  template <class Visit>
  void for_each_near(const geom::Box& box, Visit&& visit) const;

  /// The piece nearest to a convex polygon, and how it stands to it.
  struct Nearest {
    double distance;      ///< exact signed distance, m; `cap` when nothing is nearer
    int piece = -1;       ///< index into pieces(); −1: the bounds, or nothing within cap
    bool bounds = false;  ///< the bounds are what is nearest
    geom::Separation
        separation{};  ///< a = the polygon, b = the piece or the bounds; unset when nothing is within cap
  };
  /// Looks no further than `cap` metres; an infinite cap is allowed. Ties go to the lower index, and to
  /// pieces before bounds.
  Nearest nearest(std::span<const geom::Vec2> polygon, double cap) const;
  /// Its distance alone.
  double distance(std::span<const geom::Vec2> polygon, double cap) const;
  /// Distance only: true when the polygon keeps `clearance` (m) to every piece and to the bounds, to within a
  /// nanometre.
  bool clear(std::span<const geom::Vec2> polygon, double clearance) const;
  /// "obstacle 3", the user's name of it, "the map at (x, y)", or "the unknown ground outside the map".
  std::string describe(int piece) const;

 private:
  // A range of buckets, ends included; empty when high < low.
  struct Range {
    int column_low, column_high, row_low, row_high;
  };
  // The distinct indices of pieces whose boxes overlap a box, ascending, in a list borrowed from the thread
  // for as long as it lives.
  class Found {
   public:
    Found(const StaticMap& map, const geom::Box& box);
    ~Found();
    Found(const Found&) = delete;
    Found& operator=(const Found&) = delete;
    const int* begin() const { return indices_->data(); }
    const int* end() const { return indices_->data() + indices_->size(); }

   private:
    std::vector<int>* indices_;
  };

  void add_pieces(const Scenario& scenario);
  void add_map(const Scenario& scenario);
  void build_buckets();
  int column_of(double x) const;
  int row_of(double y) const;
  Range range_of(const geom::Box& box) const;
  // Calls visit(index) -> bool for pieces whose boxes overlap `box`, each once, in bucket order; stops and
  // returns false as soon as it does.
  template <class Visit>
  bool visit_buckets(const geom::Box& box, Visit&& visit) const;
  struct Best {
    double distance;
    int piece;
  };
  // Replaces `best` by a piece that is nearer, of those within `reach` of the box (ties: the lower index).
  Best find_nearest(std::span<const geom::Vec2> polygon, double within) const;
  void improve(std::span<const geom::Vec2> polygon, const geom::Box& box, double reach, Best& best) const;
  bool piece_clear(std::size_t piece, std::span<const geom::Vec2> polygon, double clearance) const;

  geom::Box bounds_;
  geom::Vec2 origin_;  // Scenario::origin
  std::vector<Piece> pieces_;
  std::size_t outside_begin_ = 0;   // from here on pieces lie outside the map's picture
  std::vector<std::string> names_;  // of obstacles

  // Buckets: CSR over columns·rows cells of side bucket_ from low_ on; pieces beyond the grid are filed in
  // its border cells.
  geom::Vec2 low_;
  double bucket_ = 1.0;   // m
  double inverse_ = 1.0;  // 1/m
  int columns_ = 0, rows_ = 0;
  std::vector<int> bucket_begin_;
  std::vector<int> bucket_items_;

  // What `clear` reads, packed: boxes and, per face of a core, its tail and unit outward normal (a point has
  // one with normal 0).
  struct Face {
    geom::Vec2 tail, normal;
  };
  std::vector<geom::Box> boxes_;
  std::vector<int> face_begin_;
  std::vector<Face> faces_;
};

template <class Visit>
void StaticMap::for_each_near(const geom::Box& box, Visit&& visit) const {
  const Found found(*this, box);
  for (const int index : found) visit(pieces_[static_cast<std::size_t>(index)]);
}

/// The distance field of all pieces over the bounds (which it does not contain: they are easier asked
/// directly).
geom::DistanceField distance_field(const StaticMap& map, double cell, double cap);

}  // namespace seine::world
