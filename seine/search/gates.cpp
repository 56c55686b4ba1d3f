#include "seine/search/gates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "seine/geom/convex.hpp"

namespace seine::search {
namespace {

constexpr double kNarrow = 0.2;   // car widths of room for the disc on either side: less is a narrow place
constexpr double kThin = 0.2;     // of the width: the body whose room says where the middle of a gap is
constexpr double kReach = 0.8;    // car widths: how far off the disc's way the middle may lie
constexpr int kHeadings = 24;     // tried over half a turn
constexpr double kFinest = 1e-5;  // car widths, and radians: where the search for the middle ends
constexpr std::size_t kMost = 6;  // gates of one way

/// The disc's way from a point to the goal, cell by cell; empty when there is none.
std::vector<geom::Vec2> disc_way(CostToGo& to_go, const PointDistances& grid, geom::Vec2 from,
                                 geom::Vec2 to) {
  std::vector<geom::Vec2> cells;
  int column = grid.column(from.x), row = grid.row(from.y);
  double here = to_go(from);
  if (here == std::numeric_limits<double>::infinity()) return {};
  while (column != grid.column(to.x) || row != grid.row(to.y)) {
    cells.push_back(grid.middle(column, row));
    int next_column = column, next_row = row;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (!grid.inside(column + dx, row + dy)) continue;
        const double there = to_go(grid.middle(column + dx, row + dy));
        if (there < here) here = there, next_column = column + dx, next_row = row + dy;
      }
    if (next_column == column && next_row == row) return {};
    column = next_column, row = next_row;
  }
  cells.push_back(to);
  return cells;
}

/// Fits a body into the middle of a narrow place.
class Middle {
 public:
  Middle(const world::StaticMap& map, const vehicle::Model& model)
      : map_(map), width_(model.width()), length_(model.length()), whole_(model.footprint) {
    const geom::Box box = geom::bounding_box(whole_);
    middle_ = 0.5 * (box.low + box.high);
    for (const geom::Vec2 corner : whole_)
      thin_.push_back({corner.x, middle_.y + kThin * (corner.y - middle_.y)});
    placed_.resize(whole_.size());
  }

  /// The pose with the most room around `near`, heading within a right angle of `along`.
  geom::Pose2 fit(geom::Vec2 near, double along) {
    double best = -1.0, heading = along;
    for (int i = 0; i < kHeadings; ++i) {
      const double tried = along + std::numbers::pi * ((i + 0.5) / kHeadings - 0.5);
      for (const double aside : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
        const geom::Vec2 at = near + aside * width_ * geom::unit(tried + 0.5 * std::numbers::pi);
        if (const double room = room_at(thin_, at, tried); room > best)
          best = room, heading = tried, at_ = at;
      }
    }
    if (best < 0.0) return pose(near, along);
    refine(near, heading, best);
    return pose(at_, heading);
  }

  /// Of the whole footprint; negative when it does not fit.
  double room(const geom::Pose2& at, double clearance) {
    geom::place(whole_, at, placed_);
    return map_.distance(placed_, clearance + width_) - clearance;
  }

 private:
  geom::Pose2 pose(geom::Vec2 middle, double heading) const {
    const geom::Pose2 turned{0.0, 0.0, heading};
    const geom::Vec2 axle = middle - turned * middle_;
    return {axle.x, axle.y, geom::wrap_angle(heading)};
  }
  double room_at(const std::vector<geom::Vec2>& body, geom::Vec2 middle, double heading) {
    geom::place(body, pose(middle, heading), placed_);
    return map_.distance(placed_, 2.0 * width_);
  }

  /// Pattern search over the offset aside and the heading: the room is the smallest of several distances and
  /// has no gradient at its maximum.
  void refine(geom::Vec2 near, double& heading, double& best) {
    for (double step = 0.1; step > kFinest;) {
      bool better = false;
      for (int aside = -1; aside <= 1; ++aside)
        for (int turn = -1; turn <= 1; ++turn) {
          const double tried = heading + turn * step * width_ / length_;
          const geom::Vec2 at = at_ + (aside * step * width_) * geom::unit(tried + 0.5 * std::numbers::pi);
          if (geom::norm(at - near) > kReach * width_) continue;
          const double room = room_at(thin_, at, tried);
          if (room > best + 1e-12) best = room, heading = tried, at_ = at, better = true;
        }
      if (!better) step *= 0.5;
    }
  }

  const world::StaticMap& map_;
  double width_, length_;
  std::vector<geom::Vec2> whole_, thin_, placed_;
  geom::Vec2 middle_, at_;
};

}  // namespace

std::vector<Gate> gates_between(const world::StaticMap& map, const vehicle::Model& model, CostToGo& to_go,
                                const DiscWay& way, geom::Vec2 reference, const geom::Pose2& start,
                                const geom::Pose2& goal, double clearance) {
  const PointDistances& grid = *way.distances;
  const std::vector<geom::Vec2> cells = disc_way(to_go, grid, start * reference, goal * reference);
  const double narrow = way.radius + kNarrow * model.width();
  const auto distance = [&](std::size_t i) { return grid.at(grid.column(cells[i].x), grid.row(cells[i].y)); };
  // Ends that are narrow themselves are not passed through.
  const auto ends_at = [&](std::size_t i) {
    return std::min(geom::norm(cells[i] - cells.front()), geom::norm(cells[i] - cells.back())) <
           0.5 * model.length();
  };
  Middle middle(map, model);
  std::vector<Gate> gates;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (distance(i) >= narrow) continue;
    std::size_t last = i;
    double least = std::numeric_limits<double>::infinity();
    for (; last < cells.size() && distance(last) < narrow; ++last) least = std::min(least, distance(last));
    // The middle of the narrowest part of it.
    std::vector<std::size_t> narrowest;
    for (std::size_t k = i; k < last; ++k)
      if (distance(k) < least + grid.cell()) narrowest.push_back(k);
    const std::size_t at = narrowest[narrowest.size() / 2];
    i = last;
    if (ends_at(at)) continue;
    const std::size_t ahead = std::min(at + 3, cells.size() - 1), behind = at < 3 ? 0 : at - 3;
    const geom::Vec2 along = cells[ahead] - cells[behind];
    const geom::Pose2 pose = middle.fit(cells[at], std::atan2(along.y, along.x));
    const double room = middle.room(pose, clearance);
    if (room > kNarrow * model.width()) continue;  // the way only kept close to one side
    if (room < 0.0 || gates.size() == kMost) return {};
    gates.push_back({pose, room});
  }
  return gates;
}

}  // namespace seine::search
