#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "seine/search/formation_steps.hpp"
#include "seine/vehicle/arc.hpp"

namespace seine::search {
namespace {

using geom::Pose2;
using geom::Vec2;
using vehicle::Arc;

// Lengths in car lengths unless said otherwise; docs/net-planning.md has the measurements.
constexpr double kSlice = 0.01;  // of a car length at top speed: estimates this near are alike
constexpr double kForwardTurns[] = {0.0, 0.22, -0.22, 0.5, -0.5, 0.88, -0.88};  // of κ_max
constexpr double kBackwardTurns[] = {0.0, 0.5, -0.5, 0.88, -0.88};
constexpr double kCurvedPrice = 0.02, kBackwardPrice = 0.4;  // shares of a step's time
constexpr double kSteeringPrice = 0.05, kGearPrice = 1.0;    // of v / a, s
constexpr double kShapePrice = 0.3;                          // of v / a, s
constexpr double kAcross = 0.4;  // sine of the angle to its direction at which a narrow shape is of use
constexpr double kLateralShare = 0.8;
constexpr double kLeastChange = 0.3;  // of the length that a change of shape is given
constexpr double kSwerve = 2.0;       // a car's pace aside, of its pace ahead, while the shape changes
constexpr double kStopShare = 0.6;    // of the acceleration limit, to stop after the last rendezvous

struct Limits {
  double speed, reverse_speed, acceleration, lateral, curvature, length;
};

// Of the whole team: everybody drives the same way.
Limits limits_of(const world::Scenario& scenario) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Limits all{kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, 0.0};
  for (const world::Robot& robot : scenario.robots) {
    const vehicle::Model& model = scenario.model_of(robot);
    all.speed = std::min(all.speed, model.limits.speed);
    all.reverse_speed = std::min(all.reverse_speed, model.limits.reverse_speed);
    all.acceleration = std::min(all.acceleration, model.limits.acceleration);
    all.lateral = std::min(all.lateral, model.limits.lateral_acceleration);
    all.curvature = std::min(all.curvature, model.max_curvature());
    all.length = std::max(all.length, model.length());
  }
  return all;
}

class Lattice {
 public:
  Lattice(const FormationProblem& problem, const FormationSettings& settings, FormationGround& ground)
      : p_(problem),
        s_(settings),
        ground_(ground),
        scenario_(*problem.scenario),
        limits_(limits_of(scenario_)),
        step_(settings.step * limits_.length),
        per_cell_(1.0 / (settings.cell * limits_.length)),
        per_heading_(settings.headings / (2.0 * std::numbers::pi)),
        open_(kSlice * limits_.length / limits_.speed) {
    const auto fan = [&](std::span<const double> turns, double distance) {
      for (const double turn : turns) moves_.push_back(move_of({turn * limits_.curvature, distance}));
    };
    if (s_.forward) fan(kForwardTurns, step_);
    if (s_.backward && limits_.reverse_speed > 0.0) fan(kBackwardTurns, -step_);
    legs_ahead();
  }

  std::optional<FormationPath> run();

 private:
  int meetings() const { return static_cast<int>(p_.meetings.size()); }
  Vec2 middle(const Stand& stand, int held) { return ground_.middle(stand, shape(held)); }
  const Formation& shape(int index) const { return p_.shapes[static_cast<std::size_t>(index)]; }
  void legs_ahead();
  double ahead(const Node& node);
  Move move_of(const Arc& arc) const;
  double cost_of(const Node& parent, const Move& move, int shape) const;
  bool begin_change(Node& node) const;
  double change_needed(const Node& from, const Node& here) const;
  bool change_clear(const Node& node);
  void offer_shapes(const Entry& step, Vec2 forward);
  std::optional<Node> check(const Entry& step);
  bool keep(const Node& node);
  void expand(int index);
  bool drive_to(Node& node);
  bool at_goal(const Node& node);
  void offer(int parent, int move, int shape);
  std::uint64_t bin(const Node& node) const;
  Node& node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  FormationPath path_to(int index);

