#include "seine/search/space_time_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>

#include "seine/search/busy_ground.hpp"
#include "seine/vehicle/reeds_shepp.hpp"

namespace seine::search {
namespace {

using vehicle::Arc;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kWords = 3;    // Reeds-Shepp words tried per shot
constexpr double kSample = 0.2;      // car lengths between the places at which a move is tested
constexpr double kGrain = 0.1;       // car lengths: what moves less is looked at as one
constexpr double kReverse = 0.3;     // what a second backwards costs more than one forwards
constexpr double kGearChange = 0.5;  // turning radii at full pace, beside stopping and starting
constexpr double kSteering = 0.05;   // turning radii at full pace, from straight to the tightest turn
constexpr int kEagerShots = 50;      // nodes that shoot at the goal each; later ones only now and then
constexpr int kShotEvery = 4;
constexpr double kNear = 4.0;  // turning radii to the goal: from here every node shoots

// A velocity plan rests at units, and tests groups of units as one: as many units are kept free to either
// side.
constexpr double kBlur = 3.0;

struct Node {
  geom::Pose2 pose;
  Arc arc;          // that led here
  double time;      // s: when the car is here, at the pace of the arc
  double cost;      // s, from the start
  double left;      // s to the goal, a lower bound
  double estimate;  // s, of the whole way
  double room;
  double leave_by;  // s: the traffic comes
  int parent;       // −1 at the root
  int span;         // how many times the traffic has been here before
  bool timed;       // static obstacles and traffic were looked at
  bool shot;        // the way to the goal on free ground is known
};

struct Entry {
  double estimate, by_cost;
  int node;
  friend bool operator<(const Entry& a, const Entry& b) {
    if (a.estimate != b.estimate) return a.estimate > b.estimate;
    return a.by_cost != b.by_cost ? a.by_cost > b.by_cost : a.node > b.node;
  }
};

class SpaceTime {
 public:
  SpaceTime(const SpaceTimeProblem& problem, const SpaceTimeSettings& settings)
      : p_(problem),
        s_(settings),
        ground_(problem.traffic, *problem.footprint, problem.grid->half_step(),
                kGrain * problem.checker->model().length()),
        moves_(Primitives::fan(problem.radius, settings.step, settings.forward,
                               problem.grid->reverse_speed > 0.0 ? settings.backward : 0)),
        top_(settings.speed_share * problem.grid->speed),
        sample_(kSample * problem.checker->model().length()),
        blur_(kBlur * problem.grid->unit) {}

  SpaceTimeResult run();

 private:
  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  double pace(const Arc& arc) const;
  double lag(const Arc& arc) const { return 0.5 * pace(arc) / p_.grid->acceleration; }
  double ahead(const geom::Pose2& pose) { return (*p_.to_go)(pose * p_.reference) / top_; }
  double extra(const Arc& arc, const Node& before) const;
  // Where waiting costs as much as driving nobody is done before the goal is free.
  double estimate(const Node& n) const {
    const double whole = n.cost + s_.heuristic_weight * n.left;
    return s_.waiting < 1.0 ? whole : std::max(whole, goal_free_);
  }
  std::uint64_t bin(const Node& n) const;
  bool start();
  void push(int index);
  int pop();
  void add(int parent, const Arc& move);
  void look(int index);
  void arrive(Node child, double room, double duration);
  double forbid(const geom::Pose2& from, std::span<const Arc> arcs);
  double depart(double passing, double starting, double latest) const;
  double shoot(int index, bool try_them);
  bool try_word(int index, const vehicle::ReedsSheppPath& word);
  Route route() const;

