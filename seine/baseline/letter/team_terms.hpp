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

/// What the robots ask of each other on the common clock: every sample of one robot looks where the others
/// are at that time. Gradients with respect to the others, durations included, are added to buffers.
class TeamTerms {
 public:
  TeamTerms(std::vector<RobotTerms>& robots, double clearance, std::optional<NetTask> net,
            const Settings& settings);

  /// What the samples of one robot ask. @param others one buffer a robot
  void add(std::size_t robot, std::vector<CurveGradient>& others, Worst& worst);
  /// What is asked at single instants: catches and the delivery. @return its cost
  double add_moments(std::vector<CurveGradient>& gradients);

  /// m, signed distance of each meeting's ground point to the net (negative inside), and of the middle of the
  /// ends to the delivery region, at the last evaluation.
  const std::vector<double>& missed() const { return missed_; }

 private:
  void add_pair(std::size_t robot, std::size_t other, std::vector<CurveGradient>& others, Worst& worst);
  bool overlap(const Span& span, double reach, std::size_t other, std::size_t& cursor) const;
  void add_pair_sample(std::size_t robot, Sample& sample, std::size_t other, CurveGradient& gradient,
                       Worst& worst);
  void add_net_sample(std::size_t robot, Sample& sample, std::vector<CurveGradient>& others, Worst& worst);
  void pull_ring(std::span<const Place> places, std::span<const geom::Vec2> g_ring, double weight,
                 std::vector<CurveGradient>& gradients) const;
  geom::Vec2 attachment(const Place& place, std::size_t robot) const;

  std::vector<RobotTerms>& robots_;
  double clearance_;
  std::optional<NetTask> net_;
  Settings settings_;
  Penalties penalties_;
  std::vector<double> missed_;
};

}  // namespace seine::baseline::letter
