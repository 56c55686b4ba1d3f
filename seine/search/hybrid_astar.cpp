#include "seine/search/hybrid_astar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "seine/search/open_entry.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr int kPopsPerClock = 8;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kWords =
    3;  // Reeds-Shepp words tried per shot: the best one is often blocked where the third is not

/// How much is known about a node. What is dear (the sweep, the cost to go, Reeds-Shepp words) is found out
/// only when the node comes to the front of the queue by what is known so far: most never do.
enum class Stage : std::uint8_t { guessed, checked, tried, closed };

struct Node {
  geom::Pose2 pose;
  Arc arc;          // that led here
  double cost;      // from the start
  double left;      // to the goal, m: a lower bound until checked
  double estimate;  // of the whole way, the queue's key
  double room;      // once checked
  int parent;       // −1 at the root
  Stage stage = Stage::guessed;
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
  std::vector<OpenEntry> open;
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
        bin_angle_(2.0 * std::numbers::pi / settings.headings),
        target_(problem.goal * problem.reference) {}

  LatticeResult run();

 private:
  double ahead(const geom::Pose2& pose) { return (*p_.to_go)(pose * p_.reference); }
  std::uint64_t bin(const Node& n) const;
  Node& node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  const Node& node(int index) const { return nodes_[static_cast<std::size_t>(index)]; }
  bool start();
  void push(int index);
  int pop();
  bool check(int index);
  double shoot(int index);
  bool try_goal(int index);
  void expand(int index);
  void add(int parent, const Arc& move);
  double cost_of(const Node& parent, const Arc& move) const;
  Route route() const;
  const Arc* arc_before(const Node& n) const { return n.parent < 0 ? nullptr : &n.arc; }

  const LatticeProblem& p_;
  const LatticeSettings& s_;
  std::vector<Node>& nodes_;
  std::vector<OpenEntry>& open_;
  Bins& bins_;
  Primitives moves_;
  double bin_angle_;
  geom::Vec2 target_;  // where the reference point is at the goal
  // The best way found so far: a node and the word that leads from it to the goal.
  double best_cost_ = kInfinity;
  int best_node_ = -1;
  vehicle::ReedsSheppPath best_word_;
};

std::uint64_t Lattice::bin(const Node& n) const {
  const geom::Pose2& pose = n.pose;
  const auto index = [](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value)) + (1 << 20));
  };
  const auto heading = static_cast<std::int64_t>(std::floor(pose.heading / bin_angle_ + 0.5));
  const std::int64_t turn = (heading % s_.headings + s_.headings) % s_.headings;
  return (index((pose.x - p_.start.x) / s_.cell + 0.5) << 42) |
         (index((pose.y - p_.start.y) / s_.cell + 0.5) << 20) |
         static_cast<std::uint64_t>(2 * turn + (s_.gears_apart && n.arc.gear() < 0 ? 1 : 0));
}

void Lattice::push(int index) {
  open_.push_back({node(index).estimate, index});
  std::push_heap(open_.begin(), open_.end());
}

/// The open node with the lowest estimate, −1 when there is none that could better the best way.
int Lattice::pop() {
  while (!open_.empty()) {
    const OpenEntry entry = open_.front();
    std::pop_heap(open_.begin(), open_.end());
    open_.pop_back();
    if (entry.estimate >= best_cost_) return -1;
    const Node& next = node(entry.node);
    if (next.stage != Stage::closed && next.estimate == entry.estimate) return entry.node;
  }
  return -1;
}

/// Tries the goal from a node; returns the cost of the cheapest word, clear or not.
double Lattice::shoot(int index) {
  const Node from = node(index);
  std::array<vehicle::ReedsSheppPath, kWords> words;
  const int found = vehicle::reeds_shepp(from.pose, p_.goal, p_.costs.radius, p_.costs.driving, words);
  std::array<double, kWords> cost{};
  std::array<std::size_t, kWords> order{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(found); ++k) {
    cost[k] = from.cost + p_.costs.of(from.pose, words[k].arcs(), arc_before(from));
    order[k] = k;
  }
  std::sort(order.begin(), order.begin() + found,
            [&](std::size_t a, std::size_t b) { return cost[a] < cost[b]; });
  for (std::size_t i = 0; i < static_cast<std::size_t>(found); ++i) {
    const std::size_t k = order[i];
    if (cost[k] >= best_cost_) break;
    if (sweep(*p_.checker, from.pose, from.room, words[k].arcs()) < 0.0) continue;
    best_cost_ = cost[k];
    best_node_ = index;
    best_word_ = words[k];
    break;
  }
  return found > 0 ? words[0].cost : 0.0;
}

double Lattice::cost_of(const Node& parent, const Arc& move) const {
  return parent.cost + p_.costs.step(move, arc_before(parent)) + p_.costs.bumps_along(parent.pose, move);
}

