#include "seine/certify/ring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seine/certify/slice_bounds.hpp"
#include "seine/certify/tolerances.hpp"
#include "seine/geom/polygon.hpp"
#include "seine/net/catch_rules.hpp"
#include "seine/net/shape.hpp"

namespace seine::certify {
namespace {

using geom::Vec2;

constexpr int kMostSteps = 1 << 18;     // of one team; sane plans need some hundred
constexpr double kShortestEdge = 1e-6;  // m: a shorter ring edge has no sides

}  // namespace

RingProof::RingProof(Context& context, const Formation& formation)
    : context_(context),
      net_(*context.scenario.net),
      formation_(formation),
      rest_area_(geom::signed_area(net_.rest)),
      levels_(static_cast<std::size_t>(kDeepest) + 1) {
  add_pairs_and_corners();
  while_loaded_ = always_;
  add_holding();
  while_held_ = while_loaded_;
  add(while_held_, {.sort = open, .limit = net::kHeldOpening, .episodes = {}});
}

void RingProof::add(Rules& list, Rule rule) {
  list.push_back(rules_.size());
  rules_.push_back(std::move(rule));
}

void RingProof::add_pairs_and_corners() {
  const std::size_t count = formation_.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const double longest = net_.stretch * net::rest_distance(net_, i, j);
      add(always_, {.sort = pair, .i = i, .j = j, .limit = longest, .episodes = {}});
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count, after = (i + 2) % count, before = (i + count - 1) % count;
    add(always_,
        {.sort = corner, .i = i, .j = j, .other = after, .limit = net::kConvexMargin, .episodes = {}});
    if (before == after) continue;
    add(always_,
        {.sort = corner, .i = i, .j = j, .other = before, .limit = net::kConvexMargin, .episodes = {}});
  }
}

void RingProof::add_holding() {
  const std::size_t count = formation_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    for (std::size_t k = 0; k < count; ++k) {
      if (k == i || k == j) continue;
      const double most = 2.0 * geom::dot(net_.rest[i] - net_.rest[k], net_.rest[j] - net_.rest[k]);
      add(while_loaded_, {.sort = hold, .i = i, .j = j, .other = k, .limit = most, .episodes = {}});
    }
  }
}

void RingProof::run() {
  check_start();
  glimpse();
  Rules left;
  const Rules* before = nullptr;  // the rules of the last beat, which were looked at where this one begins
  for (const Beat& beat : formation_.beats()) {
    const Slice slice = formation_.slice(beat);
    due_.clear();
    const Rules& rules = rules_on(beat);
    for (const std::size_t r : rules) {
      Rule& rule = rules_[r];
      if (beat.strayed_within <= rule.lasts) continue;
      due_.push_back(r);
      rule.worst = 0.0;
      if (before != &rules) look(rule, slice, slice.from, beat.t0);
      const double found = look(rule, slice, slice.to, beat.t1);
      rule.lasts = beat.strayed + reserve(rule, slice.to, found);
    }
    before = &rules;
    unproved(due_, slice, left);
    if (!left.empty()) refine(left, slice, 0);
  }
}

const RingProof::Rules& RingProof::rules_on(const Beat& beat) const {
  return beat.held ? while_held_ : beat.loaded ? while_loaded_ : always_;
}

/// Looks where the beats end: what has more room than the least met there need not be resolved.
void RingProof::glimpse() {
  for (const Beat& beat : formation_.beats()) {
    const Slice slice = formation_.slice(beat);
    for (const std::size_t r : rules_on(beat)) {
      Rule& rule = rules_[r];
      if (beat.strayed <= rule.lasts) continue;
      rule.lasts = beat.strayed + reserve(rule, slice.to, look(rule, slice, slice.to, beat.t1));
    }
  }
  for (Rule& rule : rules_) rule.lasts = -1.0;
}

