#include "seine/search/point_distances.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <new>

namespace seine::search {
namespace {

constexpr double kMaxCells = 16e6;
// Values are kept with all bits turned: 0 would be a NaN, which no distance is, and memory that is all zeros
// costs nothing until it is written to.
constexpr std::uint32_t kUnknown = 0;
constexpr double kRounding = 1e-6;  // m, more than a float loses on distances of metres

}  // namespace

PointDistances::PointDistances(const world::StaticMap& map, double cell, double cap)
    : map_(&map), low_(map.bounds().low), cap_(cap) {
  const geom::Vec2 size = map.bounds().size();
  cell_ = std::max(cell, std::sqrt(size.x * size.y / kMaxCells));
  inverse_ = 1.0 / cell_;
  columns_ = std::max(1, static_cast<int>(std::ceil(size.x * inverse_)));
  rows_ = std::max(1, static_cast<int>(std::ceil(size.y * inverse_)));
  const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  value_.reset(static_cast<std::atomic<std::uint32_t>*>(std::calloc(count, sizeof(value_[0]))));
  if (!value_) throw std::bad_alloc();
}

float PointDistances::compute(int column, int row) const {
  const std::array<geom::Vec2, 1> point{middle(column, row)};
  return static_cast<float>(map_->distance(point, cap_) - kRounding);
}

double PointDistances::at(int column, int row) const {
  auto& value = value_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)];
  const std::uint32_t known = value.load(std::memory_order_relaxed);
  if (known != kUnknown) return static_cast<double>(std::bit_cast<float>(~known));
  const float distance = compute(column, row);
  value.store(~std::bit_cast<std::uint32_t>(distance), std::memory_order_relaxed);
  return static_cast<double>(distance);
}

PointDistances::Bounds PointDistances::bounds(geom::Vec2 p) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int c = column(p.x), r = row(p.y);
  if (!inside(c, r)) return {-kInfinity, -kInfinity};
  const double here = at(c, r), offset = geom::norm(p - middle(c, r));
  return {here - offset, here > cap_ - 2.0 * kRounding ? kInfinity : here + offset + 2.0 * kRounding};
}

}  // namespace seine::search
