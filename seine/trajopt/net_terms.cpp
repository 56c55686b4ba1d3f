#include "seine/trajopt/net_terms.hpp"

#include <algorithm>
#include <cmath>

#include "seine/constraint/catch_velocity.hpp"
#include "seine/constraint/delivery.hpp"
#include "seine/constraint/net_clearance.hpp"
#include "seine/constraint/net_edge.hpp"
#include "seine/constraint/net_hold.hpp"
#include "seine/constraint/net_opening.hpp"
#include "seine/constraint/net_radius.hpp"
#include "seine/constraint/net_spread.hpp"
#include "seine/constraint/net_stretch.hpp"
#include "seine/math/hinge.hpp"
#include "seine/net/shape.hpp"

namespace seine::trajopt {
namespace {

using geom::Vec2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Half the time over which the formation's velocity at a catch is taken, s.
constexpr double kVelocitySpan = 0.04;
// What is further from the net than this (m) is not watched until the next refresh.
constexpr double kSkin = 0.8;
// A low obstacle this near to the net (m) is taken for under it.
constexpr double kNearLow = 0.15;
// Shares by which the size limits are tightened, for what happens between ticks.
constexpr double kTighten = 0.005;
constexpr double kCarryTighten = 0.03;  // of the speed, which is a mean between ticks

NetTask scaled(NetTask task, const Units& units) {
  const double l = 1.0 / units.length, t = 1.0 / units.time, v = units.time / units.length;
  for (Vec2& r : task.net.rest) r *= l;
  for (net::Attachment& a : task.net.attachments) a.at *= l, a.height *= l;
  task.net.clearance *= l;
  for (CatchTask& c : task.catches) {
    c.time *= t, c.contact_delay *= t, c.hold *= t, c.lean *= t * t;
    c.point *= l;
    c.margin *= l, c.contact_margin *= l, c.least_spread *= l, c.most_radius *= l;
    c.velocity *= v, c.most_sideways *= v;
  }
  for (CarryTask& c : task.carries) c.from *= t, c.speed *= v;
  task.loaded_from *= t;
  if (task.delivery) task.delivery->center *= l, task.delivery->radius *= l;
  for (LowObstacle& low : task.low) {
    for (Vec2& p : low.shape.core) p *= l;
    low.shape.radius *= l, low.height *= l;
  }
  task.obstacle_slack *= l, task.spread_slack *= l;
  task.holding_reserve *= l * l;
  return task;
}

}  // namespace

NetTerms::NetTerms(const NetTask& task, const Units& units, const Settings& settings, double tick, int stride)
    : task_(scaled(task, units)),
      settings_(settings),
      stride_(stride),
      tick_(tick),
      tick_weight_(settings.penalty * settings.net_penalty * tick * stride),
      moment_weight_(settings.penalty * settings.catch_penalty),
      slack_(settings.clearance_slack) {
  const std::vector<Vec2>& rest = task_.net.rest;
  for (const Vec2 a : rest)
    for (const Vec2 b : rest) rest_.push_back(geom::norm(a - b));
  std::vector<Vec2> unused(rest.size());
  rest_spread_ = constraint::net_spread(rest, unused);
  rest_opening_ = constraint::net_opening(rest, unused);
  if (task_.tall != nullptr)
    for (const world::StaticMap::Piece& piece : task_.tall->pieces()) {
      tall_.push_back(piece.shape.core);
      for (Vec2& p : tall_.back()) p *= 1.0 / units.length;
    }
  const double span = kVelocitySpan / units.time;
  for (const CatchTask& c : task_.catches) {
    const std::size_t first = moments_.size();
    catches_.push_back({first, first + 1, first + 2, c});
    moments_.insert(moments_.end(), {c.time, c.time - span, c.time + span});
  }
  moments_.push_back(kInfinity);
  units_length_ = units.length;
}

// The spread that lets the net hang no deeper than `depth`.
double NetTerms::spread_for(double depth) const {
  const double squared = rest_spread_ * rest_spread_ - std::max(0.0, depth) * std::max(0.0, depth);
  return std::sqrt(std::max(0.0, squared));
}

void NetTerms::place(std::span<const ClockState> states, std::size_t first, std::size_t row,
                     Ring& ring) const {
  const std::size_t n = task_.net.size();
  ring.at.resize(n), ring.scratch.resize(n);
  ring.gradient.assign(n, {});
  for (std::size_t k = 0; k < n; ++k) {
    const ClockState& s = states[k * row + first];
    const Vec2 at = task_.net.attachments[k].at;
    ring.at[k] = s.position + at.x * s.direction + at.y * geom::left_normal(s.direction);
  }
}

void NetTerms::pull(std::span<ClockState> states, std::size_t first, std::size_t row,
                    const Ring& ring) const {
  for (std::size_t k = 0; k < task_.net.size(); ++k) {
    ClockState& s = states[k * row + first];
    const Vec2 at = task_.net.attachments[k].at, g = ring.gradient[k];
    s.g_position += g;
    s.g_direction += Vec2{at.x * g.x + at.y * g.y, at.x * g.y - at.y * g.x};
  }
}

void NetTerms::rebuild(std::span<const ClockState> states, int ticks, int row) {
  looks_.assign(static_cast<std::size_t>((ticks + stride_ - 1) / stride_), {});
  Ring ring;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const std::size_t tick = i * static_cast<std::size_t>(stride_);
    place(states, tick, static_cast<std::size_t>(row), ring);
    look_at(looks_[i], static_cast<double>(tick) * tick_, ring.at);
  }
}