// With every attachment moved by s at most (and all by anything in common):
//   a distance changes by 2 s;
//   a vector product u·v by 2 s (|u| + |v|) + 4 s², which for s ≤ (|u| + |v|) / 10 is 2.4 s (|u| + |v|) at
//   most;
//   the distance n·f from an edge e by 2 s + |n' − n| |f'|, and for s ≤ |e| / 4 the normal turns by no more
//   than asin(2 s / |e|) ≤ 2.1 s / |e|, while |f'| ≤ |f| + |e| / 2.
double RingProof::reserve(const Rule& rule, std::span<const Vec2> at, double room) const {
  constexpr double kRounding = 1e-9;  // m, or m²
  const double spare = room - std::max(0.0, closest_[rule.sort].clearance) - kRounding;
  if (!(spare > 0.0) || rule.sort == open) return -1.0;
  if (rule.sort == pair) return spare / 2.0;
  if (rule.sort == hold) {
    const double lengths = geom::norm(at[rule.i] - at[rule.other]) + geom::norm(at[rule.j] - at[rule.other]);
    return std::min(0.1 * lengths, spare / (4.8 * lengths));
  }
  const double edge = geom::norm(at[rule.j] - at[rule.i]), to_other = geom::norm(at[rule.other] - at[rule.i]);
  return std::min(0.25 * edge, spare / (2.0 + 2.1 * (to_other + 0.5 * edge) / edge));
}

/// Left turns only, the ring could still wind round more than once; how often never changes.
void RingProof::check_start() {
  const auto at = formation_.slice(formation_.beats().front()).from;
  double turning = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Vec2 middle = at[(i + 1) % at.size()];
    const Vec2 in = middle - at[i], out = at[(i + 2) % at.size()] - middle;
    turning += std::atan2(geom::cross(in, out), geom::dot(in, out));
  }
  const double rounds = turning / (2.0 * std::numbers::pi);
  if (std::abs(rounds - 1.0) < 0.1) return;
  start_.push_back(
      {{Kind::net_topology, 0.0, -1, -1, rounds, 1.0,
        format("the ring of the net winds %.1f times counter-clockwise at t = 0, not once", rounds)},
       std::abs(rounds - 1.0)});
}

double RingProof::room(const Rule& rule, std::span<const Vec2> at) const {
  if (rule.sort == open) return net::opening(net_, at) - rule.limit;
  if (rule.sort == hold)  // G_ik + G_jk − G_ij of net::holding_reserve, written as a product
    return rule.limit - 2.0 * geom::dot(at[rule.i] - at[rule.other], at[rule.j] - at[rule.other]);
  const Vec2 edge = at[rule.j] - at[rule.i];
  const double length = geom::norm(edge);
  if (rule.sort == pair) return rule.limit - length;
  if (length < kShortestEdge) return -rule.limit;
  return geom::cross(edge, at[rule.other] - at[rule.i]) / length - rule.limit;
}

bool RingProof::keeps(const Rule& rule, const Slice& slice, double wanted) const {
  switch (rule.sort) {
    case pair:
      return rule.limit - furthest_apart(slice, rule.i, rule.j) >= wanted;
    case corner:
      return stays_inside(slice, rule.i, rule.j, rule.other, rule.limit + wanted);
    case hold:
      return rule.limit - 2.0 * largest_dot(slice, rule.i, rule.j, rule.other) >= wanted;
    default: {
      const double opening = rule.limit + wanted;
      return opening <= 0.0 || least_area(slice) >= opening * opening * rest_area_;
    }
  }
}

double RingProof::look(Rule& rule, const Slice& slice, std::span<const Vec2> at, double time) {
  const double found = room(rule, at);
  Closest& closest = closest_[rule.sort];
  if (found < closest.clearance) {
    closest = {found, time, static_cast<int>(rule.i),
               static_cast<int>(rule.sort == pair ? rule.j : rule.other)};
  }
  if (found >= -tolerance::kNetSeen) return found;
  rule.worst = std::min(rule.worst, found);
  rule.episodes.offer(slice.beat->t0, slice.beat->t1, time, found, -found);
  return found;
}

/// A broken rule is followed to its worst, others to the least room of all.
double RingProof::wanted(const Rule& rule) const {
  const double resolution = rule.sort == hold ? kReserveResolution : kNetResolution;
  if (rule.worst < 0.0) return rule.worst - resolution;
  return std::max(-tolerance::kNetProved, closest_[rule.sort].clearance - resolution);
}

