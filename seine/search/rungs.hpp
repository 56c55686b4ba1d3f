#pragma once

namespace seine::search {

/// Car lengths: the room beyond the clearance that searches like to keep.
inline constexpr double kSearchSlack = 0.025;

/// What the heuristic of a rung says about gaps.
enum class Gaps {
  quick,  // on the coarse grid: a gap too narrow by a fifth of a car's width may look open
  wary,   // on the fine grid; gaps only just wide enough for the car are dear, which pays when they turn out
          // to be too narrow
  exact,  // on the fine grid
};

/// One rung of the ladder of searches, from coarse and quick to fine and patient. The defaults are for open
/// ground: a dozen expansions where the straight shot is blocked.
struct Rung {
  double radius = 1.1;                // of the smallest turning radius
  double step = 0.8, min_step = 0.8;  // turning radii
  bool until_blocked = false;         // moves end where they are blocked
  double cell = 0.45;                 // turning radii
  int headings = 24;
  bool gears_apart = false;
  int forward = 5, backward = 3;
  double slack = 1.0;         // of the full slack
  double gear_change = 2.0;   // turning radii
  double slow_reverse = 0.0;  // of what a slow reverse gear costs more in time than usual
  double share = 0.02;        // of the expansions allowed
  Gaps gaps = Gaps::quick;
  bool for_slots = false;
  bool from_tighter_end = false;  // the way out of a tight place is easier to find than the way in
  // Where this rung finds nothing, ways through the middle of narrow places are tried that leave at most so
  // much room, car lengths.
  double gates_after = 0.0;
  // … and single words without slack, wide ones too: along walls that are touched.
  bool words_after = false;
};
/// @param share  of the expansions;  @param gates_after  see above
constexpr Rung parking(double share, double gates_after = 0.0) {
  return {.radius = 1.02,
          .step = 0.4,
          .min_step = 0.4,
          .cell = 0.2,
          .headings = 36,
          .backward = 5,
          .slack = 0.2,
          .gear_change = 0.5,
          .share = share,
          .gaps = Gaps::exact,
          .from_tighter_end = true,
          .gates_after = gates_after};
}
/// What is climbed until a way is found.
inline constexpr Rung kLadder[] = {
    {},
    // Buildings where the shortest way turns out to be too narrow.
    {.share = 0.03, .gaps = Gaps::wary, .gates_after = 0.2 * kSearchSlack, .words_after = true},
    // Parking, narrow doors.
    parking(0.05, 1.0),
    // Slots between two cars: forth and back as far as it goes.
    {.radius = 1.03,
     .step = 2.0,
     .min_step = 0.01,
     .until_blocked = true,
     .cell = 0.04,
     .headings = 120,
     .gears_apart = true,
     .forward = 3,
     .slack = 0.1,
     .gear_change = 0.2,
     .share = 0.1,
     .gaps = Gaps::exact,
     .for_slots = true,
     .from_tighter_end = true},
    // The third for longer.
    parking(0.3),
    // Slots that take a dozen moves of a few centimetres.
    {.radius = 1.0,
     .step = 0.2,
     .min_step = 0.002,
     .cell = 0.006,
     .headings = 500,
     .gears_apart = true,
     .forward = 3,
     .slack = 0.02,
     .gear_change = 0.05,
     .share = 0.6,
     .gaps = Gaps::exact,
     .for_slots = true,
     .from_tighter_end = true},
    // The second once more, for as long as it takes.
    {.share = 1.0, .gaps = Gaps::wary},
};

/// Rungs on open ground for other tastes: little in a slow reverse gear, few gear changes, wide turns.
inline constexpr Rung kHurried[] = {
    {.slow_reverse = 1.0},
    {.gear_change = 8.0},
    {.radius = 2.0, .step = 0.6, .min_step = 0.6, .cell = 0.3, .gear_change = 2.0},
};

}  // namespace seine::search
