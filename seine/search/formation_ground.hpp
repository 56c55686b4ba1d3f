#pragma once

#include <memory>
#include <vector>

#include "seine/search/cost_to_go.hpp"
#include "seine/search/formation.hpp"
#include "seine/search/point_distances.hpp"

namespace seine::search {

/// Where a formation's frame stands; its heading as a direction as well, for sines are dear.
struct Stand {
  geom::Vec2 at, forward;
  double heading = 0.0;
};
inline Stand stand_at(const geom::Pose2& pose) {
  return {pose.position(), pose.direction(), pose.heading};
}
/// `step`, given from `from`.
inline Stand stand_after(const Stand& from, const Stand& step) {
  const geom::Vec2 f = from.forward;
  return {from.at + geom::Vec2{f.x * step.at.x - f.y * step.at.y, f.y * step.at.x + f.x * step.at.y},
          {f.x * step.forward.x - f.y * step.forward.y, f.y * step.forward.x + f.x * step.forward.y},
          from.heading + step.heading};
}

/// Where a formation can stand, and how far its net is from where it must go. What it learns about the ground
/// serves every search of the same task. Not thread-safe; internal to the room.
class FormationGround {
 public:
  explicit FormationGround(const FormationProblem& problem);

  /// Every footprint and the net clear of everything they must keep clear of, with a little slack.
  bool clear(const Stand& frame, const Formation& formation);
  /// Of the attachments.
  geom::Vec2 middle(const Stand& frame, const Formation& formation);

  /// From now on `to` knows ways around what is tall, for a disc that fits into every one of these.
  void find_ways(std::span<const Formation> shapes);
  /// m from a point to a rendezvous, or, numbered after them, to the goal. @param field around what is tall
  /// (needs find_ways); otherwise as the crow flies
  double to(std::size_t place, geom::Vec2 point, bool field);

  double car_length() const { return length_; }

 private:
  void hold(const Stand& frame, const Formation& formation);
  bool car_clear(std::size_t k, const Stand& frame, const Formation& formation);
  bool clear_below(const Formation& formation) const;

  const FormationProblem& p_;
  double length_;  // m, of the longest car
  struct Disc {
    double ahead, outer, inner;  // m: of the centre along the heading; around, and inside the footprint
  };
  std::vector<Disc> discs_;
  PointDistances cars_;  // from what the cars keep clear of
  std::unique_ptr<PointDistances> tall_;
  std::vector<std::unique_ptr<CostToGo>> fields_;  // to each rendezvous, then to the goal
  std::vector<geom::Vec2> polygon_, attachments_;
  std::size_t blocked_ = 0;  // the car that stood in something last
};

}  // namespace seine::search