void NetTerms::look_at(Look& look, double time, std::span<const Vec2> ring) {
  geom::Box box = geom::bounding_box(ring);
  if (task_.tall != nullptr) {
    const geom::Box wide = geom::Box{units_length_ * box.low, units_length_ * box.high}.inflated(kSkin);
    task_.tall->for_each_near(wide, [&](const world::StaticMap::Piece& piece) {
      const auto index = static_cast<std::size_t>(&piece - task_.tall->pieces().data());
      look.tall.emplace_back(&tall_[index],
                             piece.shape.radius / units_length_ + slack_ + task_.obstacle_slack);
    });
  }
  double highest = 0.0;
  for (const LowObstacle& low : task_.low)
    if (geom::distance(ring, low.shape.core) - low.shape.radius < kNearLow / units_length_)
      highest = std::max(highest, low.height);
  const double free = task_.net.rim() - task_.net.clearance - highest;
  look.loaded = time >= task_.loaded_from;
  look.least_spread = spread_for(free) + task_.spread_slack;
  for (const CatchTask& c : task_.catches)
    if (time >= c.time && time <= c.time + c.hold) look.opening = std::max(look.opening, c.held_opening);
}

double NetTerms::at_ticks(int chunk, std::span<ClockState> states, int row, double knee) const {
  const std::size_t count = looks_.size(), from = count * static_cast<std::size_t>(chunk) / kChunks,
                    to = count * static_cast<std::size_t>(chunk + 1) / kChunks;
  double cost = 0.0;
  Ring ring;
  for (std::size_t i = from; i < to; ++i) {
    const std::size_t tick = i * static_cast<std::size_t>(stride_);
    place(states, tick, static_cast<std::size_t>(row), ring);
    cost += at_tick(looks_[i], ring, knee);
    pull(states, tick, static_cast<std::size_t>(row), ring);
  }
  return cost;
}

double NetTerms::on_the_way(std::span<ClockState> states, int row, double knee) const {
  double cost = 0.0;
  const double span = stride_ * tick_;
  for (const CarryTask& carry : task_.carries)
    for (std::size_t i = 0; i + 1 < looks_.size(); ++i) {
      if (static_cast<double>(i + 1) * span <= carry.from) continue;
      for (std::size_t k = 0; k < task_.net.size(); ++k) {
        const std::size_t tick = k * static_cast<std::size_t>(row) + i * static_cast<std::size_t>(stride_);
        ClockState &from = states[tick], &to = states[tick + static_cast<std::size_t>(stride_)];
        Vec2 g_from, g_to;
        const double excess = constraint::catch_velocity(from.position, to.position, span, {},
                                                         (1.0 - kCarryTighten) * carry.speed, g_from, g_to);
        if (excess <= 0.0) continue;
        double slope;
        cost += tick_weight_ * math::hinge(excess, knee, slope);
        from.g_position += (tick_weight_ * slope) * g_from;
        to.g_position += (tick_weight_ * slope) * g_to;
      }
    }
  return cost;
}

double NetTerms::at_tick(const Look& look, Ring& ring, double knee) const {
  double cost = 0.0;
  if (task_.size) cost += size_cost(look, ring, knee);
  if (task_.size && look.loaded) cost += hold_cost(ring, knee);
  cost += shape_cost(look, ring, knee);
  for (const auto& [core, clearance] : look.tall) {
    const double gap = constraint::net_clearance(ring.at, *core, ring.scratch);
    if (gap >= clearance) continue;
    double slope;
    cost += tick_weight_ * math::hinge(clearance - gap, knee, slope);
    for (std::size_t k = 0; k < ring.at.size(); ++k)
      ring.gradient[k] -= (tick_weight_ * slope) * ring.scratch[k];
  }
  return cost;
}

