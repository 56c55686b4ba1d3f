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
  /// @param grain m: what moves less is taken as one
  BusyGround(std::span<const Traffic> traffic, const SweptFootprint& footprint, double tick, double grain);

  /// When the traffic comes too close to a car that stands at `pose`, or anywhere within `slack` of it:
  /// ascending, disjoint. Valid until the next call.
  std::span<const Span> busy(const geom::Pose2& pose, const Slack& slack = {});

 private:
  // A few events of one body as one: their hull, and from when to when.
  struct Piece {
    geom::Box box;
    Span span;
    std::size_t begin, end;  // corners
    double clearance;
  };
  struct Chunk {
    geom::Box box;  // inflated by the clearance
    std::size_t first, last;
  };
  void add(const Traffic& other, double tick, double grain);
  void close_chunk(std::size_t first);

  const SweptFootprint& footprint_;
  std::vector<Piece> pieces_;
  std::vector<Chunk> chunks_;
  std::vector<geom::Vec2> corners_;
  std::vector<geom::Vec2> polygon_;
  std::vector<Span> spans_;
};

/// Sorts spans and joins those that meet.
void unite(std::vector<Span>& spans);

}  // namespace seine::search
