#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/search/path.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::search {

/// A team that moves as one: every car copies the way of a common frame, shifted by its own offset. Same
/// heading, same curvature, same speed for all, so the way is exactly drivable and the net keeps its shape
/// (docs/net-planning.md). The frame stands at the mean of the rear axles.
struct Formation {
  std::vector<geom::Vec2> offsets;  ///< of each car's rear axle from the frame, world axes, m
  double lowest = 0.0;              ///< m above the ground: what hangs lowest in this shape
  std::optional<geom::Vec2> along;  ///< unit: a shape for driving through narrow places in this direction
};

/// Something low enough for the net to pass over when it hangs high enough.
struct LowPiece {
  geom::Convex shape;
  double height = 0.0;  ///< m, with the clearance asked for
};

/// Somewhere the middle of the net has to be on its way, at a given time.
struct Rendezvous {
  geom::Vec2 point;
  double reach = 0.25;                                      ///< m: how near the middle must pass
  double time = 0.0;                                        ///< s, common clock
  double onward = std::numeric_limits<double>::infinity();  ///< m/s: no faster from there on
};

/// Where a formation's way may end.
struct FormationGoal {
  geom::Vec2 center;  ///< of the net's middle
  double radius = 0.35;
  std::optional<double> heading;  ///< rad
  double heading_tolerance = 0.15;
  bool exact = false;  ///< ways straight to it end in its very middle, with its very heading
};

struct FormationProblem {
  const world::Scenario* scenario = nullptr;
  const world::StaticMap* map = nullptr;   ///< what the cars keep clear of
  const world::StaticMap* tall = nullptr;  ///< what the net must not hang over
  geom::Pose2 start;                       ///< of the frame
  double start_speed = 0.0;                ///< m/s, signed
  /// The first is held at the start, at every rendezvous and for `hold` metres after it; the others only
  /// where the first does not pass.
  std::vector<Formation> shapes;
  double hold = 0.0;    ///< m
  double change = 3.0;  ///< m over which the formation changes from one shape to the next
  std::vector<LowPiece> low;
  std::vector<Rendezvous> meetings;   ///< in order of time
  std::optional<FormationGoal> goal;  ///< absent: stop anywhere after the last rendezvous
  Deadline deadline;
};

struct FormationSettings {
  int max_expansions = 20000;
  int patience = std::numeric_limits<int>::max();  ///< expansions in a row that come no nearer, at most
  double heuristic_weight = 1.3;
  double step = 0.8;  ///< car lengths
  /// Of poses nearer than this only the cheapest goes on: car lengths, and shares of a turn (at most 64).
  double cell = 0.5;
  int headings = 32;
  bool forward = true, backward = true;  ///< gears it may drive in
  /// Only a way straight to the goal, and one of at least this length, car lengths: where cars have to change
  /// places they need room for it. Absent: any way.
  std::optional<double> straight_to_goal;
  bool wait_at_start = true;  ///< until what can be met there has been met
  bool field = false;         ///< distances to go around what is tall, instead of as the crow flies
};

/// A way of the frame, where on it each rendezvous is passed, and which shape is held from where on.
struct FormationPath {
  struct Shape {
    double begin, s;  ///< m driven: changed to between these, held from then on
    int shape;
  };
  Path path;
  std::vector<double> meeting_s;  ///< m driven
  std::vector<Shape> shapes;      ///< begins with the first shape at 0
  int expansions = 0;
};

/// Offsets on the way from one shape to another. @param share of the way, 0 … 1, smooth at both ends
void between(const Formation& from, const Formation& to, double share, Formation& out);

class FormationGround;

/// Hybrid A* over (x, y, θ, rendezvous passed) for the whole formation: every footprint keeps its distance to
/// everything, the net to what is tall, also while the shape changes. The cost is time. Deterministic.
class FormationSearch {
 public:
  /// What the problem points to must outlive this.
  explicit FormationSearch(FormationProblem problem);
  ~FormationSearch();

  const FormationProblem& problem() const { return *problem_; }
  /// More shapes for where the first does not pass.
  void offer(std::vector<Formation> narrow);
  void set_hold(double metres) { problem_->hold = metres; }
  std::optional<FormationPath> find(const FormationSettings& settings);

 private:
  std::unique_ptr<FormationProblem> problem_;
  std::unique_ptr<FormationGround> ground_;
  bool ways_known_ = false;
};

/// When the frame is where: as fast as the limits of all cars allow, but not before its time at a rendezvous;
/// it drives slower rather than waits.
struct FormationTiming {
  double wait = 0.0;  ///< s at the start, where something is met there; the profile begins after it
  std::vector<ProfileKnot> profile;
  double slack = std::numeric_limits<double>::infinity();  ///< s: by how much the fastest passage would be
                                                           ///< early at the tightest rendezvous; < 0: late
};
FormationTiming time_formation(const FormationPath& path, const FormationProblem& problem);

/// Offsets of the cars as they stand at the start, and the frame there.
geom::Pose2 formation_frame(const world::Scenario& scenario);
Formation start_formation(const world::Scenario& scenario);
/// Attachments of a formation whose frame is at `frame`.
void attachments_at(const world::Scenario& scenario, const Formation& formation, const geom::Pose2& frame,
                    std::vector<geom::Vec2>& out);

}  // namespace seine::search
