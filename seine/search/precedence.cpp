#include "seine/search/precedence.hpp"

#include <algorithm>

namespace seine::search {

Precedence::Precedence(const Coordinator& coordinator)
    : after_(static_cast<std::size_t>(coordinator.robots())) {
  const int count = coordinator.robots();
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      if (i == j) continue;
      if (coordinator.touches_start(i, j)) after_[static_cast<std::size_t>(j)].push_back(i);
      if (coordinator.touches_goal(i, j)) after_[static_cast<std::size_t>(i)].push_back(j);
    }
  for (std::vector<int>& list : after_) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

bool Precedence::before(int first, int second) const {
  const std::vector<int>& list = after_[static_cast<std::size_t>(first)];
  return std::binary_search(list.begin(), list.end(), second);
}

std::vector<int> Precedence::order(std::span<const double> keys) const {
  const std::size_t count = after_.size();
  std::vector<int> unmet(count, 0), order;
  std::vector<bool> done(count, false);
  for (const std::vector<int>& list : after_)
    for (const int robot : list) ++unmet[static_cast<std::size_t>(robot)];
  while (order.size() < count) {
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (done[i]) continue;
      if (best == count || unmet[i] < unmet[best] || (unmet[i] == unmet[best] && keys[i] > keys[best]))
        best = i;
    }
    done[best] = true;
    order.push_back(static_cast<int>(best));
    for (const int robot : after_[best]) --unmet[static_cast<std::size_t>(robot)];
  }
  return order;
}

}  // namespace seine::search
