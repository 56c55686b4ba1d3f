#include "seine/certify/limits.hpp"

#include <algorithm>
#include <cmath>

#include "seine/certify/tolerances.hpp"
#include "seine/net/catch_rules.hpp"

namespace seine::certify {
namespace {

// A cell halved this often is 2^-40 of itself: what is still open then hangs on rounding.
constexpr int kDeepest = 40;
// Of one car, and more for each cell: an hour at 99.99 % of a limit takes some 30 for each.
constexpr std::size_t kMostSteps = 1u << 18, kMostStepsOfCell = 1u << 8;
// Once a limit is broken there is nothing left to prove: how badly it and others are broken is worth less
// work.
constexpr std::size_t kMostStepsRefuted = 1u << 12, kMostStepsOfCellRefuted = 1u << 6;
// A value met beyond the limit is followed up until nothing in its cell is this much worse, relative to the
// limit.
constexpr double kWorstResolution = 1e-3;
enum RuleIndex : std::size_t { kForward, kReverse, kBackwards, kTangential, kBraking = 7, kCarrying };
static_assert(kCarrying + Context::kMostCarries <= 32, "a mask has 32 bits");

const char* describe(Kind kind) {
  switch (kind) {
    case Kind::speed:
      return "drives forwards at %s m/s; its limit is %s";
    case Kind::reverse_speed:
      return "drives backwards at %s m/s; its limit is %s";
    case Kind::acceleration:
      return "accelerates or brakes by %s m/s²; its limit is %s";
    case Kind::braking:
      return "accelerates or brakes by %s m/s² with something in the net; %s is allowed";
    case Kind::carrying:
      return "drives at %s m/s; faster than %s the air may blow out of the net what lies in it";
    case Kind::lateral_acceleration:
      return "has a lateral acceleration of %s m/s²; its limit is %s";
    case Kind::curvature:
      return "turns with a curvature of %s 1/m; its limit is %s";
    case Kind::steering_rate:
      return "turns its wheel at %s rad/s; its limit is %s";
    default:
      return "moves against its gear at %s m/s; rounding is granted %s";
  }
}

}  // namespace

LimitProof::Rule LimitProof::rule(Kind kind, Quantity quantity, double limit, double unit) {
  return {.kind = kind,
          .quantity = quantity,
          .sign = 0.0,
          .limit = limit,
          .seen = limit * (1.0 + tolerance::kLimitSeen) + tolerance::kLimitSeenFloor * unit,
          .proved = limit * (1.0 + tolerance::kLimitProved) + tolerance::kLimitProvedFloor * unit,
          .episodes = {}};
}

LimitProof::LimitProof(Context& context, int robot) : context_(context), robot_(robot) {
  const vehicle::Model& model =
      context.scenario.model_of(context.scenario.robots[static_cast<std::size_t>(robot)]);
  const vehicle::Limits& limits = model.limits;
  wheelbase_ = model.wheelbase;
  reach_ = model.reach();
  const Granted granted = granted_to(model);
  const double v = granted.pace, length = model.length(), a_unit = v * v / length;
  rules_ = {rule(Kind::speed, pace, limits.speed, v),
            rule(Kind::reverse_speed, pace, limits.reverse_speed, v),
            rule(Kind::gear, pace, granted.rest, v),
            rule(Kind::acceleration, tangential, limits.acceleration, a_unit),
            rule(Kind::lateral_acceleration, lateral, limits.lateral_acceleration, a_unit),
            rule(Kind::curvature, curvature, model.max_curvature(), 1.0 / length),
            rule(Kind::steering_rate, steering_rate, limits.steering_rate, v / length),
            rule(Kind::braking, tangential, net::kBraking, a_unit)};
  for (const Context::Carry& carry : context.carries) {
    rules_.push_back(rule(Kind::carrying, pace, carry.speed, v));
    rules_.back().other = carry.target;
  }
  rules_[kBackwards].sign = -1.0;
  rules_[kBackwards].seen = tolerance::kBackwardsSeen * granted.rest;
  rules_[kBackwards].proved = granted.rest;
}

double LimitProof::measure(const Rule& rule, const Sample& sample) {
  const double value = sample.value[rule.quantity];
  return rule.sign == 0.0 ? std::abs(value) : rule.sign * value;
}

void LimitProof::check(const Stretch& stretch, const Sample& a, const Sample& b, const Bends& bends,
                       int direction) {
  Mask mask = 0;
  ++cells_;
  monotone_ = direction != 0;
  for (std::size_t r = 0; r < rules_.size(); ++r) {
    rules_[r].worst = 0.0;
    if (r < kBraking && !std::isinf(rules_[r].limit)) mask |= 1u << r;
  }
  mask &= ~(1u << (stretch.drive.gear > 0.0 ? kReverse : kForward));
  if (direction > 0) mask &= ~(1u << kBackwards);
  cell_begin_ = stretch.clock(a.w);
  cell_end_ = stretch.clock(b.w);
  mask = unproved(mask, stretch, a, b, bends);
  if (mask != 0) refine(mask, stretch, a, b, 0);
  const bool harder = rules_[kTangential].limit > rules_[kBraking].limit;
  if (harder) check_from(context_.braking_from, kBraking, stretch, a, b, bends);
  for (std::size_t r = kCarrying; r < rules_.size(); ++r)
    check_from(context_.carries[r - kCarrying].from, r, stretch, a, b, bends);
}

void LimitProof::check_from(double begin, std::size_t rule, const Stretch& stretch, const Sample& a,
                            const Sample& b, const Bends& bends) {
  if (cell_end_ <= begin) return;
  const Mask only = 1u << rule;
  const Sample from = begin > cell_begin_ ? stretch.sample(stretch.local(begin), wheelbase_) : a;
  if (unproved(only, stretch, from, b, bends) != 0) refine(only, stretch, from, b, 0);
}

LimitProof::Mask LimitProof::unproved(Mask mask, const Stretch& stretch, const Sample& a, const Sample& b,
                                      const Bends& bends) {
  Mask open = 0;
  const double duration = (b.w - a.w) * stretch.drive.h, range = b.u - a.u;
  for (std::size_t r = 0; r < rules_.size(); ++r) {
    if ((mask & (1u << r)) == 0) continue;
    Rule& rule = rules_[r];
    const double at_a = measure(rule, a), at_b = measure(rule, b), top = std::max(at_a, at_b);
    if (!(top <= rule.seen)) {
      const double time = stretch.clock(at_a >= at_b ? a.w : b.w);
      rule.worst = std::max(rule.worst, top);
      rule.episodes.offer(cell_begin_, cell_end_, time, top, top - rule.limit);
      refuted_ = true;
    }
    const bool by_curve = rule.quantity == curvature && monotone_;
    const double width = by_curve ? range : duration;
    const double bend =
        rule.quantity == curvature && !monotone_ ? bends.curvature_by_time : bends.value[rule.quantity];
    const double bound = top + 0.125 * bend * width * width;
    const double wanted = rule.worst > 0.0 ? rule.worst + kWorstResolution * rule.limit : rule.proved;
    if (!(bends.least_length > 0.0 && bound <= wanted)) open |= 1u << r;
  }
  return open;
}

std::size_t LimitProof::most_steps() const {
  return refuted_ ? kMostStepsRefuted + kMostStepsOfCellRefuted * cells_
                  : kMostSteps + kMostStepsOfCell * cells_;
}

void LimitProof::refine(Mask mask, const Stretch& stretch, const Sample& a, const Sample& b, int depth) {
  if (++steps_ % 512 == 0) context_.out_of_time();
  if (depth >= kDeepest || steps_ > most_steps() || context_.expired.load(std::memory_order_relaxed)) {
    for (std::size_t r = 0; r < rules_.size(); ++r) {
      if ((mask & (1u << r)) == 0 || rules_[r].worst > 0.0 || rules_[r].undecided) continue;
      rules_[r].undecided = true;
      rules_[r].undecided_time = stretch.clock(a.w);
    }
    return;
  }
  const Sample middle = stretch.sample(0.5 * (a.w + b.w), wheelbase_);
  const std::array<const Sample*, 3> ends{&a, &middle, &b};
  for (std::size_t half = 0; half < 2; ++half) {
    const Sample &from = *ends[half], &to = *ends[half + 1];
    const Bends bends = stretch.bends(from.w, to.w, wheelbase_, reach_);
    if (const Mask open = unproved(mask, stretch, from, to, bends); open != 0) {
      refine(open, stretch, from, to, depth + 1);
    }
  }
}

std::vector<Finding> LimitProof::findings() const {
  std::vector<Finding> findings;
  const std::string name = context_.robot_name(robot_);
  for (const Rule& rule : rules_) {
    for (const Episodes::Episode& e : rule.episodes.all()) {
      char what[160];
      const auto [value, limit] = told_apart(e.value, rule.limit);
      std::snprintf(what, sizeof what, describe(rule.kind), value.c_str(), limit.c_str());
      findings.push_back({{rule.kind, e.time, robot_, rule.other, e.value, rule.limit,
                           format("%s at t = %.4f s %s", name.c_str(), e.time, what)},
                          e.excess});
    }
    if (rule.undecided) {
      findings.push_back({{Kind::undecided, rule.undecided_time, robot_, -1, 0.0, rule.limit,
                           format("%s: the limit %s could not be proved at t = %.4f s", name.c_str(),
                                  name_of(rule.kind), rule.undecided_time)},
                          0.0});
    }
  }
  return findings;
}

}  // namespace seine::certify