  const SpaceTimeProblem& p_;
  const SpaceTimeSettings& s_;
  BusyGround ground_;
  Primitives moves_;
  double top_;     // m/s, assumed
  double sample_;  // m
  double blur_;    // m
  std::vector<Node> nodes_;
  std::vector<Entry> open_;
  struct Best {
    double cost = kInfinity, time = kInfinity;  // s, of all nodes in a bin
  };
  std::unordered_map<std::uint64_t, Best> bins_;
  std::vector<Span> forbidden_;  // when a move may not begin
  double goal_free_ = 0.0;       // s: from then on for good
  double best_cost_ = kInfinity, best_arrival_ = kInfinity;
  int best_node_ = -1;
  vehicle::ReedsSheppPath best_word_;
};

double SpaceTime::pace(const Arc& arc) const {
  const double limit = arc.gear() > 0 ? p_.grid->speed : p_.grid->reverse_speed;
  const double bent = std::sqrt(p_.grid->lateral / std::max(std::abs(arc.curvature), 1e-12));
  return s_.speed_share * std::min(limit, bent);
}

// What a move costs beside its time, s.
double SpaceTime::extra(const Arc& arc, const Node& before) const {
  const double radius = p_.radius / top_;
  double cost = arc.gear() < 0 ? kReverse * std::abs(arc.distance) / pace(arc) : 0.0;
  if (before.parent < 0) return cost;
  cost += kSteering * radius * p_.radius * std::abs(arc.curvature - before.arc.curvature);
  if (arc.gear() != before.arc.gear()) cost += kGearChange * radius;
  return cost;
}

std::uint64_t SpaceTime::bin(const Node& n) const {
  const auto index = [&](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / s_.cell + 0.5)) +
                                      (1 << 19)) &
           0xfffffU;
  };
  const double angle = 2.0 * std::numbers::pi / s_.headings;
  const auto heading = static_cast<std::int64_t>(std::floor(n.pose.heading / angle + 0.5));
  const auto turn = static_cast<std::uint64_t>((heading % s_.headings + s_.headings) % s_.headings);
  return index(n.pose.x - p_.start.x) << 44 | index(n.pose.y - p_.start.y) << 24 | turn << 14 |
         static_cast<std::uint64_t>(n.arc.gear() < 0) << 13 |
         static_cast<std::uint64_t>(std::min(n.span, 8191));
}

void SpaceTime::push(int index) {
  const Node& n = node(index);
  open_.push_back({n.estimate, n.cost + s_.heuristic_weight * n.left, index});
  std::push_heap(open_.begin(), open_.end());
}

int SpaceTime::pop() {
  if (open_.empty() || open_.front().estimate >= best_cost_) return -1;
  const int index = open_.front().node;
  std::pop_heap(open_.begin(), open_.end());
  open_.pop_back();
  return index;
}

// A child that is reached without waiting, as far as is known.
void SpaceTime::add(int index, const Arc& move) {
  const Node& parent = node(index);
  Node child{};
  child.arc = move;
  child.parent = index;
  child.pose = vehicle::drive(parent.pose, move);
  const bool rolls = parent.parent >= 0 && parent.arc.gear() == move.gear();
  const double duration = std::abs(move.distance) / pace(move);
  const double pause = rolls ? 0.0 : lag(move) + (parent.parent >= 0 ? lag(parent.arc) : 0.0);
  child.time = parent.time + pause + duration;
  child.cost = parent.cost + pause + duration + extra(move, parent);
  child.left = std::max(parent.left - std::abs(move.distance) / top_, 0.0);
  child.estimate = estimate(child);
  if (child.estimate >= best_cost_) return;
  nodes_.push_back(child);
  push(static_cast<int>(nodes_.size()) - 1);
}

// Fills `forbidden_`: when the car must not pass `from`, at pace, on these arcs. Returns how long they take.
double SpaceTime::forbid(const geom::Pose2& from, std::span<const Arc> arcs) {
  forbidden_.clear();
  const auto keep_off = [&](const geom::Pose2& pose, const Slack& slack, double begin, double end) {
    for (const Span& busy : ground_.busy(pose, slack))
      forbidden_.push_back({busy.begin - end, busy.end - begin});
  };
  geom::Pose2 pose = from;
  double time = 0.0;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const Arc& arc = arcs[i];
    if (i > 0 && arc.gear() != arcs[i - 1].gear()) {
      const double pause = lag(arcs[i - 1]) + lag(arc);
      keep_off(pose, {}, time, time + pause);
      time += pause;
    }
    const double length = std::abs(arc.distance), duration = length / pace(arc);
    const int samples = std::max(1, static_cast<int>(std::ceil(length / sample_)));
    const double half = 0.5 * length / samples;
    for (int k = 0; k < samples; ++k) {
      const double s = (2 * k + 1) * half;
      keep_off(vehicle::drive(pose, arc.curvature, arc.gear() * s),
               {half + blur_, half + blur_, std::abs(arc.curvature)}, time + duration * k / samples,
               time + duration * (k + 1) / samples);
    }
    pose = vehicle::drive(pose, arc);
    time += duration;
  }
  unite(forbidden_);
  return time;
}