// Never stretched, never dragging.
double NetTerms::size_cost(const Look& look, Ring& ring, double knee) const {
  const std::size_t n = ring.at.size();
  double cost = 0.0, slope;
  const auto pay = [&](double excess, std::size_t i, std::size_t j, Vec2 g_i, Vec2 g_j) {
    if (excess <= 0.0) return;
    cost += tick_weight_ * math::hinge(excess, knee, slope);
    ring.gradient[i] += (tick_weight_ * slope) * g_i;
    ring.gradient[j] += (tick_weight_ * slope) * g_j;
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      Vec2 g_i, g_j;
      const double most = (1.0 - kTighten) * task_.net.stretch * rest_[i * n + j];
      pay(constraint::net_stretch(ring.at[i], ring.at[j], most, g_i, g_j), i, j, g_i, g_j);
    }
  if (look.least_spread > 0.0) {
    const double spread = constraint::net_spread(ring.at, ring.scratch);
    const double excess = (1.0 + kTighten) * look.least_spread - spread;
    cost += tick_weight_ * math::hinge(excess, knee, slope);
    for (std::size_t k = 0; k < n; ++k) ring.gradient[k] -= (tick_weight_ * slope) * ring.scratch[k];
  }
  return cost;
}

// What lies in the net does not roll out over an edge.
double NetTerms::hold_cost(Ring& ring, double knee) const {
  const std::size_t n = ring.at.size();
  const std::vector<Vec2>& rest = task_.net.rest;
  const double reserve = task_.holding_reserve;
  double cost = 0.0, slope;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0, j = (i + 1) % n; k < n; ++k) {
      if (k == i || k == j) continue;
      Vec2 g_i, g_j, g_k;
      const double at_rest = geom::dot(rest[i] - rest[k], rest[j] - rest[k]);
      const double excess =
          constraint::net_hold(ring.at[i], ring.at[j], ring.at[k], at_rest, reserve, g_i, g_j, g_k);
      if (excess <= 0.0) continue;
      cost += tick_weight_ * math::hinge(excess, knee, slope);
      ring.gradient[i] += (tick_weight_ * slope) * g_i;
      ring.gradient[j] += (tick_weight_ * slope) * g_j;
      ring.gradient[k] += (tick_weight_ * slope) * g_k;
    }
  return cost;
}

// Convex and counter-clockwise, and open where a catch wants it.
double NetTerms::shape_cost(const Look& look, Ring& ring, double knee) const {
  const std::size_t n = ring.at.size();
  double cost = 0.0, slope;
  if (task_.topology) {
    const double margin = net::kConvexMargin / units_length_ + slack_;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t next = (i + 1) % n, after = (i + 2) % n, before = (i + n - 1) % n;
      for (const std::size_t j : {after, before}) {
        if (j == before && before == after) continue;  // a triangle has one
        constraint::EdgeGradient g;
        const double excess = margin - constraint::net_edge(ring.at[i], ring.at[next], ring.at[j], g);
        if (excess <= 0.0) continue;
        cost += tick_weight_ * math::hinge(excess, knee, slope);
        ring.gradient[i] -= (tick_weight_ * slope) * g.a;
        ring.gradient[next] -= (tick_weight_ * slope) * g.b;
        ring.gradient[j] -= (tick_weight_ * slope) * g.p;
      }
    }
  }
  if (look.opening > 0.0) {
    const double opening = constraint::net_opening(ring.at, ring.scratch);
    cost +=
        tick_weight_ * math::hinge((1.0 + kTighten) * look.opening * rest_opening_ - opening, knee, slope);
    for (std::size_t k = 0; k < n; ++k) ring.gradient[k] -= (tick_weight_ * slope) * ring.scratch[k];
  }
  return cost;
}

double NetTerms::at_moments(std::span<ClockState> states, double knee) const {
  double cost = delivery_cost(states, knee);
  for (const Catch& c : catches_) cost += catch_cost(c, states, knee);
  return cost;
}

// A hinge on every ring edge: the margin is reached, and nothing beyond it is paid for. (The letter's cost is
// linear in the distance to the nearest edge, Eqs. 17-19: it has no weight that asks for a margin.)
double NetTerms::inside(Ring& ring, Vec2 point, double margin, double knee, Vec2& g_point) const {
  const std::size_t n = ring.at.size();
  double cost = 0.0, slope;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    constraint::EdgeGradient g;
    const double excess = margin + slack_ - constraint::net_edge(ring.at[i], ring.at[next], point, g);
    if (excess <= 0.0) continue;
    cost += moment_weight_ * math::hinge(excess, knee, slope);
    ring.gradient[i] -= (moment_weight_ * slope) * g.a;
    ring.gradient[next] -= (moment_weight_ * slope) * g.b;
    g_point -= (moment_weight_ * slope) * g.p;
  }
  return cost;
}

