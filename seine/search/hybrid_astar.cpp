#include "seine/search/hybrid_astar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kWords =
    3;  // Reeds-Shepp words tried per shot: the best one is often blocked where the third is not

struct Node {
  geom::Pose2 pose;
  Arc arc;          // that led here
  double cost;      // from the start
  double estimate;  // of the whole way, the queue's key
  double room;
  int parent;         // −1 at the root
  bool shot = false;  // the goal was tried from here
  bool closed = false;
};

struct Entry {
  double estimate;
  int node;
  // A max-heap's order: the lowest estimate comes first, and the older node of two equal ones.
  friend bool operator<(const Entry& a, const Entry& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.node > b.node;
  }
};

/// Bin → newest node in it: open addressing, emptied in O(1) by a new generation.
class Bins {
 public:
  void clear() {
    ++generation_;
    count_ = 0;
  }
  /// The node's place in the table; −1 in it when the bin is new.
  int& at(std::uint64_t key) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = find(key);
    if (slot.generation != generation_) {
      slot = {key, generation_, -1};
      ++count_;
    }
    return slot.node;
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t generation = 0;
    int node = -1;
  };
  Slot& find(std::uint64_t key) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = (key * 0x9e3779b97f4a7c15ULL) >> 20;; ++i) {
      Slot& slot = slots_[i & mask];
      if (slot.generation != generation_ || slot.key == key) return slot;
    }
  }
  void grow() {
    std::vector<Slot> old(std::max<std::size_t>(1024, 2 * slots_.size()));
    std::swap(old, slots_);
    for (const Slot& slot : old) {
      if (slot.generation == generation_) find(slot.key) = slot;
    }
  }
  std::vector<Slot> slots_;
  std::uint32_t generation_ = 0;
  std::size_t count_ = 0;
};

/// Memory that outlives a search: a search of a dozen nodes should not allocate.
struct Scratch {
  std::vector<Node> nodes;
  std::vector<Entry> open;
  Bins bins;
};

class Lattice {
 public:
  Lattice(const LatticeProblem& problem, const LatticeSettings& settings, Scratch& scratch)
      : p_(problem),
        s_(settings),
        nodes_(scratch.nodes),
        open_(scratch.open),
        bins_(scratch.bins),
        moves_(Primitives::fan(problem.costs.radius, settings.step, settings.forward, settings.backward)),
        bin_angle_(2.0 * std::numbers::pi / settings.headings) {}

  LatticeResult run();

 private:
  double ahead(const geom::Pose2& pose) { return (*p_.to_go)(pose * p_.reference); }
  std::uint64_t bin(const geom::Pose2& pose) const;
  void push(int node);
  int pop();
  double shoot(int node);
  void expand(int node);
  void try_move(int node, const Arc& move);
  Route route() const;
  const Arc* arc_before(int node) const {
    const Node& n = nodes_[static_cast<std::size_t>(node)];
    return n.parent < 0 ? nullptr : &n.arc;
  }

  const LatticeProblem& p_;
  const LatticeSettings& s_;
  std::vector<Node>& nodes_;
  std::vector<Entry>& open_;
  Bins& bins_;
  Primitives moves_;
  double bin_angle_;
  // The best way found so far: a node and the word that leads from it to the goal.
  double best_cost_ = kInfinity;
  int best_node_ = -1;
  vehicle::ReedsSheppPath best_word_;
};

std::uint64_t Lattice::bin(const geom::Pose2& pose) const {
  const auto index = [](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value)) + (1 << 20));
  };
  const auto heading = static_cast<std::int64_t>(std::floor(pose.heading / bin_angle_ + 0.5));
  const std::int64_t turn = (heading % s_.headings + s_.headings) % s_.headings;
  return (index((pose.x - p_.start.x) / s_.cell + 0.5) << 42) |
         (index((pose.y - p_.start.y) / s_.cell + 0.5) << 20) | static_cast<std::uint64_t>(turn);
}

void Lattice::push(int node) {
  open_.push_back({nodes_[static_cast<std::size_t>(node)].estimate, node});
  std::push_heap(open_.begin(), open_.end());
}

/// The open node with the lowest estimate, −1 when there is none that could better the best way.
int Lattice::pop() {
  while (!open_.empty()) {
    const Entry entry = open_.front();
    std::pop_heap(open_.begin(), open_.end());
    open_.pop_back();
    if (entry.estimate >= best_cost_) return -1;
    const Node& node = nodes_[static_cast<std::size_t>(entry.node)];
    if (!node.closed && node.estimate == entry.estimate) return entry.node;
  }
  return -1;
}

