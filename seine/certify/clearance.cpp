#include "seine/certify/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "seine/certify/tolerances.hpp"
#include "seine/geom/blocked.hpp"
#include "seine/geom/convex.hpp"

namespace seine::certify {
namespace {

using geom::Box;
using geom::Vec2;

class RobotClearance {
 public:
  RobotClearance(Context& context, const Scene& scene, int robot, double glimpsed)
      : context_(context),
        scene_(scene),
        robot_(robot),
        mover_(*scene.robots[static_cast<std::size_t>(robot)]),
        to_robots_(context, context.scenario.margins.robot),
        to_obstacles_(context, context.scenario.margins.obstacle) {
    // A little more than was glimpsed, so that the glimpsed pair is met again, with its time.
    to_robots_.closest = glimpsed + kClosestResolution + 1e-6;
    to_obstacles_.closest = std::max(kObstacleSearch, context.scenario.margins.obstacle) + kClosestResolution;
  }

  Clearances run() {
    find_when_free();
    against_grid_inside();
    against_static();
    to_obstacles_.require(context_.scenario.margins.obstacle);
    for (const MovingPart& part : scene_.moving) against(part);
    for (std::size_t j = static_cast<std::size_t>(robot_) + 1; j < scene_.robots.size(); ++j) {
      if (scene_.robots[j] != nullptr) against(*scene_.robots[j], static_cast<int>(j));
    }
    return std::move(out_);
  }

 private:
  double margin_of(Kind kind, double time) const {
    const world::Margins& margins = context_.scenario.margins;
    if (kind == Kind::robot_clearance) return margins.robot;
    const bool leaves = time < free_from_ && kind != Kind::moving_obstacle_clearance;
    return leaves ? margins.leaving.value_or(margins.obstacle) : margins.obstacle;
  }

  /// When a car that may start inside the margin first has all of it: looked at every kFreeStep. One that
  /// never gets out is judged as if it had to have it from the start.
  void find_when_free() {
    const world::Margins& margins = context_.scenario.margins;
    if (!(margins.leaving.value_or(margins.obstacle) < margins.obstacle)) return;
    std::vector<Vec2> placed(mover_.core.size());
    const double wanted = margins.obstacle - tolerance::kGapSeen * smallest_size(context_.scenario);
    std::size_t cell = 0;
    for (long step = 0;; ++step) {
      const double t = static_cast<double>(step) * kFreeStep;
      if (t > scene_.horizon || (step % 512 == 511 && context_.out_of_time())) return;
      while (cell + 1 < mover_.cells.size() && mover_.cells[cell].t1 < t) ++cell;
      mover_.place(mover_.cells[cell], t, placed);
      if (context_.map.distance(placed, wanted + 1.0) < wanted) continue;
      free_from_ = t;
      return;
    }
  }

  /// Calls prove(t0, t1) for what of a cell lies before the car is free and for what lies after, with the
  /// margin that holds there.
  template <class Prove>
  void in_parts(const Cell& cell, Prove&& prove) {
    const double cut = std::clamp(free_from_, cell.t0, cell.t1);
    if (cut > cell.t0) {
      to_obstacles_.require(margin_of(Kind::bounds, cell.t0));
      prove(cell.t0, cut);
    }
    to_obstacles_.require(context_.scenario.margins.obstacle);
    if (cut < cell.t1 || cut == cell.t0) prove(cut, cell.t1);
  }

  std::string name_of_other(Kind kind, int other) const {
    if (kind == Kind::robot_clearance) return context_.robot_name(other);
    if (kind == Kind::moving_obstacle_clearance) return context_.obstacle_name(other);
    return kind == Kind::bounds ? "the bounds" : context_.map.describe(other);
  }

  void report(Kind kind, int other, const Episodes& episodes) {
    for (const auto& e : episodes.all()) {
      const double margin = margin_of(kind, e.time);
      const auto [found, needed] = told_apart(e.value, margin);
      out_.findings.push_back({{kind, e.time, robot_, other, e.value, margin,
                                format("%s comes within %s m of %s at t = %.4f s; %s m is required",
                                       context_.robot_name(robot_).c_str(), found.c_str(),
                                       name_of_other(kind, other).c_str(), e.time, needed.c_str())},
                               margin - e.value});
    }
  }

