#include "seine/world/static_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <deque>

#include "seine/base/error.hpp"
#include "seine/geom/grid_check.hpp"
#include "seine/geom/polygon.hpp"

namespace seine::world {

using geom::Box;
using geom::Vec2;

namespace {

// Rounding of touching shapes must not make them collide.
constexpr double kTouch = 1e-9;  // m
// Buckets about as far apart as the pieces, but not smaller than small cars nor larger than large ones, and
// not too many.
constexpr double kBucketMin = 0.5, kBucketMax = 2.0;  // m
constexpr double kBucketCount = 262144.0;

std::string display_name(const Obstacle& obstacle, std::size_t index) {
  return obstacle.name.empty() ? "obstacle " + std::to_string(index + 1) : obstacle.name;
}

// Lists of found pieces, one for each level of nesting of queries in this thread.
struct Scratch {
  std::deque<std::vector<int>> lists;
  std::size_t depth = 0;
};
Scratch& scratch() {
  thread_local Scratch instance;
  return instance;
}

double box_gap(const Box& a, const Box& b) {
  const double dx = std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0});
  const double dy = std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0});
  return std::sqrt(dx * dx + dy * dy);
}

// The wall of the bounds that a polygon is nearest to, or furthest beyond.
geom::Separation to_bounds(std::span<const Vec2> polygon, const Box& bounds) {
  geom::Separation best{std::numeric_limits<double>::infinity(), {}, {}, {}};
  for (const Vec2 p : polygon) {
    const auto offer = [&](double gap, Vec2 outward) {
      if (gap < best.distance) best = {gap, outward, p, p + gap * outward};
    };
    offer(p.x - bounds.low.x, {-1.0, 0.0});
    offer(bounds.high.x - p.x, {1.0, 0.0});
    offer(p.y - bounds.low.y, {0.0, -1.0});
    offer(bounds.high.y - p.y, {0.0, 1.0});
  }
  return best;
}

}  // namespace

StaticMap::StaticMap(const Scenario& scenario) : bounds_(scenario.bounds), origin_(scenario.origin) {
  add_pieces(scenario);
  for (Piece& piece : pieces_) piece.box = piece.shape.box();
  build_buckets();
  face_begin_.reserve(pieces_.size() + 1);
  face_begin_.push_back(0);
  boxes_.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    boxes_.push_back(piece.box);
    const std::vector<Vec2>& core = piece.shape.core;
    for (std::size_t i = 0; i < core.size(); ++i) {
      const Vec2 along = core[i + 1 == core.size() ? 0 : i + 1] - core[i];
      const double length = geom::norm(along);
      faces_.push_back({core[i], length > 0.0 ? Vec2{along.y / length, -along.x / length} : Vec2{}});
    }
    face_begin_.push_back(static_cast<int>(faces_.size()));
  }
}

void StaticMap::add_pieces(const Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    const Obstacle& obstacle = scenario.obstacles[i];
    names_.push_back(display_name(obstacle, i));
    if (!stands_still(obstacle)) continue;
    const int index = static_cast<int>(i);
    const auto add = [&](geom::Convex shape) {
      if (!obstacle.motion.empty()) shape = geom::placed(shape, obstacle.motion.back().pose);
      pieces_.push_back({std::move(shape), {}, index});
    };
    if (const auto* circle = std::get_if<Circle>(&obstacle.shape)) {
      add({{circle->center}, circle->radius});
      continue;
    }
    const auto& polygon = std::get<std::vector<Vec2>>(obstacle.shape);
    if (const std::string why = geom::why_not_simple(polygon); !why.empty()) {
      throw InputError(names_.back() + ": " + why + "; expected a simple polygon");
    }
    for (std::vector<Vec2>& part : geom::convex_parts(polygon)) {
      add({std::move(part), 0.0});
    }
  }
  add_map(scenario);
}

void StaticMap::add_map(const Scenario& scenario) {
  outside_begin_ = pieces_.size();
  if (!scenario.map) return;
  if (!geom::is_complete(*scenario.map)) {
    throw InputError("the map has " + std::to_string(scenario.map->occupied.size()) + " cells, expected " +
                     std::to_string(scenario.map->width) + " x " + std::to_string(scenario.map->height) +
                     " of a positive, finite size");
  }
  const geom::Outside outside = scenario.outside_free ? geom::Outside::free : geom::Outside::blocked;
  std::vector<geom::Convex> rectangles = geom::boundary_rectangles(*scenario.map, outside);
  pieces_.reserve(pieces_.size() + rectangles.size() + 4);
  for (geom::Convex& rectangle : rectangles) pieces_.push_back({std::move(rectangle), {}, -1});
  outside_begin_ = pieces_.size();
  if (scenario.outside_free) return;
  for (geom::Convex& beyond : geom::surroundings(*scenario.map, bounds_))
    pieces_.push_back({std::move(beyond), {}, -1});
}

