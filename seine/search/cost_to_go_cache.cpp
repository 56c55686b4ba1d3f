#include "seine/search/cost_to_go_cache.hpp"

#include <algorithm>

namespace seine::search {

CostToGoCache::Loan::Loan(CostToGoCache& cache, const DiscWay& way, geom::Vec2 goal)
    : cache_(cache),
      way_(way),
      column_(way.distances->column(goal.x)),
      row_(way.distances->row(goal.y)),
      to_go_(cache.take(way, column_, row_)) {
  if (!to_go_) to_go_ = std::make_unique<CostToGo>(way, goal);
}

CostToGoCache::Loan::~Loan() {
  cache_.keep({way_, column_, row_, std::move(to_go_)});
}

std::unique_ptr<CostToGo> CostToGoCache::take(const DiscWay& way, int column, int row) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    return kept.column == column && kept.row == row && kept.way == way;
  });
  if (found == kept_.end()) return nullptr;
  auto taken = std::move(found->to_go);
  kept_.erase(found);
  return taken;
}

void CostToGoCache::keep(Kept kept) {
  constexpr std::size_t kMaxKept = 256, kMaxBytes = std::size_t{64} << 20;
  const std::lock_guard lock(mutex_);
  kept_.push_back(std::move(kept));
  std::size_t bytes = 0, first = kept_.size();
  while (first > 0 && kept_.size() - first < kMaxKept && bytes < kMaxBytes)
    bytes += kept_[--first].to_go->bytes();
  kept_.erase(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace seine::search
