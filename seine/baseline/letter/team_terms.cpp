#include "seine/baseline/letter/team_terms.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "seine/baseline/letter/catch_cost.hpp"
#include "seine/constraint/net_edge.hpp"
#include "seine/constraint/net_stretch.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Vec2;

/// More robots than this do not hold one net.
constexpr std::size_t kMostInRing = 64;

bool disjoint(const geom::Box& a, const geom::Box& b) {
  return a.low.x > b.high.x || b.low.x > a.high.x || a.low.y > b.high.y || b.low.y > a.high.y;
}

void note(Worst& worst, Limit limit, double violation) {
  double& w = worst[static_cast<std::size_t>(limit)];
  w = std::max(w, violation);
}

// ∂/∂d of g·(R(d) c).
Vec2 turning(Vec2 g, Vec2 c) {
  return {geom::dot(c, g), geom::cross(c, g)};
}

}  // namespace

TeamTerms::TeamTerms(std::vector<RobotTerms>& robots, double clearance, std::optional<NetTask> net,
                     const Settings& settings)
    : robots_(robots),
      clearance_(clearance),
      net_(std::move(net)),
      settings_(settings),
      penalties_(settings) {
  if (net_) missed_.resize(net_->meetings.size() + 1);
}

void TeamTerms::add(std::size_t robot, std::vector<CurveGradient>& others, Worst& worst) {
  for (std::size_t other = 0; other < robots_.size(); ++other)
    if (other != robot) add_pair(robot, other, others, worst);
  if (!net_ || (!net_->size && !net_->topology)) return;
  for (Sample& sample : robots_[robot].samples()) add_net_sample(robot, sample, others, worst);
}

void TeamTerms::add_pair(std::size_t robot, std::size_t other, std::vector<CurveGradient>& others,
                         Worst& worst) {
  RobotTerms& own = robots_[robot];
  const Shape &a = own.shape(), &b = robots_[other].shape();
  const double smoothing = smoothing_error(a, b, settings_.smoothing);
  const double wanted = clearance_ + settings_.slack + 2.0 * smoothing;
  const double reach = (a.radius + b.radius + wanted) / std::max(a.facing, b.facing) + geom::norm(a.middle) +
                       geom::norm(b.middle);
  std::size_t cursor = 0;
  for (const Span& span : own.spans()) {
    if (!overlap(span, reach, other, cursor)) continue;
    for (int i = span.first; i <= span.last; ++i)
      add_pair_sample(robot, own.samples()[static_cast<std::size_t>(i)], other, others[other], worst);
  }
}

// Whether the other comes near a piece of this robot while that is driven. `cursor` only moves forwards.
bool TeamTerms::overlap(const Span& span, double reach, std::size_t other, std::size_t& cursor) const {
  const std::vector<Span>& spans = robots_[other].spans();
  const geom::Box near = span.box.inflated(reach);
  while (cursor + 1 < spans.size() && spans[cursor].end < span.begin) ++cursor;
  for (std::size_t i = cursor; i < spans.size(); ++i) {
    if (i > cursor && spans[i].begin > span.end) return false;
    if (!disjoint(near, spans[i].box)) return true;
  }
  return false;
}

void TeamTerms::add_pair_sample(std::size_t robot, Sample& sample, std::size_t other, CurveGradient& gradient,
                                Worst& worst) {
  const Shape &shape_a = robots_[robot].shape(), &shape_b = robots_[other].shape();
  const Place there = robots_[other].curve().locate(sample.t);
  const Stand a{sample.place.position, sample.place.direction}, b{there.position, there.direction};
  const double asked = clearance_ + settings_.slack,
               error = smoothing_error(shape_a, shape_b, settings_.smoothing);
  // Where even the sharp distance is this large, the smooth one is large enough.
  const double wanted = asked + 2.0 * error;
  if (!may_be_near(shape_a, a, shape_b, b, wanted)) return;
  const double hard = hard_distance(shape_a, a, shape_b, b);
  if (hard >= wanted) return;
  note(worst, Limit::robots, clearance_ - hard);
  StandGradient g;
  const double gap = smooth_distance(shape_a, a, shape_b, b, settings_.smoothing, g) - error;
  if (gap >= asked) return;
  double slope;
  sample.density += penalties_(Limit::robots, asked - gap, slope);
  sample.g_position -= slope * g.position_a;
  sample.g_direction -= slope * g.direction_a;
  const double push = -slope * sample.weight;
  sample.g_time +=
      robots_[other].curve().pull_at_time(there, push * g.position_b, push * g.direction_b, gradient);
}

