#include "seine/search/bottleneck.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

#include "seine/geom/box.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

constexpr double kUsualCells = 250e3;  // a fifth of a second
constexpr double kMostCells = 1e6;
constexpr double kRounding = 1e-5;  // m, more than distances lose as floats
constexpr int kWindow = 5;          // cells around a narrow place that are looked at closely …
constexpr int kFiner = 8;           // … each cut into so many times as many
constexpr int kZooms = 3;

struct Cell {
  int column, row;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Distances to what stands still at the middles of cells, computed when first asked for.
class Grid {
 public:
  Grid(const world::StaticMap& map, const geom::Box& box, double cell, double cap)
      : map_(map), low_(box.low), cell_(cell), cap_(cap) {
    columns_ = std::max(1, static_cast<int>(std::ceil(box.size().x / cell)));
    rows_ = std::max(1, static_cast<int>(std::ceil(box.size().y / cell)));
    value_.assign(size(), std::numeric_limits<float>::quiet_NaN());
  }

  std::size_t size() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  bool inside(Cell c) const { return c.column >= 0 && c.row >= 0 && c.column < columns_ && c.row < rows_; }
  std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(c.column);
  }
  Cell cell_of(Vec2 p) const {
    return {static_cast<int>(std::floor((p.x - low_.x) / cell_)),
            static_cast<int>(std::floor((p.y - low_.y) / cell_))};
  }
  Cell nearest(Vec2 p) const {
    const Cell c = cell_of(p);
    return {std::clamp(c.column, 0, columns_ - 1), std::clamp(c.row, 0, rows_ - 1)};
  }
  Vec2 middle(Cell c) const { return low_ + cell_ * Vec2{c.column + 0.5, c.row + 0.5}; }
  double at(Cell c) {
    float& value = value_[index(c)];
    if (std::isnan(value)) {
      const std::array<Vec2, 1> point{middle(c)};
      value = static_cast<float>(map_.distance(point, cap_));
    }
    return static_cast<double>(value);
  }
  double side() const { return cell_; }
  double cap() const { return cap_; }
  int columns() const { return columns_; }

 private:
  const world::StaticMap& map_;
  Vec2 low_;
  double cell_, cap_;
  int columns_, rows_;
  std::vector<float> value_;
};

/// The widest ways from one cell: always goes on where the narrowest place so far is the widest, and among
/// equals towards the target.
class Flood {
 public:
  Flood(Grid& grid, Cell from, Cell to) : grid_(grid), target_(to), before_(grid.size(), kNew) {
    add(from, kRoot, {grid.cap(), from});
  }

  struct Narrowest {
    double distance;
    Cell cell;
  };

  /// Takes one cell; true once it is the target.
  bool step() {
    if (open_.empty()) return true;
    const Entry next = open_.top();
    open_.pop();
    if (next.narrowest.distance < narrowest_.distance) narrowest_ = next.narrowest, wide_ = taken_;
    ++taken_;
    if (next.cell == target_) {
      narrowest_ = next.narrowest;
      return true;
    }
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (dx != 0 || dy != 0)
          add({next.cell.column + dx, next.cell.row + dy}, static_cast<int>(grid_.index(next.cell)),
              next.narrowest);
    return false;
  }

  const Narrowest& narrowest() const { return narrowest_; }
  /// Ground that was taken before the narrowest place, m².
  double area() const { return static_cast<double>(wide_) * grid_.side() * grid_.side(); }
  /// The cells of the way from the target back to the root.
  std::vector<Cell> way() const {
    std::vector<Cell> cells;
    for (int at = static_cast<int>(grid_.index(target_)); at >= 0; at = before_[static_cast<std::size_t>(at)])
      cells.push_back({at % grid_.columns(), at / grid_.columns()});
    return cells;
  }

 private:
  static constexpr int kNew = -2, kRoot = -1;
  struct Entry {
    Narrowest narrowest;
    int left;  // cells to the target
    Cell cell;
    // A max-heap's order; ties by place, so that the same answer comes out everywhere.
    friend bool operator<(const Entry& a, const Entry& b) {
      if (a.narrowest.distance != b.narrowest.distance) return a.narrowest.distance < b.narrowest.distance;
      if (a.left != b.left) return a.left > b.left;
      return a.cell.row != b.cell.row ? a.cell.row > b.cell.row : a.cell.column > b.cell.column;
    }
  };