  const FormationProblem& p_;
  const FormationSettings& s_;
  FormationGround& ground_;
  const world::Scenario& scenario_;
  Limits limits_;
  double step_, per_cell_, per_heading_;
  std::vector<Move> moves_;
  std::vector<double> beyond_;  // per phase: m from the next place to the end of the way, at least
  Formation between_;           // room
  std::vector<Node> nodes_;
  Waiting open_;
  Bins bins_;
};

void Lattice::legs_ahead() {
  const auto count = p_.meetings.size();
  beyond_.assign(count + 1, 0.0);
  for (std::size_t i = count; i-- > 0;) {
    const bool last = i + 1 == count;
    if (last && !p_.goal) continue;
    const double radius = last ? p_.goal->radius : p_.meetings[i + 1].reach;
    const double way = ground_.to(i + 1, p_.meetings[i].point, s_.field);
    beyond_[i] = beyond_[i + 1] + std::max(0.0, way - radius - p_.meetings[i].reach);
  }
}

double Lattice::ahead(const Node& here) {
  const auto i = static_cast<std::size_t>(here.phase);
  if (here.phase == meetings() && !p_.goal) return 0.0;
  const double reach = here.phase == meetings() ? p_.goal->radius : p_.meetings[i].reach;
  return (std::max(0.0, ground_.to(i, middle(here.stand, here.shape), s_.field) - reach) + beyond_[i]) /
         limits_.speed;
}

Move Lattice::move_of(const Arc& arc) const {
  const double top = arc.distance > 0.0 ? limits_.speed : limits_.reverse_speed;
  const double bend = std::abs(arc.curvature);
  const double speed = bend > 0.0 ? std::min(top, std::sqrt(kLateralShare * limits_.lateral / bend)) : top;
  const double dearer = (bend > 0.0 ? kCurvedPrice : 0.0) + (arc.distance < 0.0 ? kBackwardPrice : 0.0);
  Move move{arc, std::abs(arc.distance) / speed * (1.0 + dearer), {}};
  for (int i = 0; i < kChecks; ++i)
    move.way[static_cast<std::size_t>(i)] =
        stand_at(vehicle::drive(Pose2{}, arc.curvature, arc.distance * (i + 1) / kChecks));
  return move;
}

double Lattice::cost_of(const Node& parent, const Move& move, int shape_held) const {
  const double unit = limits_.speed / limits_.acceleration;
  double cost = parent.cost + move.time;
  if (shape_held != parent.shape) cost += kShapePrice * unit;
  if (parent.parent < 0) return cost;
  if (parent.move->arc.gear() != move.arc.gear()) return cost + kGearPrice * unit;
  return parent.move->arc.curvature == move.arc.curvature ? cost : cost + kSteeringPrice * unit;
}

// A shape is complete at the end of the step on which a node takes it on, and the change begins before: not
// while the shape before is being taken on, nor while a catch wants the net as it was.
bool Lattice::begin_change(Node& here) const {
  const Node& from = nodes_[static_cast<std::size_t>(here.parent)];
  here.held_since = from.s + step_;
  here.change = std::min(p_.change, here.held_since - from.held_since);
  if (here.phase > 0) here.change = std::min(here.change, from.after + step_ - p_.hold);
  return here.change >= std::max(kLeastChange * p_.change, change_needed(from, here));
}

// m over which the team must drive while its shape changes, lest a car falls back or swerves: its own way is
// the frame's and that of its offset, which is fastest at half of the change, with a slope of 3/2.
double Lattice::change_needed(const Node& from, const Node& here) const {
  const Formation &old = shape(from.shape), &now = shape(here.shape);
  const Vec2 ahead = static_cast<double>(here.move->arc.gear()) * here.stand.forward;
  double needed = 0.0;
  for (std::size_t k = 0; k < now.offsets.size(); ++k) {
    const Vec2 shift = now.offsets[k] - old.offsets[k];
    const double back = -geom::dot(shift, ahead), aside = std::abs(geom::cross(ahead, shift));
    needed = std::max(needed, 1.5 * (aside / kSwerve + back));
  }
  return needed;
}

// The way back to where the change begins, with the cars between both shapes.
bool Lattice::change_clear(const Node& here) {
  const Formation &old = shape(node(here.parent).shape), &now = shape(here.shape);
  const double begin = here.held_since - here.change;
  for (const Node* at = &here; at->parent >= 0 && at->s > begin; at = &node(at->parent)) {
    const Node& from = node(at->parent);
    for (std::size_t i = kChecks; i-- > 0;) {
      const double s = from.s + step_ * static_cast<double>(i + 1) / kChecks;
      if (s <= begin) break;
      between(old, now, (s - begin) / here.change, between_);
      if (!ground_.clear(stand_after(from.stand, at->move->way[i]), between_)) return false;
    }
  }
  return true;
}

// Drives a node's last step pose by pose: clear all the way, and past which rendezvous?
bool Lattice::drive_to(Node& here) {
  const Node& from = node(here.parent);
  here.s = from.s + step_;
  here.after = from.after + step_;
  if (here.shape != from.shape) return begin_change(here) && change_clear(here);
  // What is in the way of a step is most often at its end.
  for (std::size_t i = kChecks; i-- > 0;)
    if (!ground_.clear(stand_after(from.stand, here.move->way[i]), shape(here.shape))) return false;
  for (std::size_t i = 0; i < kChecks && here.phase < meetings() && here.shape == 0; ++i) {
    const Vec2 at = middle(stand_after(from.stand, here.move->way[i]), 0);
    for (; here.phase < meetings(); ++here.phase) {
      const Rendezvous& meeting = p_.meetings[static_cast<std::size_t>(here.phase)];
      if (geom::norm(at - meeting.point) > meeting.reach) break;
      here.after = step_ * static_cast<double>(kChecks - 1 - i) / kChecks;
    }
  }
  return true;
}

// Where the way is blocked in one shape it may be clear in another: the first one wherever it fits again, and
// those that are narrow across the way.
void Lattice::offer_shapes(const Entry& step, Vec2 forward) {
  for (int k = 0; k < static_cast<int>(p_.shapes.size()); ++k) {
    if (k == step.shape) continue;
    const std::optional<Vec2>& along = shape(k).along;
    if (along && std::abs(geom::cross(*along, forward)) > kAcross) continue;
    offer(step.node, step.move, k);
  }
}

bool Lattice::at_goal(const Node& here) {
  if (here.phase < meetings()) return false;
  if (!p_.goal) {
    const double stop = limits_.speed * limits_.speed / (2.0 * kStopShare * limits_.acceleration);
    return here.after >= stop;
  }
  if (geom::norm(middle(here.stand, here.shape) - p_.goal->center) > p_.goal->radius) return false;
  return !p_.goal->heading ||
         std::abs(geom::wrap_angle(here.stand.heading - *p_.goal->heading)) <= p_.goal->heading_tolerance;
}

std::uint64_t Lattice::bin(const Node& n) const {
  const auto index = [](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value)) + (1 << 20));
  };
  const auto heading = static_cast<std::int64_t>(std::floor(n.stand.heading * per_heading_ + 0.5));
  const std::int64_t turn = (heading % s_.headings + s_.headings) % s_.headings;
  // Which narrow shape leads to a pose matters little; told apart, they would only be searched many times.
  // Without a goal the way goes on after the last rendezvous until the team can stop.
  const bool stopping = n.phase == meetings() && !p_.goal;
  const auto phase = static_cast<std::uint64_t>(n.phase + (stopping ? static_cast<int>(n.after / step_) : 0));
  return (index((n.stand.at.x - p_.start.x) * per_cell_ + 0.5) << 42) |
         (index((n.stand.at.y - p_.start.y) * per_cell_ + 0.5) << 20) | phase << 8 |
         static_cast<std::uint64_t>(2 * turn + (n.move != nullptr && n.move->arc.gear() < 0 ? 1 : 0)) |
         (n.shape == 0 ? 0 : std::uint64_t{1} << 14);
}