void Lattice::add(int index, const Arc& move) {
  const Node& parent = node(index);
  const geom::Pose2 pose = vehicle::drive(parent.pose, move);
  const double cost = cost_of(parent, move);
  const double straight = geom::norm(pose * p_.reference - target_);
  const double left = std::max(straight, parent.left - std::abs(move.distance));
  const double estimate = cost + s_.heuristic_weight * left;
  if (estimate >= best_cost_) return;
  nodes_.push_back({pose, move, cost, left, estimate, 0.0, index});
  push(static_cast<int>(nodes_.size()) - 1);
}

/// Whether a guessed node can be reached and is the cheapest in its bin; then its estimate becomes a good
/// one. A move that is blocked is cut in half as often as the settings allow.
bool Lattice::check(int index) {
  Node& here = node(index);
  const Node& parent = node(here.parent);
  for (;;) {
    const int known = bins_.at(bin(here));
    if (known >= 0 && node(known).cost <= here.cost) return false;
    here.room = p_.checker->sweep(parent.pose, parent.room, here.arc, here.pose);
    if (here.room >= 0.0) break;
    if (s_.until_blocked) {
      const double reach = p_.checker->reach(parent.pose, parent.room, here.arc);
      if (reach < s_.min_step || reach >= std::abs(here.arc.distance)) return false;
      here.arc.distance = std::copysign(reach, here.arc.distance);
      here.pose = vehicle::drive(parent.pose, here.arc);
      here.cost = cost_of(parent, here.arc);
      continue;
    }
    if (std::abs(here.arc.distance) < 2.0 * s_.min_step) return false;
    here.arc.distance *= 0.5;
    here.pose = vehicle::drive(parent.pose, here.arc);
    here.cost = cost_of(parent, here.arc);
  }
  here.left = ahead(here.pose);
  if (here.left == kInfinity) return false;
  int& in_bin = bins_.at(bin(here));
  if (in_bin >= 0) node(in_bin).stage = Stage::closed;
  in_bin = index;
  here.stage = Stage::checked;
  here.estimate = std::max(here.estimate, here.cost + s_.heuristic_weight * here.left);
  return true;
}

/// Shoots at the goal; true when the best way known is as good as this search needs.
bool Lattice::try_goal(int index) {
  const double free_cost = shoot(index);
  Node& here = node(index);
  here.stage = Stage::tried;
  if (best_cost_ <= here.estimate) return true;
  // The word is also a bound: a node that faces away from the goal goes back to its place in the queue.
  here.estimate = std::max(here.estimate, here.cost + s_.heuristic_weight * free_cost);
  return best_cost_ <= here.estimate;
}

void Lattice::expand(int index) {
  node(index).stage = Stage::closed;
  for (const Arc& move : moves_.arcs) add(index, move);
}

Route Lattice::route() const {
  Route route{p_.start, p_.goal, {}};
  for (int at = best_node_; node(at).parent >= 0; at = node(at).parent) route.arcs.push_back(node(at).arc);
  std::reverse(route.arcs.begin(), route.arcs.end());
  const auto word = best_word_.arcs();
  route.arcs.insert(route.arcs.end(), word.begin(), word.end());
  return route;
}

/// Makes the root. False when there is nothing to search: a word leads straight to the goal, or there is no
/// way at all.
bool Lattice::start() {
  nodes_.clear();
  open_.clear();
  bins_.clear();
  nodes_.push_back({p_.start, {}, 0.0, 0.0, 0.0, p_.checker->room(p_.start), -1, Stage::checked});
  bins_.at(bin(node(0))) = 0;
  if (try_goal(0)) return false;
  p_.to_go->focus(p_.start * p_.reference);
  Node& root = node(0);
  root.left = ahead(p_.start);
  root.estimate = std::max(root.estimate, s_.heuristic_weight * root.left);
  if (root.left == kInfinity || best_cost_ <= root.estimate) return false;
  push(0);
  return true;
}

LatticeResult Lattice::run() {
  LatticeResult result;
  // Once a way is known a better one is looked for only about as long again.
  int limit = s_.max_expansions;
  for (int pops = 0, index = start() ? pop() : -1; index >= 0 && result.expansions < limit; index = pop()) {
    if (++pops % kPopsPerClock == 0 && p_.deadline.expired()) break;
    if (node(index).stage == Stage::guessed && !check(index)) {
      node(index).stage = Stage::closed;
      continue;
    }
    // Whoever learns that it is further off than it looked waits for its turn.
    const auto waits = [&] { return !open_.empty() && node(index).estimate > open_.front().estimate; };
    if (!waits() && node(index).stage == Stage::checked) {
      const bool had_none = best_cost_ == kInfinity;
      if (try_goal(index)) break;
      if (had_none && best_cost_ < kInfinity) limit = std::min(limit, 2 * result.expansions + 50);
    }
    if (waits()) {
      push(index);
      continue;
    }
    ++result.expansions;
    expand(index);
  }
  if (best_node_ >= 0) result.route = route();
  result.exhausted = best_node_ < 0 && open_.empty();
  result.unreachable = best_node_ < 0 && node(0).left == kInfinity;
  return result;
}

}  // namespace

LatticeResult search_lattice(const LatticeProblem& problem, const LatticeSettings& settings) {
  thread_local Scratch scratch;
  return Lattice(problem, settings, scratch).run();
}

}  // namespace seine::search
