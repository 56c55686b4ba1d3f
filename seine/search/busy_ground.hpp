#pragma once

#include <span>
#include <vector>

#include "seine/search/space_time_search.hpp"

namespace seine::search {

/// A span of time, s.
struct Span {
  double begin, end;  ///< end may be infinite
};

/// When the ground that a car covers is needed by the traffic.
class BusyGround {
 public:
  BusyGround(std::span<const Traffic> traffic, const SweptFootprint& footprint, double tick);

  /// When the traffic comes too close to a car that stands at `pose`, or anywhere within `slack` of it:
  /// ascending, disjoint. Valid until the next call.
  std::span<const Span> busy(const geom::Pose2& pose, const Slack& slack = {});

 private:
  void add(const Traffic& other, const geom::Box& box, const OrientedBox& turned);

  std::span<const Traffic> traffic_;
  const SweptFootprint& footprint_;
  double tick_;
  std::vector<geom::Vec2> polygon_;
  std::vector<Span> spans_;
};

/// Sorts spans and joins those that meet.
void unite(std::vector<Span>& spans);

}  // namespace seine::search