// A step costs what it costs; what is left after it is not known yet, but no less than this.
void Lattice::offer(int index, int move, int shape_held) {
  const Node& parent = node(index);
  const double left = parent.estimate - parent.cost - s_.heuristic_weight * step_ / limits_.speed;
  const double cost = cost_of(parent, moves_[static_cast<std::size_t>(move)], shape_held);
  open_.push({cost + std::max(0.0, left), index, static_cast<std::int16_t>(move),
              static_cast<std::int16_t>(shape_held)});
}

// Where a step leads, if it can be driven and nothing as cheap has been there.
std::optional<Node> Lattice::check(const Entry& step) {
  const Node& parent = node(step.node);
  Node here = parent;
  here.move = &moves_[static_cast<std::size_t>(step.move)];
  here.stand = stand_after(parent.stand, here.move->way.back());
  here.cost = cost_of(parent, *here.move, step.shape);
  here.parent = step.node, here.shape = step.shape;
  here.closed = false;
  const int known = bins_.at(bin(here));
  if (known >= 0 && node(known).cost <= here.cost) return std::nullopt;
  if (!drive_to(here)) {
    if (here.shape == parent.shape) offer_shapes(step, here.stand.forward);
    return std::nullopt;
  }
  here.stand = stand_at({here.stand.at.x, here.stand.at.y, geom::wrap_angle(here.stand.heading)});
  here.estimate = here.cost + s_.heuristic_weight * ahead(here);
  return here;
}