Vec2 TeamTerms::attachment(const Place& place, std::size_t robot) const {
  const Vec2 c = net_->attachments[robot], d = place.direction;
  return place.position + Vec2{d.x * c.x - d.y * c.y, d.y * c.x + d.x * c.y};
}

void TeamTerms::add_net_sample(std::size_t robot, Sample& sample, std::vector<CurveGradient>& others,
                               Worst& worst) {
  const std::size_t count = robots_.size();
  std::array<Place, kMostInRing> places;
  std::array<Vec2, kMostInRing> ring, g_ring{};
  for (std::size_t k = 0; k < count; ++k) {
    places[k] = k == robot ? sample.place : robots_[k].curve().locate(sample.t);
    ring[k] = attachment(places[k], k);
  }
  double density = 0.0;
  for (const std::size_t i : {robot, (robot + count - 1) % count}) {  // the ring's edges at this robot
    if (!net_->size) break;
    const std::size_t next = (i + 1) % count;
    Vec2 g_a, g_b;
    const double over =
        constraint::net_stretch(ring[i], ring[next], net_->longest[i] - settings_.slack, g_a, g_b);
    if (over <= 0.0) continue;
    double slope;
    density += penalties_(Limit::net_size, over, slope);
    g_ring[i] += slope * g_a, g_ring[next] += slope * g_b;
    note(worst, Limit::net_size, over - settings_.slack);
  }
  for (std::size_t i = 0; net_->topology && i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    if (i == robot || next == robot) continue;
    constraint::EdgeGradient g;
    const double over = settings_.topology_margin - constraint::net_edge(ring[i], ring[next], ring[robot], g);
    if (over <= 0.0) continue;
    double slope;
    density += penalties_(Limit::net_topology, over, slope);
    g_ring[i] -= slope * g.a, g_ring[next] -= slope * g.b, g_ring[robot] -= slope * g.p;
    note(worst, Limit::net_topology, over);
  }
  if (density == 0.0) return;
  sample.density += density;
  sample.g_position += g_ring[robot];
  sample.g_direction += turning(g_ring[robot], net_->attachments[robot]);
  for (std::size_t k = 0; k < count; ++k) {
    if (k == robot || g_ring[k] == Vec2{}) continue;
    const Vec2 g = sample.weight * g_ring[k];
    sample.g_time +=
        robots_[k].curve().pull_at_time(places[k], g, turning(g, net_->attachments[k]), others[k]);
  }
}

void TeamTerms::pull_ring(std::span<const Place> places, std::span<const Vec2> g_ring, double weight,
                          std::vector<CurveGradient>& gradients) const {
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    const Vec2 g = weight * g_ring[k];
    if (g == Vec2{}) continue;
    robots_[k].curve().pull_at_time(places[k], g, turning(g, net_->attachments[k]), gradients[k]);
  }
}

double TeamTerms::add_moments(std::vector<CurveGradient>& gradients) {
  if (!net_) return 0.0;
  const std::size_t count = robots_.size();
  std::array<Place, kMostInRing> places;
  std::array<Vec2, kMostInRing> ring, g_ring;
  const std::span<const Vec2> corners(ring.data(), count);
  double cost = 0.0;
  for (std::size_t m = 0; m < net_->meetings.size(); ++m) {
    const Meeting& meeting = net_->meetings[m];
    for (std::size_t k = 0; k < count; ++k) {
      places[k] = robots_[k].curve().locate(meeting.time);
      ring[k] = attachment(places[k], k);
    }
    missed_[m] = net_distance(corners, meeting.ground, settings_.clamp, std::span(g_ring).first(count));
    double slope;
    cost += catch_cost(missed_[m], {settings_.centring, settings_.catching, settings_.blend}, slope);
    pull_ring(places, g_ring, slope, gradients);
  }
  if (!net_->delivery) return cost;
  Vec2 middle;
  for (std::size_t k = 0; k < count; ++k) {
    places[k] = robots_[k].curve().locate(robots_[k].curve().duration());
    middle += attachment(places[k], k) / static_cast<double>(count);
  }
  const Vec2 off = middle - net_->delivery->center;
  const double radius = net_->delivery->radius - settings_.slack;
  missed_.back() = geom::norm(off) - net_->delivery->radius;
  double slope;
  cost +=
      settings_.end_weight * math::hinge(geom::squared_norm(off) - radius * radius, settings_.knee, slope);
  std::fill_n(g_ring.begin(), count, (2.0 * slope / static_cast<double>(count)) * off);
  pull_ring(places, g_ring, settings_.end_weight, gradients);
  return cost;
}

}  // namespace seine::baseline::letter
