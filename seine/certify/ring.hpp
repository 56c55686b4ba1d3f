#pragma once

#include <array>
#include <vector>

#include "seine/certify/formation.hpp"
#include "seine/certify/report.hpp"

namespace seine::certify {

/// Proves size and shape of a net: no two attachments further apart than the cloth allows, the ring convex
/// and counter-clockwise with a margin, wide open after a catch, and such that a load stays in.
///
/// Each rule has a room, what is left of it: negative when broken. It is bounded from below on the beats
/// (slice_bounds.hpp); what is not proved is halved.
class RingProof {
 public:
  RingProof(Context& context, const Formation& formation);

  void run();
  std::vector<Finding> findings() const;

  /// The least room of the pairs and of the ring's corners, m, each found to within kNetResolution.
  const Closest& stretch() const { return closest_[pair]; }
  const Closest& convexity() const { return closest_[corner]; }
  /// The least holding reserve while something lies in the net, m², to within kReserveResolution.
  const Closest& holding() const { return closest_[hold]; }

 private:
  enum Sort { pair, corner, open, hold, kSorts };
  struct Rule {
    Sort sort;
    std::size_t i = 0, j = 0;  ///< a pair, or the ring edge i → j …
    std::size_t other = 0;     ///< … and an attachment that is no end of it
    double limit = 0.0;        ///< m of distance or height; least opening; m², all slack there can be
    double worst = 0.0;        ///< room in the beat at hand; 0 when none is broken
    double lasts = -1.0;       ///< m: up to this Beat::strayed_within nothing about it need be looked at
    bool undecided = false;    ///< somewhere
    double undecided_time = 0.0;
    Episodes episodes;
  };
  using Rules = std::vector<std::size_t>;
  struct Level {
    std::vector<geom::Vec2> middle;
    Rules open;
  };
  static constexpr int kDeepest = 40;

  void add(Rules& list, Rule rule);
  void add_pairs_and_corners();
  void add_holding();
  void check_start();
  void glimpse();
  const Rules& rules_on(const Beat& beat) const;
  double room(const Rule& rule, std::span<const geom::Vec2> at) const;
  /// Whether the room is at least `wanted` throughout the slice.
  bool keeps(const Rule& rule, const Slice& slice, double wanted) const;
  double wanted(const Rule& rule) const;
  /// @return the room there
  double look(Rule& rule, const Slice& slice, std::span<const geom::Vec2> at, double time);
  /// How far the shape may change from `at` while the room stays above the least one met so far, m.
  double reserve(const Rule& rule, std::span<const geom::Vec2> at, double room) const;
  /// Of `rules`, those not proved on the slice.
  void unproved(const Rules& rules, const Slice& slice, Rules& open);
  void refine(const Rules& rules, const Slice& slice, int depth);
  void give_up(const Rules& rules, double time);
  Finding finding(const Rule& rule, const Episodes::Episode& episode) const;
  std::string name(const Rule& rule) const;

  Context& context_;
  const net::Net& net_;
  const Formation& formation_;
  double rest_area_;  // m²
  std::vector<Rule> rules_;
  Rules always_, while_loaded_, while_held_;
  std::array<Closest, kSorts> closest_;
  std::vector<Level> levels_;
  Rules due_;  // of the beat at hand
  std::vector<Finding> start_;
  int steps_ = 0;
};

}  // namespace seine::certify
