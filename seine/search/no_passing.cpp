#include "seine/search/no_passing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "seine/search/leaving.hpp"
#include "seine/search/motion.hpp"

namespace seine::search {
namespace {

using geom::Vec2;

// m: more than the certificate grants of a clearance and, by its tolerance for start and goal poses, at the
// far end of a long car.
constexpr double kGranted = 2e-3;
constexpr double kCells[] = {0.5, 0.3, 0.18};  // car widths
constexpr int kNone = -1;
constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// A disc that stands for a car: as small as the car is anywhere around it.
struct Disc {
  Vec2 start, goal;
  double radius;  // m
  double needed;  // m, from its middle to everything that stands still
};

Disc disc_of(const world::Scenario& scenario, const world::StaticMap& map, int robot) {
  const world::Robot& car = scenario.robots[static_cast<std::size_t>(robot)];
  const DiscCover cover(scenario.model_of(car).footprint);
  const Vec2 middle{cover.widest().x, cover.axis};
  const double margin = starts_inside_margin(scenario, map, car) ? scenario.margins.leaving.value_or(0.0)
                                                                 : scenario.margins.obstacle;
  const double radius = cover.widest().inner;
  return {car.start * middle, *car.goal * middle, radius, radius + margin - kGranted};
}

/// The cells that a disc may be in, as far as it gets from its start, numbered.
class Ground {
 public:
  /// @param most cells; with more it is not complete()
  Ground(const world::StaticMap& map, const Disc& disc, double side, std::size_t most);

  bool complete() const { return complete_; }
  std::size_t size() const { return cells_.size(); }
  int start() const { return 0; }
  int goal() const { return goal_; }  // kNone: not reached
  struct Cell {
    int column, row;
    std::array<int, 4> beside;  // kNone where there is none
  };
  const Cell& operator[](int i) const { return cells_[static_cast<std::size_t>(i)]; }
  /// By cell: steps to the goal.
  std::vector<int> steps_to_goal() const;

 private:
  std::vector<Cell> cells_;
  int goal_ = kNone;
  bool complete_ = false;
};

Ground::Ground(const world::StaticMap& map, const Disc& disc, double side, std::size_t most) {
  constexpr int kBlocked = -2;
  const geom::Box& box = map.bounds();
  const int columns = static_cast<int>(std::ceil(box.size().x / side)) + 1;
  const int rows = static_cast<int>(std::ceil(box.size().y / side)) + 1;
  if (static_cast<double>(columns) * rows > 64.0 * static_cast<double>(most)) return;
  // The number of the cell at each place; kNone: not looked at yet.
  std::vector<int> numbers(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), kNone);
  const auto place = [&](int column, int row) -> int& {
    return numbers[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  };
  const double around = side * std::sqrt(0.5), cap = disc.needed + side;
  const auto free = [&](int column, int row) {
    const std::array<Vec2, 1> middle{box.low + side * Vec2{column + 0.5, row + 0.5}};
    return map.distance(middle, cap) + around >= disc.needed;
  };
  // The number of the cell there.
  const auto visit = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= columns || row >= rows) return kNone;
    int& number = place(column, row);
    if (number == kNone) {
      number = free(column, row) ? static_cast<int>(cells_.size()) : kBlocked;
      if (number >= 0) cells_.push_back({column, row, {}});
    }
    return number >= 0 ? number : kNone;
  };
  const auto column_of = [&](Vec2 p) { return static_cast<int>(std::floor((p.x - box.low.x) / side)); };
  const auto row_of = [&](Vec2 p) { return static_cast<int>(std::floor((p.y - box.low.y) / side)); };
  if (visit(column_of(disc.start), row_of(disc.start)) == kNone) return;  // the question is not sound
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_.size() > most) return;
    for (std::size_t k = 0; k < kBeside.size(); ++k) {
      const int beside = visit(cells_[i].column + kBeside[k][0], cells_[i].row + kBeside[k][1]);
      cells_[i].beside[k] = beside;
    }
  }
  const int column = column_of(disc.goal), row = row_of(disc.goal);
  if (column >= 0 && row >= 0 && column < columns && row < rows) goal_ = std::max(place(column, row), kNone);
  complete_ = true;
}