void StaticMap::build_buckets() {
  // The grid spans the bounds; pieces beyond them matter little and go to the border buckets.
  Box extent = bounds_;
  if (extent.empty()) {
    for (const Piece& piece : pieces_) extent.include(piece.box.low), extent.include(piece.box.high);
  }
  const bool usable = !extent.empty() && std::isfinite(geom::squared_norm(extent.size()));
  if (!usable) extent = {{0.0, 0.0}, {1.0, 1.0}};  // `check` complains; here nothing may break
  const Vec2 size = extent.size();
  const double area = size.x * size.y;
  const double apart = std::sqrt(area / static_cast<double>(std::max<std::size_t>(pieces_.size(), 1)));
  bucket_ = std::max(std::clamp(apart, kBucketMin, kBucketMax), std::sqrt(area / kBucketCount));
  bucket_ = std::max(bucket_, std::max(size.x, size.y) / kBucketCount);
  inverse_ = 1.0 / bucket_;
  low_ = extent.low;
  columns_ = static_cast<int>(size.x * inverse_) + 1;
  rows_ = static_cast<int>(size.y * inverse_) + 1;

  // Counting sort of (bucket, piece).
  bucket_begin_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  const auto each_bucket = [this](const Box& box, auto&& act) {
    const Range range = range_of(box);
    for (int row = range.row_low; row <= range.row_high; ++row) {
      for (int column = range.column_low; column <= range.column_high; ++column) {
        act(static_cast<std::size_t>(row * columns_ + column));
      }
    }
  };
  for (const Piece& piece : pieces_) {
    each_bucket(piece.box, [this](std::size_t bucket) { ++bucket_begin_[bucket + 1]; });
  }
  for (std::size_t i = 1; i < bucket_begin_.size(); ++i) bucket_begin_[i] += bucket_begin_[i - 1];
  bucket_items_.resize(static_cast<std::size_t>(bucket_begin_.back()));
  std::vector<int> cursor(bucket_begin_.begin(), bucket_begin_.end() - 1);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    each_bucket(pieces_[i].box, [&](std::size_t bucket) {
      bucket_items_[static_cast<std::size_t>(cursor[bucket]++)] = static_cast<int>(i);
    });
  }
}

// (The order of the arguments sends NaN to bucket 0.)
int StaticMap::column_of(double x) const {
  return static_cast<int>(
      std::min(std::max(0.0, (x - low_.x) * inverse_), static_cast<double>(columns_ - 1)));
}

int StaticMap::row_of(double y) const {
  return static_cast<int>(std::min(std::max(0.0, (y - low_.y) * inverse_), static_cast<double>(rows_ - 1)));
}

StaticMap::Range StaticMap::range_of(const Box& box) const {
  return {column_of(box.low.x), column_of(box.high.x), row_of(box.low.y), row_of(box.high.y)};
}

template <class Visit>
bool StaticMap::visit_buckets(const Box& box, Visit&& visit) const {
  if (pieces_.empty()) return true;
  const Range range = range_of(box);
  for (int row = range.row_low; row <= range.row_high; ++row) {
    for (int column = range.column_low; column <= range.column_high; ++column) {
      const std::size_t bucket = static_cast<std::size_t>(row * columns_ + column);
      for (int k = bucket_begin_[bucket]; k < bucket_begin_[bucket + 1]; ++k) {
        const int item = bucket_items_[static_cast<std::size_t>(k)];
        const Box& other = boxes_[static_cast<std::size_t>(item)];
        if (!other.overlaps(box)) continue;
        // A piece is met in several buckets: the one that holds the lower corner of the common box speaks for
        // it.
        if (std::max(column_of(other.low.x), range.column_low) != column) continue;
        if (std::max(row_of(other.low.y), range.row_low) != row) continue;
        if (!visit(item)) return false;
      }
    }
  }
  return true;
}

StaticMap::Found::Found(const StaticMap& map, const Box& box) {
  Scratch& mine = scratch();
  if (mine.depth == mine.lists.size()) mine.lists.emplace_back();
  indices_ = &mine.lists[mine.depth++];
  indices_->clear();
  map.visit_buckets(box, [this](int item) {
    indices_->push_back(item);
    return true;
  });
  std::sort(indices_->begin(), indices_->end());
}

StaticMap::Found::~Found() {
  --scratch().depth;
}

