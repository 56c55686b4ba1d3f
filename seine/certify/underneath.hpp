#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "seine/certify/clearance.hpp"
#include "seine/certify/formation.hpp"
#include "seine/certify/height.hpp"
#include "seine/certify/report.hpp"

namespace seine::certify {

/// Proves that nothing stands in the net: wherever a convex part of an obstacle overlaps the polygon of the
/// attachments, the net's lowest point clears it. What is left is the larger of the distance beside it and of
/// the height above it; either, bounded on a slice, proves the slice.
///
/// Beside: for any fixed unit vector n each n·(b − a_k) leaves its chord by at most ⅛ (bend_k + bend_b) w²,
/// so the smaller gap along n at the ends, less that, is a lower bound of the distance. Above: Height::least.
class UnderneathProof {
 public:
  /// @param lowest a lower bound of the net's height over the whole plan, m: obstacles that it clears are not
  /// looked at
  UnderneathProof(Context& context, const Formation& formation, Height& height, double lowest);

  void run(const Scene& scene);
  std::vector<Finding> take_findings() { return std::move(findings_); }
  /// The least room, m, found to within kHeightResolution where it is less than kNetSearch.
  const Closest& closest() const { return closest_; }

 private:
  using StaticMap = world::StaticMap;
  static constexpr int kDeepest = 40;
  /// The other body while one obstacle's part is looked at.
  struct Other {
    std::span<const geom::Vec2> fixed;  ///< where it stands still
    const Mover* mover = nullptr;
    const Cell* cell = nullptr;
    double radius = 0.0;  ///< m
    double needed = 0.0;  ///< m above ground for the net's lowest point; infinite: it cannot pass over
  };
  struct Placed {
    std::vector<geom::Vec2> net, other;
  };
  struct Broken {
    double time = 0.0;  ///< s
    double room = std::numeric_limits<double>::infinity();
  };

  bool passes_under(double height) const;
  void against_block(std::span<const Beat> block);
  void against(const StaticMap::Piece& piece, std::span<const Beat> block);
  void starts_inside();
  void against(const MovingPart& part);
  void against(const MovingPart& part, const Cell& cell, const Slice& slice, Episodes& episodes);

  /// The worst instant when the slice breaks it.
  std::optional<Broken> prove(const Slice& slice, const Other& other);
  void refine(const Slice& slice, const Placed& from, const Placed& to, int depth);
  /// @param end one end of the slice; the other is where the bodies are `distance` apart along normal_
  bool keeps(const Slice& slice, const Placed& end, double distance);
  double gap_along(geom::Vec2 normal, const Placed& at) const;
  void place_other(double t, Placed& out) const;
  void met(double room, double time);
  bool give_up(double time, int depth);
  double wanted() const;
  Placed& level(int depth) {
    Placed& placed = levels_[static_cast<std::size_t>(depth)];
    placed.net.resize(formation_.size());
    return placed;
  }

  void report(int other, const std::string& name, double height, const Episodes& episodes);
  void report_undecided(int other, const std::string& name);

  Context& context_;
  const Formation& formation_;
  Height& height_;
  double lowest_;     // m
  double clearance_;  // m
  Closest closest_;
  bool closest_changed_ = false;  // by the last `prove`
  Other other_;
  geom::Vec2 normal_;  // the last one that parted the net from this body; zero: none yet
  Broken worst_{};
  int steps_ = 0;
  long steps_in_all_ = 0;
  std::optional<double> undecided_;
  std::vector<Placed> levels_;
  std::map<int, Episodes> pieces_;
  std::vector<Finding> findings_;
};

}  // namespace seine::certify