void RingProof::unproved(const Rules& rules, const Slice& slice, Rules& open_rules) {
  open_rules.clear();
  for (const std::size_t r : rules) {
    if (!keeps(rules_[r], slice, wanted(rules_[r]))) open_rules.push_back(r);
  }
}

void RingProof::refine(const Rules& rules, const Slice& slice, int depth) {
  if (++steps_ % 512 == 0) context_.out_of_time();
  if (depth >= kDeepest || steps_ > kMostSteps || context_.expired.load(std::memory_order_relaxed))
    return give_up(rules, slice.t0);
  Level& level = levels_[static_cast<std::size_t>(depth)];
  const double middle = 0.5 * (slice.t0 + slice.t1);
  level.middle.resize(formation_.size());
  formation_.place(*slice.beat, middle, level.middle);
  for (const std::size_t r : rules) look(rules_[r], slice, level.middle, middle);
  Slice halves[2] = {slice, slice};
  halves[0].t1 = halves[1].t0 = middle;
  halves[0].to = halves[1].from = level.middle;
  for (const Slice& half : halves) {
    unproved(rules, half, level.open);
    if (!level.open.empty()) refine(level.open, half, depth + 1);
  }
}

void RingProof::give_up(const Rules& rules, double time) {
  for (const std::size_t r : rules) {
    Rule& rule = rules_[r];
    if (rule.worst < 0.0 || rule.undecided) continue;
    rule.undecided = true;
    rule.undecided_time = time;
  }
}

std::string RingProof::name(const Rule& rule) const {
  const auto robot = [this](std::size_t k) { return context_.robot_name(static_cast<int>(k)); };
  if (rule.sort == pair) return robot(rule.i) + " and " + robot(rule.j);
  return robot(rule.other) + " and the net between " + robot(rule.i) + " and " + robot(rule.j);
}

Finding RingProof::finding(const Rule& rule, const Episodes::Episode& e) const {
  const int i = static_cast<int>(rule.i), j = static_cast<int>(rule.j), other = static_cast<int>(rule.other);
  if (rule.sort == pair) {
    const double found = rule.limit - e.value;
    return {{Kind::net_stretch, e.time, i, j, found, rule.limit,
             format("%s hold the net %.4f m apart at t = %.4f s; %.4f m is allowed", name(rule).c_str(),
                    found, e.time, rule.limit)},
            e.excess};
  }
  if (rule.sort == hold) {
    return {
        {Kind::net_holding, e.time, -1, -1, e.value, 0.0,
         format("what lies in the net can roll out between %s and %s at t = %.4f s: the holding reserve is "
                "%.4f m², 0 is required",
                context_.robot_name(i).c_str(), context_.robot_name(j).c_str(), e.time, e.value)},
        e.excess};
  }
  const double found = rule.limit + e.value;
  if (rule.sort == open) {
    return {{Kind::net_opening, e.time, -1, -1, found, rule.limit,
             format("the net is open to %.4f at t = %.4f s, soon after a catch; %.4f is required", found,
                    e.time, rule.limit)},
            e.excess};
  }
  return {{Kind::net_topology, e.time, other, i, found, rule.limit,
           format("%s is %.4f m inside the edge of the net from %s to %s at t = %.4f s; %.4f m is required",
                  context_.robot_name(other).c_str(), found, context_.robot_name(i).c_str(),
                  context_.robot_name(j).c_str(), e.time, rule.limit)},
          e.excess};
}

std::vector<Finding> RingProof::findings() const {
  std::vector<Finding> findings = start_;
  for (const Rule& rule : rules_) {
    for (const Episodes::Episode& e : rule.episodes.all()) findings.push_back(finding(rule, e));
    if (!rule.undecided) continue;
    const std::string what = rule.sort == open ? "the opening of the net" : name(rule);
    findings.push_back({{Kind::undecided, rule.undecided_time, -1, -1, 0.0, rule.limit,
                         format("%s: size and shape of the net could not be proved at t = %.4f s",
                                what.c_str(), rule.undecided_time)},
                        0.0});
  }
  return findings;
}

}  // namespace seine::certify