  /// After each interval: keeps the closest approach, notes a broken margin, and an undecided one.
  void note(GapProof& proof, Closest& closest, Kind kind, int other, double t0, double t1,
            const std::optional<GapProof::Worst>& worst, Episodes& episodes) {
    if (proof.closest_changed) {
      closest = {proof.closest, proof.closest_time, robot_, kind == Kind::bounds ? -1 : other};
    }
    if (worst) episodes.offer(t0, t1, worst->time, worst->distance, margin_of(kind, t0) - worst->distance);
    if (!proof.undecided) return;
    out_.findings.push_back(
        {{Kind::undecided, *proof.undecided, robot_, other, proof.closest, margin_of(kind, t0),
          format("%s: its distance to %s could not be proved at t = %.4f s",
                 context_.robot_name(robot_).c_str(), name_of_other(kind, other).c_str(), *proof.undecided)},
         0.0});
    proof.undecided.reset();
  }

  void against(const MovingPart& part) {
    Episodes episodes;
    pair(to_obstacles_, out_.obstacles, part.mover, Kind::moving_obstacle_clearance, part.obstacle, episodes);
    report(Kind::moving_obstacle_clearance, part.obstacle, episodes);
  }

  void against(const Mover& other, int index) {
    Episodes episodes;
    pair(to_robots_, out_.robots, other, Kind::robot_clearance, index, episodes);
    report(Kind::robot_clearance, index, episodes);
  }

  void pair(GapProof& proof, Closest& closest, const Mover& other, Kind kind, int index, Episodes& episodes) {
    bool begun = false;
    for (int s = 0; s < scene_.slabs; ++s) {
      const auto slab = static_cast<std::size_t>(s);
      if (box_gap(mover_.slab_box[slab], other.slab_box[slab]) >= proof.wanted()) continue;
      if (!begun) proof.between(mover_, other);
      begun = true;
      const double end = s + 1 == scene_.slabs ? scene_.horizon : scene_.slab_begin(s + 1);
      auto a = static_cast<std::size_t>(mover_.slab_cell[slab]),
           b = static_cast<std::size_t>(other.slab_cell[slab]);
      for (double t = scene_.slab_begin(s); t < end;) {
        while (a + 1 < mover_.cells.size() && mover_.cells[a].t1 <= t) ++a;
        while (b + 1 < other.cells.size() && other.cells[b].t1 <= t) ++b;
        const Cell &cell_a = mover_.cells[a], &cell_b = other.cells[b];
        double until = std::min(cell_a.t1, cell_b.t1);
        if (!(until > t && until < end)) until = end;
        if (box_gap(cell_a.box, cell_b.box) < proof.wanted()) {
          const auto worst = proof.prove(cell_a, &cell_b, t, until);
          note(proof, closest, kind, index, t, until, worst, episodes);
        }
        t = until;
      }
    }
  }

  void against_static() {
    std::map<int, Episodes> pieces;
    Episodes walls;
    std::vector<const world::StaticMap::Piece*> near;
    std::size_t next = 0;
    for (int s = 0; s < scene_.slabs; ++s) {
      const Box& slab = mover_.slab_box[static_cast<std::size_t>(s)];
      near.clear();
      const double reach = to_obstacles_.wanted();
      context_.map.for_each_near(slab.inflated(std::max(reach, 0.0)),
                                 [&](const world::StaticMap::Piece& piece) {
                                   if (box_gap(slab, piece.box) < reach) near.push_back(&piece);
                                 });
      const bool by_wall = depth_inside(slab) < reach;
      const double end = s + 1 == scene_.slabs ? scene_.horizon : scene_.slab_begin(s + 1);
      for (; next < mover_.cells.size() && (mover_.cells[next].t0 < end || s + 1 == scene_.slabs); ++next) {
        const Cell& cell = mover_.cells[next];
        for (const auto* piece : near) against_piece(cell, *piece, pieces);
        if (by_wall) against_walls(cell, walls);
      }
    }
    for (const auto& [piece, episodes] : pieces) report(Kind::obstacle_clearance, piece, episodes);
    report(Kind::bounds, -1, walls);
  }

