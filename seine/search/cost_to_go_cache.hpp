#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "seine/search/cost_to_go.hpp"

namespace seine::search {

/// Costs to go that were worked out before, for whoever comes with a goal in the same cell; each is lent to
/// one search at a time, so any number of threads may ask. Keeps the latest 256, or 64 MB of them.
class CostToGoCache {
 public:
  /// A borrowed cost to go that finds its way back.
  class Loan {
   public:
    Loan(CostToGoCache& cache, const DiscWay& way, geom::Vec2 goal);
    ~Loan();
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    CostToGo* get() const { return to_go_.get(); }

   private:
    friend class CostToGoCache;
    CostToGoCache& cache_;
    DiscWay way_;
    int column_, row_;
    std::unique_ptr<CostToGo> to_go_;
  };

 private:
  struct Kept {
    DiscWay way;
    int column, row;
    std::unique_ptr<CostToGo> to_go;
  };
  std::unique_ptr<CostToGo> take(const DiscWay& way, int column, int row);
  void keep(Kept kept);

  std::mutex mutex_;
  std::vector<Kept> kept_;  // the longest unused first
};

}  // namespace seine::search
