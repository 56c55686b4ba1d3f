#pragma once

#include <limits>
#include <span>
#include <vector>

#include "seine/search/path.hpp"
#include "seine/search/swept_footprint.hpp"
#include "seine/world/scenario.hpp"

namespace seine::search {

/// Something that moves on the common clock, as polygons that stand for spans of time. Time is counted in
/// ticks: tick q is the time q·tick and stands for [q − ½, q + ½] ticks. Within an event the body is inside
/// its polygon.
class MovingBody {
 public:
  static constexpr int kForever = std::numeric_limits<int>::max();
  static constexpr std::size_t kManyEvents = 1 << 16;  ///< an hour at walking pace

  struct Event {
    geom::Box box;
    OrientedBox turned;
    int begin, end;  ///< ticks, [begin, end); kForever: it stays
  };
  struct Chunk {
    geom::Box box;
    int first, last;  ///< events, [first, last)
    int begin, end;   ///< ticks
  };

  MovingBody() = default;
  /// A car on its path by a speed profile (as in TimedPath).
  MovingBody(const Path& path, std::span<const ProfileKnot> profile, const SweptFootprint& footprint,
             double tick);
  /// A convex part of a moving obstacle: `shape` in the obstacle's body frame; a rounded shape is replaced by
  /// a polygon around it.
  /// @param many  events beyond which the motion is told ever more coarsely towards its end
  MovingBody(const geom::Convex& shape, std::span<const world::Waypoint> motion, double tick,
             std::size_t many = kManyEvents);

  std::span<const Event> events() const { return events_; }
  std::span<const Chunk> chunks() const { return chunks_; }
  std::span<const geom::Vec2> polygon(int event) const {
    return {&polygons_[static_cast<std::size_t>(event) * corners_], corners_};
  }
  const geom::Box& box() const { return box_; }
  bool boxes() const { return boxes_; }  ///< the polygons are the turned boxes
  int rest_tick() const {
    return events_.empty() ? 0 : events_.back().begin;
  }  ///< from when on it stands for good

 private:
  std::span<geom::Vec2> add_event(int begin, int end);
  void finish();

  std::size_t corners_ = 0;
  std::vector<Event> events_;
  std::vector<Chunk> chunks_;
  std::vector<geom::Vec2> polygons_;
  geom::Box box_;
  bool boxes_ = false;
};

/// Something that moves while the car drives, by a motion that is known, and how far to stay from it.
struct Traffic {
  const MovingBody* body = nullptr;
  double clearance = 0.0;  ///< m
};

/// Whether a convex polygon keeps the clearance to the body during one of its events. @param turned a box
/// around the polygon; @param is_box the polygon is that box
inline bool apart(const OrientedBox& turned, std::span<const geom::Vec2> polygon, bool is_box,
                  const MovingBody& body, int event, double clearance) {
  // Starts that touch, or stand exactly at the margin, are legal: as much is forgiven to rounding, m.
  constexpr double kTouch = 1e-6;
  const OrientedBox& other = body.events()[static_cast<std::size_t>(event)].turned;
  const Standing boxes = standing(turned, other, clearance - kTouch);
  if (boxes == Standing::kApart) return true;
  if (is_box && body.boxes()) {
    if (boxes == Standing::kOverlap) return false;
    return squared_distance(turned, other) >= (clearance - kTouch) * (clearance - kTouch);
  }
  return apart(polygon, body.polygon(event), clearance);
}

/// Where a moving obstacle's body frame is at time t: straight between waypoints, heading the short way
/// round.
geom::Pose2 pose_at(std::span<const world::Waypoint> motion, double t);

/// The moving obstacles of a scenario (those that stand still belong to the map) as convex parts, each in its
/// obstacle's body frame.
struct MovingPart {
  geom::Convex shape;
  std::span<const world::Waypoint> motion;  ///< of the scenario, which must outlive it
  int obstacle = -1;                        ///< index into Scenario::obstacles
};
std::vector<MovingPart> moving_parts(const world::Scenario& scenario);

}  // namespace seine::search