  void against_piece(const Cell& cell, const world::StaticMap::Piece& piece,
                     std::map<int, Episodes>& pieces) {
    if (box_gap(cell.box, piece.box) >= to_obstacles_.wanted()) return;
    const int index = static_cast<int>(&piece - context_.map.pieces().data());
    to_obstacles_.between(mover_, piece.shape.core, piece.shape.radius);
    in_parts(cell, [&](double t0, double t1) {
      const auto worst = to_obstacles_.prove(cell, nullptr, t0, t1);
      Episodes none;
      note(to_obstacles_, out_.obstacles, Kind::obstacle_clearance, index, t0, t1, worst,
           worst ? pieces[index] : none);
    });
  }

  void against_walls(const Cell& cell, Episodes& walls) {
    if (depth_inside(cell.box) >= to_obstacles_.wanted()) return;
    in_parts(cell, [&](double t0, double t1) {
      const auto worst = to_obstacles_.prove_inside(context_.map.bounds(), mover_, cell, t0, t1);
      note(to_obstacles_, out_.obstacles, Kind::bounds, -1, t0, t1, worst, walls);
    });
  }

  /// How far a box is inside the bounds, m.
  double depth_inside(const Box& box) const {
    const Box& bounds = context_.map.bounds();
    return std::min({box.low.x - bounds.low.x, box.low.y - bounds.low.y, bounds.high.x - box.high.x,
                     bounds.high.y - box.high.y});
  }

  /// The static map has only the rim of blocked areas; a car that starts wholly inside one never meets the
  /// rim.
  void against_grid_inside() {
    if (!context_.scenario.map) return;
    const geom::OccupancyGrid& grid = *context_.scenario.map;
    const Frame start = mover_.frame(mover_.cells.front(), 0.0);
    for (const Vec2 p : mover_.core) {
      if (!geom::is_blocked(grid, to_world(start, p))) continue;
      const double margin = context_.scenario.margins.obstacle;
      out_.findings.push_back(
          {{Kind::obstacle_clearance, 0.0, robot_, -1, 0.0, margin,
            format("%s stands in a blocked cell of the map at t = 0", context_.robot_name(robot_).c_str())},
           margin});
      return;
    }
  }

  Context& context_;
  const Scene& scene_;
  int robot_;
  const Mover& mover_;
  double free_from_ = 0.0;  // s: until then Margins::leaving holds to what stands still
  GapProof to_robots_, to_obstacles_;
  Clearances out_;
};

/// The cell of a mover at time t, looked for from its slab on.
const Cell& cell_at(const Mover& mover, int slab, double t) {
  auto i = static_cast<std::size_t>(mover.slab_cell[static_cast<std::size_t>(slab)]);
  while (i + 1 < mover.cells.size() && mover.cells[i].t1 < t) ++i;
  return mover.cells[i];
}

}  // namespace

double glimpse(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<Vec2> middle(scene.robots.size());
  std::vector<Vec2> a, b;
  for (int s = 0; s < scene.slabs; ++s) {
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
      if (scene.robots[i] != nullptr)
        middle[i] = scene.robots[i]->slab_box[static_cast<std::size_t>(s)].center();
    }
    double nearest = std::numeric_limits<double>::infinity();
    const Mover *first = nullptr, *second = nullptr;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
      if (scene.robots[i] == nullptr) continue;
      for (std::size_t j = i + 1; j < scene.robots.size(); ++j) {
        const double squared = geom::squared_norm(middle[i] - middle[j]);
        if (!(squared < nearest) || scene.robots[j] == nullptr) continue;
        nearest = squared, first = scene.robots[i], second = scene.robots[j];
      }
    }
    if (second == nullptr) break;
    const double t = scene.slab_begin(s) + 0.5 * scene.horizon / scene.slabs;
    a.resize(first->core.size()), b.resize(second->core.size());
    first->place(cell_at(*first, s, t), t, a);
    second->place(cell_at(*second, s, t), t, b);
    least = std::min(least, geom::distance(a, b) - first->radius - second->radius);
  }
  return least;
}

Clearances prove_clearances(Context& context, const Scene& scene, int robot, double glimpsed) {
  return RobotClearance(context, scene, robot, glimpsed).run();
}

}  // namespace seine::certify
