#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "seine/search/formation_shot.hpp"
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
constexpr double kShapePrice = 0.3;   // of v / a, s
constexpr double kAcross = 0.4;       // sine of the angle to its direction at which a narrow shape is of use
constexpr double kLeastChange = 0.3;  // of the length that a change of shape is given
constexpr double kSwerve = 2.0;       // a car's pace aside, of its pace ahead, while the shape changes
// From where the last part of the way is looked for at once, and every how many expansions elsewhere. A goal
// that steps hit anyway, less than this wide of a step, is left to them after a catch.
constexpr double kShotReach = 4.0;
constexpr int kShotEvery = 8;
constexpr double kEasyGoal = 0.45;
constexpr double kStopShare = 0.6;  // of the acceleration limit, to stop after the last rendezvous

Pose2 pose_of(const Stand& stand) {
  return {stand.at.x, stand.at.y, stand.heading};
}

// Adds an arc to a way; returns where it ends.
Pose2 append(Path& path, const Pose2& from, const Arc& arc) {
  auto& points = path.points;
  const double s = path.length();
  if (points.empty() || points.back().gear != arc.gear())
    points.push_back({s, from, arc.curvature, arc.gear()});
  points.back().curvature = arc.curvature;
  for (int k = 1; k <= kChecks; ++k) {
    const double distance = arc.distance * k / kChecks;
    points.push_back(
        {s + std::abs(distance), vehicle::drive(from, arc.curvature, distance), arc.curvature, arc.gear()});
  }
  return points.back().pose;
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
        to_stop_(problem.start_speed * problem.start_speed / (2.0 * kStopShare * limits_.acceleration)),
        open_(kSlice * limits_.length / limits_.speed) {
    if (p_.goal) shots_.emplace(*p_.goal, limits_, ground_, s_.forward, s_.backward);
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
  bool worth_a_shot(const Node& here, int expansions);
  void shoot(int index);
  int meetings_at_start();
  void offer(int parent, int move, int shape);
  std::uint64_t bin(const Node& node) const;
  Node& node(int index) { return nodes_[static_cast<std::size_t>(index)]; }
  FormationPath path_to(int index);
  void pass_meetings(const Pose2& pose, double s, int& phase, FormationPath& result, int most);

  const FormationProblem& p_;
  const FormationSettings& s_;
  FormationGround& ground_;
  const world::Scenario& scenario_;
  TeamLimits limits_;
  double step_, per_cell_, per_heading_;
  double to_stop_;  // m that a moving start needs
  std::vector<Move> moves_;
  std::vector<double> beyond_;  // per phase: m from the next place to the end of the way, at least
  Formation between_;           // room
  std::vector<Node> nodes_;
  Waiting open_;
  Bins bins_;
  std::optional<FormationShots> shots_;
  std::vector<FormationShot> found_;
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
  Move move{arc, limits_.time_of(arc), {}};
  for (int i = 0; i < kChecks; ++i)
    move.way[static_cast<std::size_t>(i)] =
        stand_at(vehicle::drive(Pose2{}, arc.curvature, arc.distance * (i + 1) / kChecks));
  return move;
}

double Lattice::cost_of(const Node& parent, const Move& move, int shape_held) const {
  const double shape = shape_held != parent.shape ? kShapePrice * limits_.speed / limits_.acceleration : 0.0;
  const Arc* before = parent.parent < 0 ? nullptr : &parent.move->arc;
  return parent.cost + move.time + shape + limits_.time_between(before, move.arc);
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

bool Lattice::worth_a_shot(const Node& here, int expansions) {
  if (!shots_ || here.phase < meetings() || here.shot >= 0) return false;
  if (here.parent < 0) return true;
  if (!p_.goal->heading && p_.goal->radius > kEasyGoal * step_) return false;
  const double left = geom::norm(middle(here.stand, here.shape) - p_.goal->center);
  return left < kShotReach * limits_.length || expansions % kShotEvery == 0;
}

// Straight to the goal, if that is clear; it competes with everything else that waits.
void Lattice::shoot(int index) {
  const Node& from = node(index);
  auto shot = shots_->from(from.stand, shape(from.shape), from.parent < 0 ? nullptr : &from.move->arc,
                           s_.straight_to_goal.value_or(0.0) * limits_.length);
  if (!shot) return;
  double first_leg = 0.0;
  for (const Arc& arc : shot->arcs) {
    if (arc.gear() != shot->arcs.front().gear()) break;
    first_leg += std::abs(arc.distance);
  }
  if (from.parent < 0 && (first_leg < to_stop_ || p_.start_speed * shot->arcs.front().gear() < 0.0)) return;
  Node end = from;
  end.parent = index, end.shot = static_cast<int>(found_.size());
  end.cost = end.estimate = from.cost + shot->cost;
  end.closed = false;
  found_.push_back(std::move(*shot));
  nodes_.push_back(end);
  open_.push({end.estimate, static_cast<int>(nodes_.size()) - 1, -1, -1});
}

bool Lattice::at_goal(const Node& here) {
  if (here.shot >= 0) return true;
  if (here.s < to_stop_) return false;
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

// A team that stands where it is to meet something can wait there.
int Lattice::meetings_at_start() {
  FormationPath passed;
  int phase = 0;
  pass_meetings(p_.start, 0.0, phase, passed, meetings());
  return phase;
}

std::optional<FormationPath> Lattice::run() {
  Node root{};
  root.stand = stand_at(p_.start);
  root.parent = -1;
  if (s_.wait_at_start && p_.start_speed == 0.0) root.phase = meetings_at_start();
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
    if (here.parent >= 0 && at_goal(here)) return path_to(entry.node);
    here.closed = true;
    const double left = here.estimate - here.cost;
    if (left < nearest) nearest = left, nearest_at = expansions;
    if (expansions - nearest_at > s_.patience) break;
    if (++expansions % 64 == 0 && p_.deadline.expired()) break;
    if (!s_.straight_to_goal) expand(entry.node);
    if (worth_a_shot(node(entry.node), expansions)) shoot(entry.node);
  }
  return std::nullopt;
}

FormationPath Lattice::path_to(int index) {
  FormationPath result;
  result.expansions = static_cast<int>(nodes_.size());
  std::vector<int> way;
  for (int at = index; at >= 0; at = node(at).parent) way.push_back(at);
  std::reverse(way.begin(), way.end());
  result.shapes.push_back({0.0, 0.0, 0});
  int phase = 0;
  pass_meetings(p_.start, 0.0, phase, result, node(way.front()).phase);
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Node& here = node(way[i]);
    Pose2 from = pose_of(node(way[i - 1]).stand);
    if (here.shot >= 0) {
      for (const Arc& arc : found_[static_cast<std::size_t>(here.shot)].arcs)
        from = append(result.path, from, arc);
      continue;
    }
    const bool changes = here.shape != node(way[i - 1]).shape;
    if (changes) result.shapes.push_back({here.held_since - here.change, here.held_since, here.shape});
    const std::size_t first = result.path.points.size();
    append(result.path, from, here.move->arc);
    if (here.shape != 0 || changes) continue;
    for (std::size_t k = first; k < result.path.points.size(); ++k)
      pass_meetings(result.path.points[k].pose, result.path.points[k].s, phase, result, meetings());
  }
  return result;
}

// Notes which rendezvous are passed at a pose.
void Lattice::pass_meetings(const Pose2& pose, double s, int& phase, FormationPath& result, int most) {
  const Vec2 at = middle(stand_at(pose), 0);
  for (; phase < most; ++phase) {
    const Rendezvous& meeting = p_.meetings[static_cast<std::size_t>(phase)];
    if (geom::norm(at - meeting.point) > meeting.reach) break;
    result.meeting_s.push_back(s);
  }
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
