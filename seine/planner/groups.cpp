#include "seine/planner/groups.hpp"

#include <algorithm>
#include <numeric>

#include "seine/constraint/footprint_distance.hpp"

namespace seine::planner {

Groups::Groups(int count) : parent_(static_cast<std::size_t>(count)) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int Groups::root(int member) const {
  while (parent_[static_cast<std::size_t>(member)] != member)
    member = parent_[static_cast<std::size_t>(member)];
  return member;
}

// The smaller root wins, so that the result does not depend on the order of joins.
void Groups::join(int a, int b) {
  const int ra = root(a), rb = root(b);
  parent_[static_cast<std::size_t>(std::max(ra, rb))] = std::min(ra, rb);
}

std::vector<std::vector<int>> Groups::all() const {
  std::vector<std::vector<int>> groups(parent_.size());
  for (int k = 0; k < static_cast<int>(parent_.size()); ++k)
    groups[static_cast<std::size_t>(root(k))].push_back(k);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

bool come_within(const trajopt::Body& a, const trajopt::Body& b, double gap) {
  const std::size_t ticks = std::max(a.placements.size(), b.placements.size());
  const double reach = a.shape.reach + b.shape.reach + gap;
  for (std::size_t tick = 0; tick < ticks; tick += trajopt::Proximity::kStride) {
    const auto& pa = a.placements[std::min(tick, a.placements.size() - 1)];
    const auto& pb = b.placements[std::min(tick, b.placements.size() - 1)];
    const geom::Vec2 apart =
        (pb.position + b.shape.offset * pb.direction) - (pa.position + a.shape.offset * pa.direction);
    if (geom::squared_norm(apart) > reach * reach) continue;
    constraint::FootprintGradient unused;
    if (constraint::footprint_distance(pa.position, pa.direction, a.shape.footprint, pb.position,
                                       pb.direction, b.shape.footprint, unused) <= gap)
      return true;
  }
  return false;
}

}  // namespace seine::planner
