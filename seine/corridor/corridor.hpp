#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "seine/geom/pose2.hpp"
#include "seine/vehicle/model.hpp"
#include "seine/world/static_map.hpp"

namespace seine::corridor {

struct Options {
  double reach = 0.6;       ///< m from the footprint: what is further away bounds nothing
  double clearance = 0.05;  ///< m, kept between the region and every obstacle and the bounds
  int max_planes = 24;      ///< a sample
};

/// For each pose of a guess a convex region about the footprint: n·x ≤ b for all planes of the sample. No
/// point of the region is nearer than `clearance` to a piece of the map that is within `reach` of the
/// footprint there, nor to a near wall of the bounds. Each plane is the one of the largest gap between the
/// footprint and a piece (perpendicular to their nearest points, so along a face where a face is nearest): of
/// all planes it leaves the car the most room. Where the guess does not keep the clearance the plane stands
/// all the same and `depth` says how far the footprint is over it.
struct Corridor {
  std::vector<int>
      begin;  ///< samples + 1; planes begin[i] … begin[i+1] − 1 belong to sample i, nearest obstacle first
  std::vector<double> nx, ny;  ///< unit outward normal of each plane
  std::vector<double> b;       ///< m, the clearance already taken off
  std::vector<double> depth;   ///< m per sample: furthest footprint vertex beyond a plane; 0 when the
                               ///< footprint is in the region
  std::vector<int> left_out;  ///< per sample: pieces within reach that max_planes left unbounded; 0 unless it
                              ///< was too small

  std::size_t samples() const { return depth.size(); }
  /// Whether any plane belongs to a sample; samples that are not there have none.
  bool bounds(std::size_t sample) const {
    return sample + 1 < begin.size() && begin[sample] < begin[sample + 1];
  }
};

Corridor build(std::span<const geom::Pose2> poses, const vehicle::Model& model, const world::StaticMap& map,
               const Options& options);

}  // namespace seine::corridor