// The earliest allowed time in [passing, latest]; one that means waiting is not before `starting`. Infinite
// when there is none.
double SpaceTime::depart(double passing, double starting, double latest) const {
  double time = passing;
  for (const Span& span : forbidden_) {
    if (span.begin > time) break;
    if (span.end > time) time = std::max(span.end, starting);
  }
  return time <= latest ? time : kInfinity;
}

// Looks at a guessed node's move: one timed node for each span of time in which it can be here.
void SpaceTime::look(int index) {
  Node child = node(index);
  const Node parent = node(child.parent);
  double room = p_.checker->sweep(parent.pose, parent.room, child.arc, child.pose);
  while (room < 0.0 && std::abs(child.arc.distance) >= 2.0 * s_.min_step) {
    child.arc.distance *= 0.5;
    child.pose = vehicle::drive(parent.pose, child.arc);
    room = p_.checker->sweep(parent.pose, parent.room, child.arc, child.pose);
  }
  if (room < 0.0) return;
  child.left = ahead(child.pose);
  if (child.left == kInfinity) return;
  arrive(child, room, forbid(parent.pose, {&child.arc, 1}));
}

void SpaceTime::arrive(Node child, double room, double duration) {
  const Node parent = node(child.parent);
  const bool rolls = parent.parent >= 0 && parent.arc.gear() == child.arc.gear();
  const double starting = parent.time + lag(child.arc) + (parent.parent >= 0 ? lag(parent.arc) : 0.0);
  const std::span<const Span> busy = ground_.busy(child.pose, {blur_, blur_, std::abs(child.arc.curvature)});
  child.room = room;
  child.timed = true;
  const double earliest = rolls ? parent.time : starting;
  double passing = earliest;
  int last_span = -1;
  for (;;) {
    const double begin = depart(passing, starting, parent.leave_by);
    if (begin == kInfinity) return;
    child.time = begin + duration;
    child.span = 0;
    child.leave_by = kInfinity;
    bool taken = false;
    for (const Span& span : busy) {
      if (span.end <= child.time) ++child.span;
      taken = taken || (span.begin <= child.time && child.time < span.end);
      if (span.begin > child.time) child.leave_by = std::min(child.leave_by, span.begin);
    }
    if (!taken && child.span != last_span) {
      last_span = child.span;
      child.cost = parent.cost + (earliest + duration - parent.time) + s_.waiting * (begin - earliest) +
                   extra(child.arc, parent);
      child.estimate = estimate(child);
      nodes_.push_back(child);
      push(static_cast<int>(nodes_.size()) - 1);
    }
    // The next chance comes after what is forbidden next.
    const auto next = std::find_if(forbidden_.begin(), forbidden_.end(),
                                   [&](const Span& span) { return span.begin > begin; });
    if (next == forbidden_.end() || next->end == kInfinity) return;
    passing = std::max(next->end, starting);
  }
}

bool SpaceTime::try_word(int index, const vehicle::ReedsSheppPath& word) {
  const Node from = node(index);
  const std::span<const Arc> arcs = word.arcs();
  double cost = 0.0;
  Node before = from;
  for (const Arc& arc : arcs) {
    cost += extra(arc, before);
    before.arc = arc;
    before.parent = 0;
  }
  if (!arcs.empty() && sweep(*p_.checker, from.pose, from.room, arcs) < 0.0) return false;
  const double duration = forbid(from.pose, arcs);
  const bool root = from.parent < 0, rolls = !root && !arcs.empty() && arcs.front().gear() == from.arc.gear();
  const double starting = from.time + (arcs.empty() ? 0.0 : lag(arcs.front())) + (root ? 0.0 : lag(from.arc));
  const double earliest = rolls ? from.time : starting;
  double passing = earliest;
  if (passing + duration < goal_free_) passing = std::max(goal_free_ - duration, starting);
  const double begin = depart(passing, starting, from.leave_by);
  if (begin == kInfinity) return false;
  const double arrival = begin + duration + (arcs.empty() ? 0.0 : lag(arcs.back()));
  cost += from.cost + (earliest - from.time) + s_.waiting * (begin - earliest) + arrival - begin;
  if (cost >= best_cost_) return false;
  best_cost_ = cost;
  best_arrival_ = arrival;
  best_node_ = index;
  best_word_ = word;
  return true;
}

