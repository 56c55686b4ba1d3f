#include "seine/search/slot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "seine/search/open_entry.hpp"
#include "seine/search/short_move.hpp"
#include "seine/vehicle/reeds_shepp.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// All lengths in car lengths. Measured: docs/front-end-paths.md.
constexpr double kMove = 1.2;      // a move is no longer; it may be followed by another like it
constexpr double kStop = 0.2;      // between the places where a move may end
constexpr double kLeast = 0.02;    // shorter moves are lost in the optimiser's tolerances
constexpr double kProbe = 0.02;    // between the samples of a move
constexpr double kContact = 2e-3;  // contacts are found as exactly as that
constexpr double kCell = 0.02;     // of a position bin
constexpr int kHeadings = 180;     // bins
constexpr double kRoomy = 0.1;     // of room: with more than that bins are larger
constexpr int kCoarser = 6;        // times
constexpr double kScarce = 5e-3;   // of room: with less than that its order of magnitude counts
// Where the wheel hard over leads less far than this it is tried turned by a part of that,
// and by a part of the part.
constexpr double kBlocked = 0.1, kPart = 0.4, kLeastPart = 1e-4;
constexpr double kJerkShare = 0.15;  // of v / a: what a stretch takes longer for its smooth ends
// Of the time that the arcs on both sides take the wheel turns meanwhile, in a bend and at a gear change:
// hard over to hard over it turns at rest.
constexpr double kInBend = 0.5, kAtChange = 0.2;
constexpr int kWords = 5;  // for each of the costs of a gear change, turning radii
constexpr std::array kGearChange{0.0, 2.0};
constexpr int kSweeps = 4;       // words tried from a node at most
constexpr double kWeight = 1.1;  // of the time to go

/// How a car stands in the middle of a stretch in one gear, and how long the stretches before took.
struct Progress {
  double done = 0.0;    // s, of the stretches before and the waits for the wheel
  double length = 0.0;  // m, of the present stretch
  double cruise = 0.0;  // s, that it would take at top speed
  Arc last{};           // of no length at the start
};

/// The clock of the search: roughly what `drive_time` says, one arc at a time.
class Clock {
 public:
  Clock(const vehicle::Model& model, bool leaving) : model_(model), leaving_(leaving) {}

  double time(const Progress& p) const { return p.done + stretch(p.length, p.cruise); }
  void add(Progress& p, const Arc& arc) const;
  /// m/s, 0 where the car has no such gear.
  double top(const Arc& arc) const;

 private:
  double stretch(double length, double cruise) const;
  double alone(const Arc& arc) const {
    return stretch(std::abs(arc.distance), std::abs(arc.distance) / top(arc));
  }

  const vehicle::Model& model_;
  bool leaving_;
};

/// s, from rest to rest over `length` m that take `cruise` s at top speed.
double Clock::stretch(double length, double cruise) const {
  const double a = model_.limits.acceleration;
  if (length == 0.0 || !std::isfinite(a)) return cruise;
  const double top = length / cruise;
  const double jerk = kJerkShare * std::min(top / a, std::sqrt(length / a));
  return jerk + (length < top * top / a ? 2.0 * std::sqrt(length / a) : cruise + top / a);
}

void Clock::add(Progress& p, const Arc& arc) const {
  const bool begins = p.last.distance == 0.0;
  if (!begins && std::isfinite(model_.limits.steering_rate)) {
    const double turn = std::abs(std::atan(model_.wheelbase * arc.curvature) -
                                 std::atan(model_.wheelbase * p.last.curvature));
    // The wheel turns while the car drives a part of either arc.
    const double part = arc.gear() == p.last.gear() ? kInBend : kAtChange;
    p.done += std::max(0.0, turn / model_.limits.steering_rate - part * (alone(p.last) + alone(arc)));
  }
  if (!begins && arc.gear() != p.last.gear()) p = {time(p), 0.0, 0.0, {}};
  p.last = arc;
  p.length += std::abs(arc.distance);
  p.cruise += std::abs(arc.distance) / top(arc);
}