// How open the net is, and how deep it hangs.
double NetTerms::opening_cost(const Catch& c, Ring& ring, double knee) const {
  double cost = 0.0, slope;
  const auto pay = [&](double excess, double sign) {
    if (excess <= 0.0) return;
    cost += moment_weight_ * math::hinge(excess, knee, slope);
    for (std::size_t k = 0; k < ring.at.size(); ++k)
      ring.gradient[k] += (sign * moment_weight_ * slope) * ring.scratch[k];
  };
  const double opening = constraint::net_opening(ring.at, ring.scratch);
  pay((1.0 + kTighten) * c.task.least_opening * rest_opening_ - opening, -1.0);
  pay(c.task.least_spread - constraint::net_spread(ring.at, ring.scratch), -1.0);
  for (std::size_t k = 0; std::isfinite(c.task.most_radius) && k < ring.at.size(); ++k)
    pay(constraint::net_radius(ring.at, k, ring.scratch) - c.task.most_radius, 1.0);
  return cost;
}

double NetTerms::catch_cost(const Catch& c, std::span<ClockState> states, double knee) const {
  const std::size_t row = moments_.size();
  const double share = 1.0 / static_cast<double>(task_.net.size()),
               span = moments_[c.after] - moments_[c.before];
  Ring rim, before, after;
  place(states, c.rim, row, rim);
  place(states, c.before, row, before);
  place(states, c.after, row, after);
  const double half = 0.5 * span;
  Vec2 p, m, q, g_p, g_q, g_contact, g_settled, unused;
  for (const Vec2 a : before.at) p += share * a;
  for (const Vec2 a : rim.at) m += share * a;
  for (const Vec2 a : after.at) q += share * a;
  double cost = inside(rim, c.task.point, c.task.margin, knee, unused);
  cost += opening_cost(c, rim, knee);
  // Seen from the net, the target goes on straight from the rim to the contact.
  const Vec2 contact = c.task.point + c.task.contact_delay * (c.task.velocity - (q - p) / span);
  cost += inside(rim, contact, c.task.contact_margin, knee, g_contact);
  // As the net speeds up, what lies in it weighs backwards.
  const double lean = c.task.lean / (half * half);
  cost += inside(rim, contact - lean * (p - 2.0 * m + q), c.task.contact_margin, knee, g_settled);
  const double excess =
      constraint::catch_velocity(p, q, span, c.task.velocity, c.task.most_sideways, g_p, g_q);
  double slope;
  cost += moment_weight_ * math::hinge(excess, knee, slope);
  const Vec2 drift = (c.task.contact_delay / span) * (g_contact + g_settled), sway = lean * g_settled;
  for (Vec2& g : before.gradient) g = share * (moment_weight_ * slope * g_p + drift - sway);
  for (Vec2& g : after.gradient) g = share * (moment_weight_ * slope * g_q - drift - sway);
  for (Vec2& g : rim.gradient) g += (2.0 * share) * sway;
  pull(states, c.rim, row, rim);
  pull(states, c.before, row, before);
  pull(states, c.after, row, after);
  return cost;
}

double NetTerms::delivery_cost(std::span<ClockState> states, double knee) const {
  if (!task_.delivery) return 0.0;
  const std::size_t row = moments_.size(), end = row - 1, n = task_.net.size();
  Ring ring;
  place(states, end, row, ring);
  Vec2 middle, g;
  for (const Vec2 a : ring.at) middle += a / static_cast<double>(n);
  double slope;
  const double excess =
      constraint::delivery(middle, task_.delivery->center, task_.delivery->radius - slack_, g);
  double cost = moment_weight_ * math::hinge(excess, knee, slope);
  for (Vec2& gradient : ring.gradient) gradient = (moment_weight_ * slope / static_cast<double>(n)) * g;
  pull(states, end, row, ring);
  if (!task_.delivery->heading) return cost;
  const Vec2 wanted = geom::unit(*task_.delivery->heading);
  for (std::size_t k = 0; k < n; ++k) {
    ClockState& s = states[k * row + end];
    const double off = constraint::delivery_heading(s.direction, wanted, 0.0, g);
    // Twice the heading's distance, so that the hinge is about an angle and not about its square.
    const double most = 1.0 - std::cos(0.8 * kDeliveryHeading);
    cost += moment_weight_ * math::hinge((off - most) / kDeliveryHeading, knee, slope);
    s.g_direction += (moment_weight_ * slope / kDeliveryHeading) * g;
  }
  return cost;
}

}  // namespace seine::trajopt
