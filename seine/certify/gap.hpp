#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "seine/certify/mover.hpp"
#include "seine/certify/report.hpp"

namespace seine::certify {

/// Proves that two convex bodies keep a distance over an interval on which both motions are analytic, and
/// finds the smallest one.
///
/// Along any fixed unit vector n the gap g(t) = min n·b(t) − max n·a(t) is a lower bound of the signed
/// distance, and a minimum of functions n·(b_j(t) − a_i(t)) whose second derivative is at most bend_a +
/// bend_b. So on [s, t] the distance is at least min(g(s), g(t)) − ⅛ (bend_a + bend_b) (t − s)². The n that
/// parts the bodies in the middle is tried on both halves; halves that are not proved are halved again.
class GapProof {
 public:
  /// What one interval came to.
  struct Worst {
    double time;
    double distance;
  };

  /// @param margin m, to be kept
  GapProof(Context& context, double margin);

  /// Another margin from now on, m.
  void require(double margin);

  void between(const Mover& a, const Mover& b);
  void between(const Mover& a, std::span<const geom::Vec2> fixed, double radius);

  /// Distances beyond this need no proof: the margin is kept and the closest approach so far stays the
  /// closest.
  double wanted() const;
  /// The worst instant when the margin is broken on [t0, t1]. @param b null when the other body stands still
  std::optional<Worst> prove(const Cell& a, const Cell* b, double t0, double t1);
  /// The same within the bounds: all four walls at once.
  std::optional<Worst> prove_inside(const geom::Box& bounds, const Mover& mover, const Cell& cell, double t0,
                                    double t1);

  /// Smallest distance met so far, over all pairs given to this proof; set it lower to look only for closer
  /// ones.
  double closest = std::numeric_limits<double>::infinity();
  double closest_time = 0.0;
  bool closest_changed = false;     ///< by the last `prove`
  std::optional<double> undecided;  ///< a time at which the proof gave up, since it was last reset

 private:
  struct Placed {
    std::vector<geom::Vec2> a, b;
  };
  void place(double t, Placed& out) const;
  double gap_along(geom::Vec2 normal, const Placed& at) const;
  void met(double distance, double time);
  void refine(double t0, const Placed& from, double t1, const Placed& to, int depth);
  void refine_inside(const geom::Box& bounds, double t0, double gap0, double t1, double gap1, int depth);
  double gap_inside(const geom::Box& bounds, double t);
  bool give_up(double time, int depth);
  /// Room for both bodies' points; one for each depth of the halving, made when it is first reached.
  Placed& level(int depth);
  std::optional<Worst> result() const;

  Context& context_;
  double size_;           // Granted::size of the smallest car
  double seen_, proved_;  // m
  const Mover* a_ = nullptr;
  const Mover* b_ = nullptr;
  std::span<const geom::Vec2> fixed_;
  double radii_ = 0.0;
  const Cell* cell_a_ = nullptr;
  const Cell* cell_b_ = nullptr;
  double bend_ = 0.0;
  geom::Vec2 normal_;  // the last one that parted this pair; zero: none yet
  Worst worst_{};
  int steps_ = 0;
  std::size_t points_a_ = 0, points_b_ = 0;
  std::vector<Placed> levels_;
};

}  // namespace seine::certify
