#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "seine/base/deadline.hpp"
#include "seine/geom/vec2.hpp"
#include "seine/search/point_distances.hpp"

namespace seine::search {

/// How a disc goes over the ground.
struct DiscWay {
  const PointDistances* distances = nullptr;
  double radius = 0.0;   ///< m, disc plus clearance; distances->cell() ≤ 0.7 radius keeps walls tight
  double comfort = 0.0;  ///< m: where there is less distance than this …
  int discomfort = 1;    ///< … ground costs so many times as much
  friend bool operator==(const DiscWay&, const DiscWay&) = default;
};

/// Shortest way of a disc to one goal point on the cells of a PointDistances, 8-connected: the heuristic of a
/// car whose footprint contains the disc. Works backwards from the goal, only as far as it is asked (A*
/// towards a focus, resumable; values do not depend on the order of questions). A cell is blocked only when
/// no point in it can hold the disc, and cells are small enough against the disc that no wall is stepped
/// over: where this finds no way there is none. Not thread-safe.
class CostToGo {
 public:
  CostToGo(const DiscWay& way, geom::Vec2 goal);

  /// Looks in the direction of `point` first from now on.
  void focus(geom::Vec2 point);
  /// Gives up at a deadline from now on: an infinite cost then means nothing.
  void until(const Deadline& deadline) { deadline_ = deadline; }
  /// m from the middle of p's cell to the goal's; infinity when there is no way.
  double operator()(geom::Vec2 p);
  /// Memory in use, bytes (without the queue, which is a small part of it).
  std::size_t bytes() const { return bytes_; }

 private:
  static constexpr std::uint32_t kPage = 32;
  // Costs are whole numbers (12 a straight step, 17 a diagonal one, half as much again where the disc only
  // just fits), so that equal ways tie exactly and the values are the same in any order. A page holds 32 × 32
  // cells: 0 = never seen, else 2·cost + closed + 2.
  struct Cell {
    std::int32_t column, row;
  };
  std::uint32_t price(int column, int row) const;
  std::uint32_t& mark(int column, int row) {
    const auto c = static_cast<std::uint32_t>(column), r = static_cast<std::uint32_t>(row);
    auto& page = pages_[(r / kPage) * page_columns_ + c / kPage];
    if (!page) add(page);
    return page[(r % kPage) * kPage + c % kPage];
  }
  void add(std::unique_ptr<std::uint32_t[]>& page);
  std::uint32_t ahead(int column, int row) const;
  void push(Cell cell, std::uint32_t cost);
  bool expand_one();

  DiscWay way_;
  const PointDistances* distances_;
  double half_diagonal_;
  Cell focus_{};
  std::uint32_t page_columns_;
  std::vector<std::unique_ptr<std::uint32_t[]>> pages_;
  std::vector<std::vector<Cell>> open_;  // by cost + cost ahead
  std::size_t lowest_ = 0;
  std::size_t bytes_ = 0;
  Deadline deadline_;
};

}  // namespace seine::search