// The cheapest in its bin?
bool Lattice::keep(const Node& here) {
  int& cheapest = bins_.at(bin(here));
  if (cheapest >= 0) {
    if (node(cheapest).cost <= here.cost) return false;
    node(cheapest).closed = true;
  }
  cheapest = static_cast<int>(nodes_.size());
  nodes_.push_back(here);
  return std::isfinite(here.estimate);
}

void Lattice::expand(int index) {
  const int held = node(index).shape;
  const bool back = held != 0 && node(index).phase < meetings();  // a rendezvous wants the first shape
  for (int move = 0; move < static_cast<int>(moves_.size()); ++move) {
    offer(index, move, held);
    if (back) offer(index, move, 0);
  }
}

std::optional<FormationPath> Lattice::run() {
  Node root{};
  root.stand = stand_at(p_.start);
  root.parent = -1;
  root.estimate = s_.heuristic_weight * ahead(root);
  if (!std::isfinite(root.estimate)) return std::nullopt;
  nodes_.push_back(root);
  open_.push({root.estimate, 0, -1, -1});
  double nearest = root.estimate;
  int nearest_at = 0;
  for (int expansions = 0; !open_.empty() && expansions < s_.max_expansions;) {
    Entry entry = open_.pop();
    if (entry.move >= 0) {
      const auto found = check(entry);
      if (!found || !keep(*found)) continue;
      entry = {found->estimate, static_cast<int>(nodes_.size()) - 1, -1, -1};
      // Whoever learns that it is further off than it looked waits for its turn.
      if (open_.any_before(entry.estimate)) {
        open_.push(entry);
        continue;
      }
    }
    Node& here = node(entry.node);
    if (here.closed) continue;
    if (at_goal(here)) return path_to(entry.node);
    here.closed = true;
    const double left = here.estimate - here.cost;
    if (left < nearest) nearest = left, nearest_at = expansions;
    if (expansions - nearest_at > s_.patience) break;
    if (++expansions % 64 == 0 && p_.deadline.expired()) break;
    expand(entry.node);
  }
  return std::nullopt;
}

FormationPath Lattice::path_to(int index) {
  FormationPath result;
  result.expansions = static_cast<int>(nodes_.size());
  std::vector<int> way;
  for (int at = index; at >= 0; at = node(at).parent) way.push_back(at);
  std::reverse(way.begin(), way.end());
  auto& points = result.path.points;
  const Arc* first = way.size() > 1 ? &node(way[1]).move->arc : nullptr;
  points.push_back(
      {0.0, p_.start, first != nullptr ? first->curvature : 0.0, first != nullptr ? first->gear() : 1});
  double s = 0.0;
  int phase = 0;
  result.shapes.push_back({0.0, 0.0, 0});
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Arc& arc = node(way[i]).move->arc;
    const Stand& stand = node(way[i - 1]).stand;
    const Pose2 from{stand.at.x, stand.at.y, stand.heading};
    if (points.back().gear != arc.gear()) points.push_back({s, from, arc.curvature, arc.gear()});
    points.back().curvature = arc.curvature;
    const int held = node(way[i]).shape;
    const bool changes = held != node(way[i - 1]).shape;
    if (changes) {
      const double complete = node(way[i]).held_since;
      result.shapes.push_back({complete - node(way[i]).change, complete, held});
    }
    for (int k = 1; k <= kChecks; ++k) {
      const double distance = arc.distance * k / kChecks;
      const Pose2 pose = vehicle::drive(from, arc.curvature, distance);
      points.push_back({s + std::abs(distance), pose, arc.curvature, arc.gear()});
      while (phase < meetings() && held == 0 && !changes &&
             geom::norm(middle(stand_at(pose), 0) - p_.meetings[static_cast<std::size_t>(phase)].point) <=
                 p_.meetings[static_cast<std::size_t>(phase)].reach) {
        result.meeting_s.push_back(s + std::abs(distance));
        ++phase;
      }
    }
    s += std::abs(arc.distance);
  }
  return result;
}

}  // namespace

FormationSearch::FormationSearch(FormationProblem problem)
    : problem_(std::make_unique<FormationProblem>(std::move(problem))),
      ground_(std::make_unique<FormationGround>(*problem_)) {}
FormationSearch::~FormationSearch() = default;

void FormationSearch::offer(std::vector<Formation> narrow) {
  std::ranges::move(narrow, std::back_inserter(problem_->shapes));
  ways_known_ = false;
}

std::optional<FormationPath> FormationSearch::find(const FormationSettings& settings) {
  if (settings.field && !ways_known_) {
    ground_->find_ways(problem_->shapes);
    ways_known_ = true;
  }
  return Lattice(*problem_, settings, *ground_).run();
}

}  // namespace seine::search
