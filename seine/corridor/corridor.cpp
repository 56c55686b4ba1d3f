#include "seine/corridor/corridor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "seine/geom/box.hpp"
#include "seine/geom/convex.hpp"

namespace seine::corridor {
namespace {

using geom::Box;
using geom::Vec2;
using Piece = world::StaticMap::Piece;

constexpr double kRounding = 1e-9;  // m

struct Plane {
  Vec2 normal;
  double b;
};

// A piece that may matter. At first only the gap of the boxes is known: it is not more than the distance, so
// a piece is measured only when it is its turn.
struct Candidate {
  const Piece* piece;
  double distance;
  bool measured = false;
  Vec2 normal{};
};

// Not more than the distance; boxes that overlap say nothing.
double box_bound(const Box& a, const Box& b) {
  const double dx = std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0});
  const double dy = std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0});
  const double squared = dx * dx + dy * dy;
  return squared > 0.0 ? std::sqrt(squared) : -std::numeric_limits<double>::infinity();
}

double support(std::span<const Vec2> points, Vec2 direction) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vec2 p : points) largest = std::max(largest, geom::dot(direction, p));
  return largest;
}

double nearest_along(const geom::Convex& shape, Vec2 normal) {
  return -support(shape.core, -normal) - shape.radius;
}

class Builder {
 public:
  Builder(const vehicle::Model& model, const world::StaticMap& map, const Options& options,
          std::size_t samples)
      : body_(model.footprint), map_(map), options_(options), footprint_(model.footprint) {
    out_.begin.reserve(samples + 1);
    out_.begin.push_back(0);
    out_.depth.reserve(samples);
    out_.left_out.reserve(samples);
  }

  void add(const geom::Pose2& pose) {
    geom::place(body_, pose, footprint_);
    box_ = geom::bounding_box(footprint_);
    depth_ = 0.0;
    planes_.clear();
    gather();
    add_bounds();
    add_pieces();
    for (const Plane& plane : planes_) {
      out_.nx.push_back(plane.normal.x);
      out_.ny.push_back(plane.normal.y);
      out_.b.push_back(plane.b);
    }
    out_.begin.push_back(static_cast<int>(out_.b.size()));
    out_.depth.push_back(depth_);
    out_.left_out.push_back(static_cast<int>(candidates_.size()));
  }

  Corridor take() { return std::move(out_); }

 private:
  void gather() {
    candidates_.clear();
    map_.for_each_near(box_.inflated(options_.reach), [this](const Piece& piece) {
      const double bound = box_bound(box_, piece.box);
      if (bound <= options_.reach) candidates_.push_back({&piece, bound});
    });
  }

  void add_bounds() {
    const Box& bounds = map_.bounds();
    const double reach = options_.reach;
    if (box_.low.x - bounds.low.x <= reach) add_plane({{-1.0, 0.0}, -bounds.low.x - options_.clearance});
    if (bounds.high.x - box_.high.x <= reach) add_plane({{1.0, 0.0}, bounds.high.x - options_.clearance});
    if (box_.low.y - bounds.low.y <= reach) add_plane({{0.0, -1.0}, -bounds.low.y - options_.clearance});
    if (bounds.high.y - box_.high.y <= reach) add_plane({{0.0, 1.0}, bounds.high.y - options_.clearance});
  }

  // Nearest first: its plane may put what is behind it out of question.
  void add_pieces() {
    while (!candidates_.empty() && static_cast<int>(planes_.size()) < options_.max_planes) {
      const auto nearest = std::min_element(
          candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
            return a.distance < b.distance || (a.distance == b.distance && a.piece < b.piece);
          });
      if (nearest->measured) {
        const geom::Convex& shape = nearest->piece->shape;
        const Vec2 normal = nearest->normal;
        add_plane({normal, nearest_along(shape, normal) - options_.clearance});
      } else {
        measure(*nearest);
        if (nearest->distance > options_.reach) drop(*nearest);
      }
    }
  }

  void measure(Candidate& candidate) const {
    const geom::Convex& shape = candidate.piece->shape;
    const geom::Separation separation = geom::separation(footprint_, std::span<const Vec2>(shape.core));
    candidate.distance = separation.distance - shape.radius;
    candidate.normal = separation.normal;
    candidate.measured = true;
  }

  void drop(Candidate& candidate) {
    candidate = candidates_.back();
    candidates_.pop_back();
  }

  void add_plane(const Plane& plane) {
    planes_.push_back(plane);
    depth_ = std::max(depth_, support(footprint_, plane.normal) - plane.b);
    const double beyond = plane.b + options_.clearance - kRounding;
    std::erase_if(candidates_, [&plane, beyond](const Candidate& candidate) {
      return nearest_along(candidate.piece->shape, plane.normal) >= beyond;
    });
  }

  const std::vector<Vec2>& body_;
  const world::StaticMap& map_;
  const Options options_;
  Corridor out_;
  std::vector<Vec2> footprint_;
  Box box_;
  double depth_ = 0.0;
  std::vector<Plane> planes_;
  std::vector<Candidate> candidates_;
};

}  // namespace

Corridor build(std::span<const geom::Pose2> poses, const vehicle::Model& model, const world::StaticMap& map,
               const Options& options) {
  Builder builder(model, map, options, poses.size());
  for (const geom::Pose2& pose : poses) builder.add(pose);
  return builder.take();
}

}  // namespace seine::corridor
