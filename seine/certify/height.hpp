#pragma once

#include <span>
#include <vector>

#include "seine/certify/formation.hpp"
#include "seine/certify/report.hpp"

namespace seine::certify {

/// How high above the ground the lowest point of a net hangs, at an instant and at least on a slice.
///
/// No point of the cloth hangs deeper than the place of a load, whether there is one or not: D counts for an
/// empty net, too. It depends on the distances of the attachments only, and D² grows from one shape to
/// another by at most ½ (1 − 1/N) times the largest decrease of a squared distance (docs/certificate.md
/// proves it): shapes that have been computed serve for all that are alike.
class Height {
 public:
  explicit Height(const net::Net& net);

  /// m above ground; the shape is remembered.
  double at(std::span<const geom::Vec2> attachments);
  /// A lower bound on the slice, m.
  double least(const Slice& slice);
  /// How far the shape may change from the end of a slice, on which `least` was found, until the
  /// height can fall to `wanted`, m; negative when it may have already.
  double reserve(const Slice& slice, double least, double wanted) const;

 private:
  struct Pair {
    std::size_t i, j;
  };
  struct Shape {
    double squared_depth;
    std::vector<double> squares;  ///< of the distances of all pairs, m²
  };
  static constexpr std::size_t kMostShapes = 8;

  double depth_squared() const;

  const net::Net& net_;
  double share_;  // ½ (1 − 1/N)
  std::vector<Pair> pairs_;
  std::vector<double> least_squares_;  // of the slice at hand
  std::vector<Shape> shapes_;
  std::size_t next_ = 0;
};

/// Proves that the net never drags: its lowest point keeps `clearance` above the ground.
class DragProof {
 public:
  DragProof(Context& context, const Formation& formation, Height& height);

  void run();
  std::vector<Finding> findings() const;
  /// Where the lowest point is lowest: what is left above the clearance, m, found to within
  /// kHeightResolution.
  const Closest& closest() const { return closest_; }

 private:
  static constexpr int kDeepest = 40;

  void glimpse();
  void look(const Slice& slice, std::span<const geom::Vec2> at, double time);
  double wanted() const;
  bool keeps(const Slice& slice);
  void refine(const Slice& slice, int depth);

  Context& context_;
  const Formation& formation_;
  Height& height_;
  double clearance_;
  double worst_ = 0.0;   // room in the beat at hand; 0 when it does not drag
  double lasts_ = -1.0;  // m: up to this Beat::strayed_within the height need not be looked at
  Closest closest_;
  Episodes episodes_;
  std::vector<Finding> undecided_;
  std::vector<std::vector<geom::Vec2>> levels_;
  int steps_ = 0;
};

}  // namespace seine::certify