/// Tries the goal from a node; returns the cost of the cheapest word, clear or not.
double Lattice::shoot(int index) {
  const Node node = nodes_[static_cast<std::size_t>(index)];
  std::array<vehicle::ReedsSheppPath, kWords> words;
  const int found = vehicle::reeds_shepp(node.pose, p_.goal, p_.costs.radius, p_.costs.driving, words);
  std::array<double, kWords> cost{};
  std::array<std::size_t, kWords> order{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(found); ++k) {
    cost[k] = node.cost + p_.costs.of(node.pose, words[k].arcs(), arc_before(index));
    order[k] = k;
  }
  std::sort(order.begin(), order.begin() + found,
            [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; });
  for (std::size_t i = 0; i < static_cast<std::size_t>(found); ++i) {
    const std::size_t k = order[i];
    if (cost[k] >= best_cost_) break;
    if (sweep(*p_.checker, node.pose, node.room, words[k].arcs()) < 0.0) continue;
    best_cost_ = cost[k];
    best_node_ = index;
    best_word_ = words[k];
    break;
  }
  return found > 0 ? words[0].cost : 0.0;
}

void Lattice::try_move(int index, const Arc& move) {
  const Node parent = nodes_[static_cast<std::size_t>(index)];
  const geom::Pose2 pose = vehicle::drive(parent.pose, move);
  const double cost =
      parent.cost + p_.costs.step(move, arc_before(index)) + p_.costs.bumps_along(parent.pose, move);
  const std::uint64_t key = bin(pose);
  const int known = bins_.at(key);
  if (known >= 0 && nodes_[static_cast<std::size_t>(known)].cost <= cost) return;
  const double room = p_.checker->sweep(parent.pose, parent.room, move, pose);
  if (room < 0.0) return;
  const double left = ahead(pose);
  const double estimate = cost + s_.heuristic_weight * left;
  if (!(estimate < best_cost_)) return;
  if (known >= 0) nodes_[static_cast<std::size_t>(known)].closed = true;
  const int child = static_cast<int>(nodes_.size());
  nodes_.push_back({pose, move, cost, estimate, room, index});
  bins_.at(key) = child;
  push(child);
}

void Lattice::expand(int index) {
  nodes_[static_cast<std::size_t>(index)].closed = true;
  for (const Arc& move : moves_.arcs) try_move(index, move);
}

Route Lattice::route() const {
  Route route{p_.start, p_.goal, {}};
  for (int at = best_node_; nodes_[static_cast<std::size_t>(at)].parent >= 0;
       at = nodes_[static_cast<std::size_t>(at)].parent) {
    route.arcs.push_back(nodes_[static_cast<std::size_t>(at)].arc);
  }
  std::reverse(route.arcs.begin(), route.arcs.end());
  const auto word = best_word_.arcs();
  route.arcs.insert(route.arcs.end(), word.begin(), word.end());
  return route;
}

LatticeResult Lattice::run() {
  LatticeResult result;
  nodes_.clear();
  open_.clear();
  bins_.clear();
  p_.to_go->focus(p_.start * p_.reference);
  const double left = ahead(p_.start);
  if (left == kInfinity) {
    result.unreachable = true;
    return result;
  }
  nodes_.push_back({p_.start, {}, 0.0, s_.heuristic_weight * left, p_.checker->room(p_.start), -1});
  bins_.at(bin(p_.start)) = 0;
  push(0);
  // Once a way is known a better one is looked for only about as long again.
  int limit = s_.max_expansions;
  while (result.expansions < limit) {
    if (result.expansions % 32 == 31 && p_.deadline.expired()) break;
    const int index = pop();
    if (index < 0) break;
    Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!node.shot) {
      node.shot = true;
      const bool had_none = best_cost_ == kInfinity;
      const double free_cost = shoot(index);
      if (best_cost_ <= node.estimate) break;
      if (had_none && best_cost_ < kInfinity) limit = std::min(limit, 2 * result.expansions + 50);
      // The word is also a bound: a node that faces away from the goal goes back to its place in the queue.
      const double estimate = node.cost + s_.heuristic_weight * free_cost;
      if (estimate > node.estimate) {
        node.estimate = estimate;
        push(index);
        continue;
      }
    }
    ++result.expansions;
    expand(index);
  }
  if (best_node_ >= 0) result.route = route();
  return result;
}

}  // namespace

LatticeResult search_lattice(const LatticeProblem& problem, const LatticeSettings& settings) {
  thread_local Scratch scratch;
  return Lattice(problem, settings, scratch).run();
}

}  // namespace seine::search
