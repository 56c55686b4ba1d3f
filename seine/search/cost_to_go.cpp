#include "seine/search/cost_to_go.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace seine::search {
namespace {

constexpr std::uint32_t kStraight = 12, kDiagonal = 17;
constexpr std::uint32_t kClosed = 1;
constexpr unsigned kPerLook = 4096;  // cells, at the clock

std::uint32_t cost_of(std::uint32_t mark) {
  return (mark - 2) >> 1;
}
std::uint32_t open_mark(std::uint32_t cost) {
  return 2 * cost + 2;
}

}  // namespace

CostToGo::CostToGo(const DiscWay& way, geom::Vec2 goal)
    : way_(way),
      distances_(way.distances),
      half_diagonal_(distances_->cell() * std::sqrt(0.5)),
      page_columns_((static_cast<std::uint32_t>(distances_->columns()) + kPage - 1) / kPage) {
  pages_.resize(page_columns_ * ((static_cast<std::uint32_t>(distances_->rows()) + kPage - 1) / kPage));
  bytes_ = pages_.size() * sizeof(pages_[0]);
  const Cell cell{distances_->column(goal.x), distances_->row(goal.y)};
  focus_ = cell;
  if (!distances_->inside(cell.column, cell.row)) return;
  mark(cell.column, cell.row) = open_mark(0);
  push(cell, 0);
}

/// Halves of a step's cost that ground costs; 0 where it is blocked.
std::uint32_t CostToGo::price(int column, int row) const {
  const double distance = distances_->at(column, row);
  if (distance + 1e-5 < way_.radius - half_diagonal_) return 0;
  const std::uint32_t just_fits = distance < way_.radius ? 3 : 2;
  return distance < way_.comfort ? just_fits * static_cast<std::uint32_t>(way_.discomfort) : just_fits;
}

void CostToGo::add(std::unique_ptr<std::uint32_t[]>& page) {
  page = std::make_unique<std::uint32_t[]>(kPage * kPage);
  bytes_ += kPage * kPage * sizeof(std::uint32_t);
}

std::uint32_t CostToGo::ahead(int column, int row) const {
  const auto dx = static_cast<std::uint32_t>(std::abs(column - focus_.column));
  const auto dy = static_cast<std::uint32_t>(std::abs(row - focus_.row));
  return kStraight * std::max(dx, dy) + (kDiagonal - kStraight) * std::min(dx, dy);
}

void CostToGo::push(Cell cell, std::uint32_t cost) {
  const std::size_t key = cost + ahead(cell.column, cell.row);
  if (key >= open_.size()) open_.resize(key + key / 2 + 64);
  open_[key].push_back(cell);
  lowest_ = std::min(lowest_, key);
}

void CostToGo::focus(geom::Vec2 point) {
  const Cell cell{distances_->column(point.x), distances_->row(point.y)};
  if (cell.column == focus_.column && cell.row == focus_.row) return;
  focus_ = cell;
  std::vector<std::vector<Cell>> old;
  std::swap(old, open_);
  lowest_ = std::numeric_limits<std::size_t>::max();
  for (const auto& bucket : old) {
    for (const Cell c : bucket) {
      const std::uint32_t m = mark(c.column, c.row);
      if ((m & kClosed) == 0) push(c, cost_of(m));
    }
  }
  if (open_.empty()) lowest_ = 0;
}

bool CostToGo::expand_one() {
  while (lowest_ < open_.size() && open_[lowest_].empty()) ++lowest_;
  if (lowest_ >= open_.size()) return false;
  const Cell cell = open_[lowest_].back();
  open_[lowest_].pop_back();
  std::uint32_t& here = mark(cell.column, cell.row);
  if ((here & kClosed) != 0) return true;
  here |= kClosed;
  const std::uint32_t cost = cost_of(here);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int column = cell.column + dx, row = cell.row + dy;
      if ((dx == 0 && dy == 0) || !distances_->inside(column, row)) continue;
      std::uint32_t& there = mark(column, row);
      if ((there & kClosed) != 0) continue;
      const std::uint32_t halves = price(column, row);
      if (halves == 0) continue;
      const std::uint32_t step = (dx != 0 && dy != 0 ? kDiagonal : kStraight) * halves / 2;
      if (there != 0 && cost_of(there) <= cost + step) continue;
      there = open_mark(cost + step);
      push({column, row}, cost + step);
    }
  }
  return true;
}

double CostToGo::operator()(geom::Vec2 p) {
  const int column = distances_->column(p.x), row = distances_->row(p.y);
  if (!distances_->inside(column, row)) return std::numeric_limits<double>::infinity();
  for (unsigned looked = 1;; ++looked) {
    const std::uint32_t m = mark(column, row);
    if ((m & kClosed) != 0) return cost_of(m) * distances_->cell() / kStraight;
    const bool late = looked % kPerLook == 0 && deadline_.expired();
    if (late || !expand_one()) return std::numeric_limits<double>::infinity();
  }
}

}  // namespace seine::search
