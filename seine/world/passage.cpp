#include "seine/world/passage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace seine::world {
namespace {

using geom::Vec2;

constexpr double kCell = 0.2;  // m

// A grid over everything, filled from one of its nodes.
struct Flood {
  Vec2 low;
  int columns, rows;
  std::vector<char> seen;  // or blocked

  Flood(std::span<const Clutter> circles, const geom::Box& box, double half_width)
      : low(box.low),
        columns(static_cast<int>(box.size().x / kCell) + 1),
        rows(static_cast<int>(box.size().y / kCell) + 1),
        seen(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const Vec2 node = low + kCell * Vec2{double(column), double(row)};
        seen[at(column, row)] = !far_from(circles, node, half_width);
      }
    }
  }
  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  std::size_t nearest(Vec2 place) const {
    return at(static_cast<int>(std::lround((place.x - low.x) / kCell)),
              static_cast<int>(std::lround((place.y - low.y) / kCell)));
  }
  void fill(std::size_t from) {
    std::vector<std::size_t> open{from};
    if (seen[from]) open.clear();
    seen[from] = 1;
    while (!open.empty()) {
      const int column = static_cast<int>(open.back() % static_cast<std::size_t>(columns));
      const int row = static_cast<int>(open.back() / static_cast<std::size_t>(columns));
      open.pop_back();
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const int c = column + dx, r = row + dy;
        if (c < 0 || r < 0 || c >= columns || r >= rows || seen[at(c, r)]) continue;
        seen[at(c, r)] = 1;
        open.push_back(at(c, r));
      }
    }
  }
};

}  // namespace

bool passage(std::span<const Clutter> circles, const geom::Box& room, Vec2 from, Vec2 to, double half_width) {
  Flood flood(circles, room.inflated(-half_width), half_width);
  const std::size_t goal = flood.nearest(to);
  if (flood.seen[goal]) return false;
  flood.fill(flood.nearest(from));
  return flood.seen[goal] != 0;
}

}  // namespace seine::world
