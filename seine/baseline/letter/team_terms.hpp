#pragma once

#include <optional>
#include <vector>

#include "seine/baseline/letter/robot_terms.hpp"

namespace seine::baseline::letter {

/// A target as the letter knows it: where on the ground, and when.
struct Meeting {
  geom::Vec2 ground;
  double time = 0.0;  ///< s
};

/// What the net asks; robots hold it in their order, counter-clockwise.
struct NetTask {
  std::vector<geom::Vec2> attachments;  ///< body frame
  std::vector<double> longest;          ///< m, between each robot and the next in the ring
  bool size = true, topology = true;
  std::vector<Meeting> meetings;
  /// The mean of the attachments ends within `radius` of `center`.
  struct Region {
    geom::Vec2 center;
    double radius;
  };
  std::optional<Region> delivery;
};

/// Where the robots are at one instant, and ∂/∂ of their attachments: memory used again from sample to
/// sample.
struct Ring {
  std::vector<Place> places;
  std::vector<geom::Vec2> corners, gradient;
  explicit Ring(std::size_t robots) : places(robots), corners(robots), gradient(robots) {}
};

/// What one share of the robots adds to: gradients of all robots, and what was violated most.
struct Share {
  std::vector<CurveGradient> gradients;
  Ring ring;
  Worst worst{};
};

/// What the robots ask of each other on the common clock: every sample of one robot looks where the others
/// are at that time. Gradients with respect to the others, durations included, are added to buffers.
class TeamTerms {
 public:
  TeamTerms(std::vector<RobotTerms>& robots, double clearance, std::optional<NetTask> net,
            const Settings& settings);

  /// What the samples of one robot ask.
  void add(std::size_t robot, Share& share);
  /// What is asked at single instants: catches and the delivery. @return its cost
  double add_moments(Share& share);

  /// m, signed distance of each meeting's ground point to the net (negative inside), and of the middle of the
  /// ends to the delivery region, at the last evaluation.
  const std::vector<double>& missed() const { return missed_; }

 private:
  void add_pair(std::size_t robot, std::size_t other, Share& share);
  bool overlap(const Span& span, double reach, std::size_t other, std::size_t& cursor) const;
  /// How far apart a pair is asked to be, and what that means for the quicker distances.
  struct Apart {
    double asked;   ///< m, clearance and slack
    double error;   ///< m, of the smoothing
    double wanted;  ///< m: where the sharp distance is this large, the smooth one is large enough
    double reach;   ///< m: so far apart the positions need not be looked at
  };
  Apart apart(const Shape& a, const Shape& b) const;
  void add_pair_sample(std::size_t robot, Sample& sample, std::size_t other, const Apart& apart,
                       Share& share);
  void add_net_sample(std::size_t robot, Sample& sample, Share& share);
  double add_size(std::size_t robot, Share& share) const;
  double add_topology(std::size_t robot, Share& share) const;
  double add_catch(std::size_t meeting, Share& share);
  double add_delivery(Share& share);
  void pull_ring(double weight, Share& share) const;
  geom::Vec2 attachment(const Place& place, std::size_t robot) const;

  std::vector<RobotTerms>& robots_;
  double clearance_;
  std::optional<NetTask> net_;
  Settings settings_;
  Penalties penalties_;
  std::vector<double> missed_;
};

}  // namespace seine::baseline::letter
