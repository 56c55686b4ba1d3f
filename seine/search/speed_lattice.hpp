#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "seine/search/path.hpp"
#include "seine/search/path_cursor.hpp"
#include "seine/search/swept_footprint.hpp"
#include "seine/vehicle/model.hpp"

namespace seine::search {

/// How much of a car's limits the speed lattice uses. The rest is room for the optimiser, which replaces the
/// jumps of the acceleration by smooth polynomials that need a little more than the mean.
struct LatticeOptions {
  double speed_factor = 0.96;         ///< of both speed limits
  double acceleration_factor = 0.85;  ///< of the longitudinal limit
  double lateral_factor = 0.90;       ///< of the lateral limit
  double units_per_length =
      35.0;                 ///< wanted lattice units in a car's length: fixes the number of speed levels
  double least_unit = 0.0;  ///< m: ways of many kilometres have units no smaller than this
};

/// The lattice of one kind of car. Time goes in steps Δt, speed in K levels k·aΔt, the way in units u =
/// aΔt²/2, the acceleration is one of −a, 0, +a: then a step from (s, k) leads to (s + 2k + j, k + j), j ∈
/// {−1, 0, 1}, in integers and exactly.
struct SpeedGrid {
  double speed = 0.0;          ///< m/s, reduced limits
  double reverse_speed = 0.0;  ///< m/s
  double acceleration = 0.0;   ///< m/s²
  double lateral = 0.0;        ///< m/s², may be infinite
  int levels = 0;              ///< K: the top speed is level K
  double step = 0.0;           ///< Δt = speed / (K a), s
  double unit = 0.0;           ///< u, m

  double half_step() const { return 0.5 * step; }
};
SpeedGrid speed_grid(const vehicle::Model& model, const LatticeOptions& options = {});

/// A path cut into lattice units: what speed is allowed where, and the ground the car covers there. Units are
/// counted from 0 (start) to `units` (goal). Each stretch in one gear has its own unit, scaled down a little
/// so that a whole number fits: an even one, because s + k keeps its parity and the car must be able to stop
/// exactly at the end.
class SpeedLattice {
 public:
  /// @param start_speed signed m/s; a moving car first brakes for one step to the next lower lattice speed.
  /// @param careful  slow in bends and tested unit by unit: the ground the car is thought to cover is then
  /// little more than it is, which is what narrow places need
  SpeedLattice(Path path, const SpeedGrid& grid, const SweptFootprint& footprint, double start_speed = 0.0,
               bool careful = false);

  /// A group of neighbouring units that is tested as one; the ends are groups of their own, so that cars that
  /// stand close do not seem to collide.
  struct Group {
    int first, last;  ///< units, inclusive
    geom::Box box;    ///< of its polygon
    OrientedBox turned;
  };
  struct Chunk {
    geom::Box box;
    int first, last;  ///< groups, [first, last)
  };

  bool drivable() const {
    return drivable_;
  }  ///< false: wrong gear for the start speed, no reverse speed, too short to stop
  const Path& path() const { return path_; }
  const SpeedGrid& grid() const { return grid_; }
  int units() const { return units_; }
  int words() const { return words_; }
  int start_level() const { return start_level_; }
  int start_step() const { return start_level_ > 0 || stub_ ? 1 : 0; }  ///< time steps before unit 0
  double start_speed() const { return start_speed_; }                   ///< m/s, unsigned
  double s_at(int unit) const { return s_[static_cast<std::size_t>(unit)]; }
  /// Speed of a level on the stretch that ends (`before`) or begins at this unit, m/s.
  double speed_at(int unit, int level) const;
  /// Units from which the move (level, change) is allowed, as bits: it lands on an allowed speed, and no
  /// limit is broken on the way.
  const std::uint64_t* moves(int level, int change) const {
    return &moves_[static_cast<std::size_t>((level * 3 + change + 1) * words_)];
  }
  /// By tick (half time steps): the furthest unit where the car can be tested by then. It ends when the goal
  /// can be reached: no plan takes fewer ticks than it has entries.
  std::vector<int> reach() const;
  /// The first unit from which the goal may be reached within so many ticks: from those before it, it cannot.
  int hopeless(int ticks) const;
  std::span<const Group> groups() const { return groups_; }
  std::span<const Chunk> chunks() const { return chunks_; }
  std::span<const geom::Vec2> polygon(std::size_t group) const {
    return {&polygons_[group * corners_], corners_};
  }
  const geom::Box& box() const { return box_; }
  bool boxes() const { return boxes_; }  ///< the polygons are the turned boxes

 private:
  struct Stretch {
    int first, last;  // units
    double begin, unit;
    int gear;
  };
  void cut_stretches(double start_speed);
  bool add_stretch(double begin, double end, int gear, double slowest);
  void limit_speeds();
  void slow_in_bends();
  void reach_speeds();
  double quickest_over(int b) const;
  void build_moves();
  void build_groups(const SweptFootprint& footprint);
  void stay_on_the_way(int first, int last, double middle, Slack& slack) const;
  void add_group(const SweptFootprint& footprint, int first, int last, PathCursor& cursor);

  Path path_;
  SpeedGrid grid_;
  bool drivable_ = true;
  bool stub_ = false;
  bool careful_ = false;
  int units_ = 0, words_ = 0, start_level_ = 0;
  double start_speed_ = 0.0;
  std::vector<Stretch> stretches_;
  std::vector<double> s_;            // m, per unit
  std::vector<double> curvature_;    // 1/m, per unit, largest within one unit
  std::vector<double> allowed_;      // levels, per unit: what limits and curvature allow
  std::vector<double> attainable2_;  // levels², per unit: with the acceleration limit as well
  std::vector<double> left_;         // ticks, per unit: no drive from there to the goal takes fewer
  std::vector<std::uint64_t> moves_;
  std::vector<Group> groups_;
  std::vector<Chunk> chunks_;
  std::vector<geom::Vec2> polygons_;
  std::size_t corners_ = 0;
  geom::Box box_;
  bool boxes_ = false;
};

}  // namespace seine::search