double Clock::top(const Arc& arc) const {
  const vehicle::Limits& limits = model_.limits;
  const bool ahead = (arc.distance >= 0.0) == leaving_;
  const double speed = ahead ? limits.speed : limits.reverse_speed, bend = std::abs(arc.curvature);
  return bend > 0.0 ? std::min(speed, std::sqrt(limits.lateral_acceleration / bend)) : speed;
}

struct Node {
  geom::Pose2 pose;
  Arc arc;  // that led here
  Progress progress;
  double left = 0.0;      // s, to the goal
  double estimate = 0.0;  // s, of the whole way
  double extra = 0.0;     // s, for the bumps
  double room = 0.0;
  int parent = -1;
  bool on = false;  // whether the move may be followed by another like it
  bool known = false;
};

class SlotSearch {
 public:
  explicit SlotSearch(const SlotProblem& problem)
      : p_(problem),
        checker_(*problem.checker),
        model_(checker_.model()),
        clock_(model_, problem.leaving),
        length_(model_.length()) {}

  SlotResult run();

 private:
  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  void push(int index);
  int pop();
  std::uint64_t bin(const Node& n) const;
  bool settle(int index);
  bool plainly_blocked(geom::Pose2 from, std::span<const Arc> arcs) const;
  void shoot(int index);
  void expand(int index);
  double bumps(const geom::Pose2& from, const Arc& arc) const;
  double move(int index, double curvature, int gear);
  double probe(const geom::Pose2& from, double room, const Arc& arc) const;
  void add(int parent, const Arc& move, bool on);
  Route route() const;
  vehicle::DrivingCosts costs(double gear_change) const;

  const SlotProblem& p_;
  const FootprintChecker& checker_;
  const vehicle::Model& model_;
  Clock clock_;
  double length_;
  std::vector<Node> nodes_;
  std::vector<OpenEntry> open_;
  std::unordered_map<std::uint64_t, int> bins_;
  double best_ = kInfinity;
  int best_node_ = -1;
  vehicle::ReedsSheppPath best_word_;
};

std::uint64_t SlotSearch::bin(const Node& n) const {
  const auto index = [](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value + 0.5)) + (1 << 20));
  };
  const bool roomy = n.room > kRoomy * length_;
  // Who leaves a wall that it touches gains room by the factor, not by the metre.
  const auto scarce = static_cast<std::uint64_t>(
      std::clamp(std::log2(kScarce * length_ / std::max(n.room, 1e-9)), 0.0, 31.0));
  const int coarser = roomy ? kCoarser : 1;
  const double cell = coarser * kCell * length_;
  const std::uint64_t turn = index(n.pose.heading * kHeadings / (coarser * 2.0 * std::numbers::pi)) & 0x3ff;
  return (index((n.pose.x - p_.inside.x) / cell) << 42) ^ (index((n.pose.y - p_.inside.y) / cell) << 20) ^
         (scarce << 12) ^ (turn << 2) ^ (roomy ? 2U : 0U) ^ (n.progress.last.gear() < 0 ? 1U : 0U);
}

void SlotSearch::push(int index) {
  open_.push_back({node(index).estimate, index});
  std::push_heap(open_.begin(), open_.end());
}

int SlotSearch::pop() {
  if (open_.empty() || open_.front().estimate >= best_) return -1;
  std::pop_heap(open_.begin(), open_.end());
  const int index = open_.back().node;
  open_.pop_back();
  return index;
}

vehicle::DrivingCosts SlotSearch::costs(double gear_change) const {
  const vehicle::Limits& limits = model_.limits;
  const double slower = limits.reverse_speed > 0.0 ? limits.speed / limits.reverse_speed : kInfinity;
  vehicle::DrivingCosts costs{.gear_change = gear_change};
  (p_.leaving ? costs.reverse : costs.forward) = std::max(1.0, slower);
  return costs;
}