// Tries the goal from a node; returns the time to it on free ground, s.
double SpaceTime::shoot(int index, bool try_them) {
  std::array<vehicle::ReedsSheppPath, kWords> words;
  const double infinite = 1e3;  // a car without a reverse gear
  const vehicle::DrivingCosts costs{
      .reverse = p_.grid->reverse_speed > 0.0 ? (1.0 + kReverse) * p_.grid->speed / p_.grid->reverse_speed
                                              : infinite,
      .gear_change = (kGearChange * p_.radius) + top_ * top_ / p_.grid->acceleration};
  const geom::Pose2 from = node(index).pose;
  const int found = vehicle::reeds_shepp(from, p_.goal, p_.radius, costs, words);
  for (int k = 0; k < found && try_them; ++k) {
    const auto& word = words[static_cast<std::size_t>(k)];
    const auto backs = [](const Arc& arc) { return arc.distance < 0.0; };
    if (p_.grid->reverse_speed <= 0.0 && std::any_of(word.arcs().begin(), word.arcs().end(), backs)) continue;
    if (try_word(index, word)) break;
  }
  return found > 0 ? words[0].cost / top_ : 0.0;
}

Route SpaceTime::route() const {
  Route route{p_.start, p_.goal, {}};
  const auto at = [&](int i) -> const Node& { return nodes_[static_cast<std::size_t>(i)]; };
  for (int i = best_node_; at(i).parent >= 0; i = at(i).parent) route.arcs.push_back(at(i).arc);
  std::reverse(route.arcs.begin(), route.arcs.end());
  const auto word = best_word_.arcs();
  route.arcs.insert(route.arcs.end(), word.begin(), word.end());
  return route;
}

// Makes the root; false when the search cannot begin.
bool SpaceTime::start() {
  p_.to_go->focus(p_.start * p_.reference);
  Node root{};
  root.pose = p_.start;
  root.arc.distance = 1.0;
  root.time = root.cost = 0.0;
  root.left = ahead(p_.start);
  root.room = p_.checker->room(p_.start);
  root.leave_by = kInfinity;
  root.parent = -1;
  root.timed = true;
  for (const Span& span : ground_.busy(p_.start)) {
    if (span.begin <= 0.0) return false;
    root.leave_by = std::min(root.leave_by, span.begin);
  }
  root.estimate = estimate(root);
  nodes_.push_back(root);
  if (root.left < kInfinity) push(0);
  return root.left < kInfinity;
}

SpaceTimeResult SpaceTime::run() {
  SpaceTimeResult result;
  for (const Span& span : ground_.busy(p_.goal)) goal_free_ = span.end;
  result.goal_blocked = goal_free_ == kInfinity;
  if (result.goal_blocked || !start()) return result;
  int limit = s_.max_expansions, shots = 0;
  for (int index = pop(); index >= 0 && result.expansions < limit; index = pop()) {
    if (!node(index).timed) {
      look(index);
      continue;
    }
    if (!node(index).shot) {
      Best& known = bins_[bin(node(index))];
      if (node(index).cost >= known.cost && node(index).time >= known.time) continue;
      known = {std::min(known.cost, node(index).cost), std::min(known.time, node(index).time)};
      const bool near = node(index).left * top_ < kNear * p_.radius;
      const bool had_none = best_node_ < 0;
      const double left = shoot(index, ++shots <= kEagerShots || near || shots % kShotEvery == 0);
      if (had_none && best_node_ >= 0) limit = std::min(limit, 2 * result.expansions + 50);
      Node& here = node(index);
      here.shot = true;
      if (left > here.left) {
        here.left = left;
        here.estimate = estimate(here);
        push(index);
        continue;
      }
    }
    if (++result.expansions % 64 == 0 && p_.deadline.expired()) break;
    if (node(index).estimate >= best_cost_) continue;
    for (const Arc& move : moves_.arcs) add(index, move);
  }
  if (best_node_ >= 0) result.route = route();
  result.arrival = best_arrival_;
  return result;
}

}  // namespace

SpaceTimeResult search_space_time(const SpaceTimeProblem& problem, const SpaceTimeSettings& settings) {
  return SpaceTime(problem, settings).run();
}

}  // namespace seine::search