std::vector<int> Ground::steps_to_goal() const {
  std::vector<int> steps(size(), kNone), queue{goal_};
  steps[static_cast<std::size_t>(goal_)] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const int next : (*this)[queue[i]].beside)
      if (next != kNone && steps[static_cast<std::size_t>(next)] == kNone) {
        steps[static_cast<std::size_t>(next)] = steps[static_cast<std::size_t>(queue[i])] + 1;
        queue.push_back(next);
      }
  return steps;
}

/// The flood of the pairs: greedy, so that it is soon over where there is a way.
class Pairs {
 public:
  Pairs(const Ground& a, const Ground& b, double apart)
      : a_(a), b_(b), apart2_(apart * apart), to_goal_a_(a.steps_to_goal()), to_goal_b_(b.steps_to_goal()) {
    known_.assign((a.size() * b.size() + 63) / 64, 0);
  }
  bool reaches_goals();

 private:
  struct Pair {
    int a, b;
  };
  void add(int a, int b);

  const Ground &a_, &b_;
  double apart2_;  // cells²
  std::vector<int> to_goal_a_, to_goal_b_;
  std::vector<std::uint64_t> known_;
  std::vector<std::vector<Pair>> open_;  // by steps left
  std::size_t lowest_ = 0;
};

void Pairs::add(int a, int b) {
  const std::size_t index = static_cast<std::size_t>(a) * b_.size() + static_cast<std::size_t>(b);
  std::uint64_t& word = known_[index / 64];
  const std::uint64_t bit = std::uint64_t{1} << (index % 64);
  if ((word & bit) != 0) return;
  word |= bit;
  const double dx = std::abs(a_[a].column - b_[b].column) + 1, dy = std::abs(a_[a].row - b_[b].row) + 1;
  if (dx * dx + dy * dy < apart2_) return;
  const auto left = static_cast<std::size_t>(to_goal_a_[static_cast<std::size_t>(a)] +
                                             to_goal_b_[static_cast<std::size_t>(b)]);
  if (left >= open_.size()) open_.resize(left + 1);
  open_[left].push_back({a, b});
  lowest_ = std::min(lowest_, left);
}

bool Pairs::reaches_goals() {
  add(a_.start(), b_.start());
  for (; lowest_ < open_.size();) {
    if (open_[lowest_].empty()) {
      ++lowest_;
      continue;
    }
    const Pair at = open_[lowest_].back();
    open_[lowest_].pop_back();
    if (at.a == a_.goal() && at.b == b_.goal()) return true;
    for (const int next : a_[at.a].beside)
      if (next != kNone) add(next, at.b);
    for (const int next : b_[at.b].beside)
      if (next != kNone) add(at.a, next);
  }
  return false;
}

}  // namespace

bool cannot_both_arrive(const world::Scenario& scenario, const world::StaticMap& map, int a, int b,
                        std::size_t most_pairs) {
  const Disc first = disc_of(scenario, map, a), second = disc_of(scenario, map, b);
  const double apart = first.radius + second.radius + scenario.margins.robot - kGranted;
  const double width = 2.0 * std::min(first.radius, second.radius);
  const auto most_cells = static_cast<std::size_t>(16.0 * std::sqrt(static_cast<double>(most_pairs)));
  for (const double share : kCells) {
    const double side = share * width;
    const Ground ground_a(map, first, side, most_cells);
    if (!ground_a.complete()) return false;
    if (ground_a.goal() == kNone) return true;
    const Ground ground_b(map, second, side, std::min(most_cells, most_pairs / ground_a.size()));
    if (!ground_b.complete()) return false;
    if (ground_b.goal() == kNone || !Pairs(ground_a, ground_b, apart / side).reaches_goals()) return true;
  }
  return false;
}

}  // namespace seine::search