/// Whether a pose now and then on the way is too near to something: most words that are blocked are found out
/// so, for a fraction of a sweep.
bool SlotSearch::plainly_blocked(geom::Pose2 from, std::span<const Arc> arcs) const {
  const double stride = kStop * length_;
  for (const Arc& arc : arcs) {
    const int samples = static_cast<int>(std::ceil(std::abs(arc.distance) / stride));
    for (int i = 1; i <= samples; ++i)
      if (!checker_.clear(vehicle::drive(from, arc.curvature, arc.distance * i / samples))) return true;
    from = vehicle::drive(from, arc);
  }
  return false;
}

/// Shoots at the goal; `left` becomes the time of the quickest word, clear or not.
void SlotSearch::shoot(int index) {
  Node& from = node(index);
  from.left = kInfinity;
  std::array<std::pair<double, vehicle::ReedsSheppPath>, kGearChange.size() * kWords> shots;
  std::size_t count = 0;
  for (const double change : kGearChange) {
    std::array<vehicle::ReedsSheppPath, kWords> words;
    const int found =
        vehicle::reeds_shepp(from.pose, p_.outside, p_.radius, costs(change * p_.radius), words);
    for (std::size_t k = 0; k < static_cast<std::size_t>(found); ++k) {
      Progress progress = from.progress;
      for (const Arc& arc : words[k].arcs())
        if (std::abs(arc.distance) > 1e-9) clock_.add(progress, arc);
      shots[count++] = {clock_.time(progress) + from.extra, words[k]};
    }
  }
  std::sort(shots.begin(), shots.begin() + static_cast<std::ptrdiff_t>(count),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  if (count > 0) from.left = shots[0].first - clock_.time(from.progress) - from.extra;
  int sweeps = 0;
  for (std::size_t k = 0; k < count && sweeps < kSweeps; ++k) {
    if (shots[k].first >= best_) break;
    if (k > 0 && shots[k].first == shots[k - 1].first) continue;
    if (plainly_blocked(from.pose, shots[k].second.arcs())) continue;
    ++sweeps;
    if (sweep(checker_, from.pose, from.room, shots[k].second.arcs()) < 0.0) continue;
    best_ = shots[k].first, best_node_ = index, best_word_ = shots[k].second;
    break;
  }
}

/// s, for the bumps on the way.
double SlotSearch::bumps(const geom::Pose2& from, const Arc& arc) const {
  if (p_.bumps.empty()) return 0.0;
  const RouteCosts costs{.radius = p_.radius, .bumps = p_.bumps};
  return costs.bumps_along(from, arc) / model_.limits.speed;
}

void SlotSearch::add(int parent, const Arc& move, bool on) {
  const Node& from = node(parent);
  Node next;
  next.pose = vehicle::drive(from.pose, move);
  next.arc = move, next.parent = parent, next.on = on;
  next.progress = from.progress;
  clock_.add(next.progress, move);
  next.extra = from.extra + bumps(from.pose, move);
  next.left = std::max(0.0, from.left - std::abs(move.distance) / model_.limits.speed);
  next.estimate = clock_.time(next.progress) + next.extra + kWeight * next.left;
  if (next.estimate >= best_) return;
  nodes_.push_back(next);
  push(static_cast<int>(nodes_.size()) - 1);
}

/// Whether a node is the quickest in its bin; then it is shot from and its estimate becomes a good one.
bool SlotSearch::settle(int index) {
  Node& here = node(index);
  const double time = clock_.time(here.progress) + here.extra;
  here.room = checker_.room(here.pose);
  const auto [at, fresh] = bins_.try_emplace(bin(here), index);
  if (!fresh) {
    const Node& other = node(at->second);
    if (clock_.time(other.progress) + other.extra <= time) return false;
    at->second = index;
  }
  if (here.parent >= 0) {
    const Node& parent = node(here.parent);
    here.room = checker_.sweep(parent.pose, parent.room, here.arc, here.pose);
    if (here.room < 0.0) return false;
  }
  here.known = true;
  shoot(index);
  here.estimate = std::max(here.estimate, time + kWeight * here.left);
  return true;
}

/// m, how far along the arc the way looks clear: to within a part of a step, and without looking at what is
/// between two samples.
double SlotSearch::probe(const geom::Pose2& from, double room, const Arc& arc) const {
  const double length = std::abs(arc.distance), sign = arc.distance < 0.0 ? -1.0 : 1.0;
  const double step = kProbe * length_, turns = 1.0 + std::abs(arc.curvature) * length_;
  const auto room_at = [&](double s) {
    const geom::Pose2 pose = vehicle::drive(from, arc.curvature, sign * s);
    const double there = checker_.room(pose);
    return there < checker_.slack_at(pose.position()) ? -1.0 : there;
  };
  double s = 0.0, blocked = kInfinity;
  while (s < length) {
    const double next = std::min(s + std::max(step, room / turns), length);
    const double there = room_at(next);
    if (there < 0.0) {
      blocked = next;
      break;
    }
    s = next, room = there;
  }
  while (s < length && blocked - s > kContact * length_) {
    const double middle = 0.5 * (s + blocked);
    (room_at(middle) < 0.0 ? blocked : s) = middle;
  }
  return s;
}

/// Moves by one arc; returns how far it leads, m.
double SlotSearch::move(int index, double curvature, int gear) {
  const Node from = node(index);
  const Arc longest{curvature, gear * kMove * length_};
  if (!(clock_.top(longest) > 0.0)) return 0.0;
  const bool same = from.parent >= 0 && from.arc.curvature == curvature;
  if (same && (from.arc.gear() != gear || !from.on)) return kInfinity;
  const double reach = probe(from.pose, from.room, longest);
  if (reach < kLeast * length_) return reach;
  const int stops = std::max(1, static_cast<int>(reach / (kStop * length_)));
  for (int i = 1; i <= stops; ++i)
    add(index, {curvature, gear * reach * i / stops}, i == stops && reach >= kMove * length_);
  return reach;
}

void SlotSearch::expand(int index) {
  const double full = 1.0 / p_.radius;
  const double least = node(index).room < kScarce * length_ ? kLeastPart : 0.5 * kPart;
  for (const int gear : {1, -1}) {
    move(index, 0.0, gear);
    for (const double curvature : {full, -full}) {
      double part = 1.0;
      do {
        if (move(index, part * curvature, gear) >= kBlocked * length_) break;
        part *= kPart;
      } while (part > least);
    }
  }
}

Route SlotSearch::route() const {
  Route route{p_.inside, p_.outside, {}};
  for (int at = best_node_; nodes_[static_cast<std::size_t>(at)].parent >= 0;
       at = nodes_[static_cast<std::size_t>(at)].parent)
    route.arcs.push_back(nodes_[static_cast<std::size_t>(at)].arc);
  std::reverse(route.arcs.begin(), route.arcs.end());
  const auto word = best_word_.arcs();
  route.arcs.insert(route.arcs.end(), word.begin(), word.end());
  merge(route.arcs);
  return p_.leaving ? route : reversed(route);
}

SlotResult SlotSearch::run() {
  SlotResult result;
  nodes_.push_back({.pose = p_.inside});
  push(0);
  int limit = p_.max_expansions;
  for (int index = pop(); index >= 0 && result.expansions < limit; index = pop()) {
    if (!node(index).known) {
      const bool had_none = best_node_ < 0;
      if (!settle(index)) continue;
      if (had_none && best_node_ >= 0) limit = std::min(limit, 2 * result.expansions + 50);
      if (!open_.empty() && node(index).estimate > open_.front().estimate) {
        push(index);
        continue;
      }
    }
    if (++result.expansions % 16 == 0 && p_.deadline.expired()) break;
    expand(index);
  }
  if (best_node_ >= 0) result.route = route();
  return result;
}

}  // namespace

SlotResult search_slot(const SlotProblem& problem) {
  return SlotSearch(problem).run();
}

}  // namespace seine::search
