#pragma once

#include <limits>
#include <span>
#include <vector>

#include "seine/geom/box.hpp"
#include "seine/geom/pose2.hpp"
#include "seine/search/point_distances.hpp"
#include "seine/vehicle/arc.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// A footprint as discs along its long axis, for quick answers from point distances: the union of the outer
/// discs covers the footprint, every inner disc lies inside it.
struct DiscCover {
  struct Disc {
    double x = 0.0;      ///< m, on the body's axis y = `axis`
    double outer = 0.0;  ///< m, radius
    double inner = 0.0;  ///< m, radius, ≥ 0
  };
  std::vector<Disc> discs;
  double axis = 0.0;

  explicit DiscCover(std::span<const geom::Vec2> footprint);
  /// The disc with the largest inner radius (the rearmost of equals).
  const Disc& widest() const;
};

/// Whether a whole footprint keeps its distance to everything that stands still. `room` at a pose is the
/// distance to the nearest obstacle beyond the clearance asked for, m: 0 = exactly the clearance, negative =
/// too close. Made for one query (cheap: no allocation beyond the parked cars); const functions may be called
/// from many threads.
class FootprintChecker {
 public:
  /// @param field may be null; when given it is of the same map and only makes the answers quicker.
  FootprintChecker(const world::StaticMap& map, const PointDistances* field, const vehicle::Model& model,
                   double clearance);

  /// Footprints in the world (convex, counter-clockwise) that are obstacles too, with their own clearance.
  /// The spans must outlive the checker.
  void park(std::span<const geom::Vec2> footprint, double clearance);

  /// Search slack: poses must have at least this much room. It pays twice, as something left for the
  /// optimiser and because a sweep then needs few samples. Within `radius` of `center` the smaller `slack`
  /// holds (a start or goal that is itself that close).
  void set_slack(double slack) { slack_ = slack; }
  void ease_slack(geom::Vec2 center, double radius, double slack);

  /// A lower bound of the room at `pose`, exact where it is small; negative when the clearance is not kept
  /// (then only the sign counts).
  double room(const geom::Pose2& pose) const;
  /// The same, exact up to a fifth of a car length.
  double exact_room(const geom::Pose2& pose) const;
  /// The slack asked for at a place.
  double slack_at(geom::Vec2 position) const;
  bool clear(const geom::Pose2& pose) const { return room(pose) >= slack_at(pose.position()); }

  /// Certain in continuous time: the room never falls below 0 on the way (proved between samples with the
  /// speed of the fastest corner, to within `resolution`), and is at least the slack at every sample and at
  /// the end.
  /// @param room_from  room(from), known to the caller;  @param to  drive(from, arc)
  /// @return room(to), or a negative number when the sweep is not clear.
  double sweep(const geom::Pose2& from, double room_from, const vehicle::Arc& arc,
               const geom::Pose2& to) const;
  bool clear(const geom::Pose2& from, const vehicle::Arc& arc) const;
  /// m, ≤ |arc.distance|: how far along the arc the way stays clear in the sense of `sweep`.
  double reach(const geom::Pose2& from, double room_from, const vehicle::Arc& arc) const;

  /// Samples are never closer than this (m driven) even where there is no slack at all: 1/400 of the car's
  /// length.
  double resolution() const { return resolution_; }
  const vehicle::Model& model() const { return *model_; }

 private:
  struct Parked {
    std::span<const geom::Vec2> footprint;
    geom::Vec2 center;
    double radius;  // around center
    double clearance;
  };
  struct Ease {
    geom::Vec2 center;
    double radius_squared;
    double slack;
  };
  double fastest_corner(double curvature) const;
  bool straight_clear(const geom::Pose2& from, double distance) const;
  double quick_room(const geom::Pose2& pose) const;
  double near_room(const geom::Pose2& pose, double map_room) const;
  double parked_circles(const geom::Pose2& pose, double cap) const;
  double parked_room(const geom::Pose2& pose, std::span<const geom::Vec2> polygon, double cap) const;

  const world::StaticMap* map_;
  const PointDistances* field_;
  const vehicle::Model* model_;
  DiscCover cover_;
  double clearance_;
  double slack_ = 0.0;
  double resolution_;
  double look_;        // m: how far an exact query looks
  geom::Vec2 middle_;  // of the footprint's bounding circle, body frame
  double reach_;       // its radius
  std::vector<Parked> parked_;
  std::vector<Ease> eases_;
};

/// The moves of a lattice search: every pair of gear and curvature once.
struct Primitives {
  std::vector<vehicle::Arc> arcs;

  /// `forward` curvatures ahead and `backward` curvatures back, evenly spaced over [−1/radius, 1/radius] (odd
  /// counts), `step` m each.
  static Primitives fan(double radius, double step, int forward = 5, int backward = 3);
};

}  // namespace seine::search