  void add(Cell cell, int from, const Narrowest& so_far) {
    if (!grid_.inside(cell)) return;
    int& before = before_[grid_.index(cell)];
    if (before != kNew) return;
    before = from;
    const double distance = grid_.at(cell);
    const int left = std::max(std::abs(cell.column - target_.column), std::abs(cell.row - target_.row));
    open_.push({distance < so_far.distance ? Narrowest{distance, cell} : so_far, left, cell});
  }

  Grid& grid_;
  Cell target_;
  std::vector<int> before_;
  std::priority_queue<Entry> open_;
  Narrowest narrowest_{std::numeric_limits<double>::infinity(), {}};
  long taken_ = 0, wide_ = 0;
};

/// Uphill in distance until there is `enough`, but not further than a coarse cell or so, which may lead out
/// of a passage: a way on coarse cells runs beside its middle.
Cell climbed(Grid& grid, Cell at, double enough) {
  for (int steps = 0; steps < 3 * kFiner / 2 && grid.at(at) < enough; ++steps) {
    Cell best = at;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{at.column + dx, at.row + dy};
        if (grid.inside(next) && grid.at(next) > grid.at(best)) best = next;
      }
    if (best == at) break;
    at = best;
  }
  return at;
}

/// Looks at the narrowest place of a way (`distance` m wide to either side) ever more closely, between the
/// points where the way enters and leaves a window around it. Returns the distance there, m, and moves `at`
/// to its middle.
double zoom(const world::StaticMap& map, std::vector<Vec2> way, double cell, double cap, double distance,
            Vec2& at) {
  for (int level = 0; level < kZooms; ++level) {
    const double reach = kWindow * cell;
    const geom::Box window = geom::Box{at, at}.inflated(reach);
    const auto close = [&](Vec2 p) { return window.contains(p); };
    // The stretch of the way about the place.
    const auto here = std::min_element(way.begin(), way.end(), [&](Vec2 a, Vec2 b) {
      return geom::squared_norm(a - at) < geom::squared_norm(b - at);
    });
    auto first = here, last = here;
    while (first != way.begin() && close(*(first - 1))) --first;
    while (last + 1 != way.end() && close(*(last + 1))) ++last;
    const double enough = distance + 1.5 * cell;  // more than the narrowest place can have
    cell /= kFiner;
    Grid grid(map, window, cell, cap);
    Flood flood(grid, climbed(grid, grid.nearest(*first), enough),
                climbed(grid, grid.nearest(*last), enough));
    while (!flood.step()) {
    }
    distance = flood.narrowest().distance;
    at = grid.middle(flood.narrowest().cell);
    way.clear();
    for (const Cell c : flood.way()) way.push_back(grid.middle(c));
  }
  return distance;
}

std::optional<Bottleneck> look(const world::StaticMap& map, Vec2 from, Vec2 to, double cell, double cap) {
  Grid grid(map, map.bounds(), cell, 1.1 * cap);
  const Cell start = grid.cell_of(from), goal = grid.cell_of(to);
  if (!grid.inside(start) || !grid.inside(goal)) return std::nullopt;
  Flood there(grid, start, goal), back(grid, goal, start);
  const Flood* done = nullptr;
  while (done == nullptr) {
    if (there.step())
      done = &there;
    else if (back.step())
      done = &back;
  }
  const Flood::Narrowest& narrowest = done->narrowest();
  if (narrowest.distance >= cap) return std::nullopt;
  const double half_diagonal = 0.5 * std::numbers::sqrt2 * cell;
  Bottleneck result;
  result.at = grid.middle(narrowest.cell);
  result.upper_width = std::max(0.0, 2.0 * (narrowest.distance + half_diagonal + kRounding));
  result.nearer_to_goal = done == &back, result.smaller_side = done->area();
  std::vector<Vec2> way;
  for (const Cell c : done->way()) way.push_back(grid.middle(c));
  const double distance = zoom(map, std::move(way), cell, 1.1 * cap, narrowest.distance, result.at);
  result.width = std::clamp(2.0 * distance, 0.0, result.upper_width);
  return result;
}

}  // namespace

std::optional<Bottleneck> bottleneck(const world::StaticMap& map, Vec2 from, Vec2 to, double cell,
                                     double needed, double cap) {
  const Vec2 size = map.bounds().size();
  const double area = size.x * size.y;
  cell = std::max(cell, std::sqrt(area / kUsualCells));
  for (;;) {
    const auto found = look(map, from, to, cell, cap);
    const bool doubt = found && found->width < needed && found->upper_width >= needed;
    cell *= 0.5;
    if (!doubt || area > kMostCells * cell * cell) return found;
  }
}

}  // namespace seine::search