void StaticMap::improve(std::span<const Vec2> polygon, const Box& box, double reach, Best& best) const {
  struct Offer {
    double gap;  // of the boxes: not more than the distance
    int item;
  };
  thread_local std::vector<Offer> offers;
  offers.clear();
  visit_buckets(box.inflated(std::max(reach, 0.0)), [&](int item) {
    const double gap = box_gap(box, boxes_[static_cast<std::size_t>(item)]);
    if (gap <= std::max(best.distance, 0.0)) offers.push_back({gap, item});
    return true;
  });
  // The most promising first, until no box is near enough.
  while (!offers.empty()) {
    const auto next =
        std::min_element(offers.begin(), offers.end(), [](Offer a, Offer b) { return a.gap < b.gap; });
    if (next->gap > std::max(best.distance, 0.0)) break;
    const int item = next->item;
    *next = offers.back();
    offers.pop_back();
    const geom::Convex& shape = pieces_[static_cast<std::size_t>(item)].shape;
    const double d =
        geom::distance_up_to(polygon, shape.core, best.distance + shape.radius + kTouch) - shape.radius;
    const bool tie = d == best.distance && (best.piece < 0 || item < best.piece);
    if (d < best.distance || tie) best = {d, item};
  }
}

StaticMap::Best StaticMap::find_nearest(std::span<const Vec2> polygon, double within) const {
  const Box box = geom::bounding_box(polygon);
  Best best{within, -1};
  // Look close by first: in a dense map the rest then need not be looked at.
  for (double reach = std::min(best.distance, bucket_);; reach = std::min(best.distance, 4.0 * reach)) {
    improve(polygon, box, reach, best);
    if (reach >= best.distance) break;
    const Box seen = box.inflated(reach);
    const bool everything = seen.low.x < low_.x && seen.low.y < low_.y &&
                            seen.high.x > low_.x + columns_ * bucket_ &&
                            seen.high.y > low_.y + rows_ * bucket_;
    if (everything) {  // what is filed in the border buckets may lie further out
      improve(polygon, box, best.distance, best);
      break;
    }
  }
  return best;
}

double StaticMap::distance(std::span<const Vec2> polygon, double cap) const {
  return find_nearest(polygon, std::min(cap, to_bounds(polygon, bounds_).distance)).distance;
}

StaticMap::Nearest StaticMap::nearest(std::span<const Vec2> polygon, double cap) const {
  const geom::Separation wall = to_bounds(polygon, bounds_);
  const Best best = find_nearest(polygon, std::min(cap, wall.distance));
  if (best.piece >= 0) {
    const geom::Convex& shape = pieces_[static_cast<std::size_t>(best.piece)].shape;
    geom::Separation separation = geom::separation(polygon, std::span<const Vec2>(shape.core));
    separation.distance -= shape.radius;
    separation.point_b -= shape.radius * separation.normal;
    return {best.distance, best.piece, false, separation};
  }
  if (wall.distance <= cap) return {wall.distance, -1, true, wall};
  return {cap, -1, false, {}};
}

bool StaticMap::piece_clear(std::size_t piece, std::span<const Vec2> polygon, double clearance) const {
  const geom::Convex& shape = pieces_[piece].shape;
  const double wanted = clearance + shape.radius - kTouch;
  // Most pieces are wholly behind one of their own faces.
  for (int f = face_begin_[piece]; f < face_begin_[piece + 1]; ++f) {
    const Face& face = faces_[static_cast<std::size_t>(f)];
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2 p : polygon) least = std::min(least, geom::dot(face.normal, p - face.tail));
    if (least > 0.0 && least >= wanted) return true;
  }
  return geom::distance_up_to(polygon, shape.core, wanted) >= wanted;
}

bool StaticMap::clear(std::span<const Vec2> polygon, double clearance) const {
  const Box box = geom::bounding_box(polygon);
  const double least = std::min(std::min(box.low.x - bounds_.low.x, box.low.y - bounds_.low.y),
                                std::min(bounds_.high.x - box.high.x, bounds_.high.y - box.high.y));
  if (!(least >= clearance - kTouch)) return false;
  return visit_buckets(box.inflated(std::max(clearance - kTouch, 0.0)), [&](int item) {
    return piece_clear(static_cast<std::size_t>(item), polygon, clearance);
  });
}

std::string StaticMap::describe(int piece) const {
  if (piece < 0) return "the bounds";
  const Piece& p = pieces_[static_cast<std::size_t>(piece)];
  if (p.obstacle >= 0) return names_[static_cast<std::size_t>(p.obstacle)];
  if (static_cast<std::size_t>(piece) >= outside_begin_) return "the unknown ground outside the map";
  char text[80];
  const Vec2 at = origin_ + p.box.center();
  std::snprintf(text, sizeof text, "the map at (%.2f, %.2f)", at.x, at.y);
  return text;
}

geom::DistanceField distance_field(const StaticMap& map, double cell, double cap) {
  std::vector<const geom::Convex*> shapes;
  shapes.reserve(map.pieces().size());
  for (const StaticMap::Piece& piece : map.pieces()) shapes.push_back(&piece.shape);
  return geom::distance_field(std::span<const geom::Convex* const>(shapes), map.bounds(), cell, cap);
}

}  // namespace seine::world
