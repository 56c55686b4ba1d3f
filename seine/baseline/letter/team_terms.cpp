#include "seine/baseline/letter/team_terms.hpp"

#include <algorithm>
#include <cmath>

#include "seine/baseline/letter/catch_cost.hpp"
#include "seine/constraint/net_edge.hpp"
#include "seine/constraint/net_stretch.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Vec2;

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

void TeamTerms::add(std::size_t robot, Share& share) {
  for (std::size_t other = 0; other < robots_.size(); ++other)
    if (other != robot) add_pair(robot, other, share);
  if (!net_ || (!net_->size && !net_->topology)) return;
  for (Sample& sample : robots_[robot].samples()) add_net_sample(robot, sample, share);
}

TeamTerms::Apart TeamTerms::apart(const Shape& a, const Shape& b) const {
  const double asked = clearance_ + settings_.slack, error = smoothing_error(a, b, settings_.smoothing);
  const double wanted = asked + 2.0 * error;
  return {asked, error, wanted,
          (a.radius + b.radius + wanted) / std::max(a.facing, b.facing) + geom::norm(a.middle) +
              geom::norm(b.middle)};
}

void TeamTerms::add_pair(std::size_t robot, std::size_t other, Share& share) {
  RobotTerms& own = robots_[robot];
  const Apart limits = apart(own.shape(), robots_[other].shape());
  std::size_t cursor = 0;
  for (const Span& span : own.spans()) {
    if (!overlap(span, limits.reach, other, cursor)) continue;
    for (int i = span.first; i <= span.last; ++i)
      add_pair_sample(robot, own.samples()[static_cast<std::size_t>(i)], other, limits, share);
  }
}

// Whether the other comes near a piece of this robot while that is driven. `cursor` only moves forwards.
bool TeamTerms::overlap(const Span& span, double reach, std::size_t other, std::size_t& cursor) const {
  const std::vector<Span>& spans = robots_[other].spans();
  if (spans.empty()) return true;  // it stands: its distance to each sample is quickly found
  const geom::Box near = span.box.inflated(reach);
  while (cursor + 1 < spans.size() && spans[cursor].end < span.begin) ++cursor;
  for (std::size_t i = cursor; i < spans.size(); ++i) {
    if (i > cursor && spans[i].begin > span.end) return false;
    if (!disjoint(near, spans[i].box)) return true;
  }
  return false;
}

void TeamTerms::add_pair_sample(std::size_t robot, Sample& sample, std::size_t other, const Apart& apart,
                                Share& share) {
  const Shape &shape_a = robots_[robot].shape(), &shape_b = robots_[other].shape();
  const Place there = robots_[other].curve().locate(sample.t);
  if (geom::squared_norm(there.position - sample.place.position) > apart.reach * apart.reach) return;
  const Stand a{sample.place.position, sample.place.direction}, b{there.position, there.direction};
  if (!may_be_near(shape_a, a, shape_b, b, apart.wanted)) return;
  const double hard = hard_distance(shape_a, a, shape_b, b);
  if (hard >= apart.wanted) return;
  note(share.worst, Limit::robots, clearance_ - hard);
  StandGradient g;
  const double gap = smooth_distance(shape_a, a, shape_b, b, settings_.smoothing, g) - apart.error;
  if (gap >= apart.asked) return;
  double slope;
  sample.density += penalties_(Limit::robots, apart.asked - gap, slope);
  sample.g_position -= slope * g.position_a;
  sample.g_direction -= slope * g.direction_a;
  const double push = -slope * sample.weight;
  sample.g_time += robots_[other].curve().pull_at_time(there, push * g.position_b, push * g.direction_b,
                                                       share.gradients[other]);
}

Vec2 TeamTerms::attachment(const Place& place, std::size_t robot) const {
  const Vec2 c = net_->attachments[robot], d = place.direction;
  return place.position + Vec2{d.x * c.x - d.y * c.y, d.y * c.x + d.x * c.y};
}

// ‖a_i − a_{i+1}‖ ≤ ρ ‖r_i − r_{i+1}‖ [Pei24, Eq. 14] for the two ring edges at this robot.
double TeamTerms::add_size(std::size_t robot, Share& share) const {
  Ring& ring = share.ring;
  const std::size_t count = robots_.size();
  double density = 0.0;
  for (const std::size_t i : {robot, (robot + count - 1) % count}) {
    const std::size_t next = (i + 1) % count;
    Vec2 g_a, g_b;
    const double over = constraint::net_stretch(ring.corners[i], ring.corners[next],
                                                net_->longest[i] - settings_.slack, g_a, g_b);
    if (over <= 0.0) continue;
    double slope;
    density += penalties_(Limit::net_size, over, slope);
    ring.gradient[i] += slope * g_a, ring.gradient[next] += slope * g_b;
    note(share.worst, Limit::net_size, over - settings_.slack);
  }
  return density;
}

// The robot on the inner side of the line through every ring edge that does not end at it [Pei24, Eq. 16].
double TeamTerms::add_topology(std::size_t robot, Share& share) const {
  Ring& ring = share.ring;
  const std::size_t count = robots_.size();
  double density = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t next = (i + 1) % count;
    if (i == robot || next == robot) continue;
    constraint::EdgeGradient g;
    const double over = settings_.topology_margin -
                        constraint::net_edge(ring.corners[i], ring.corners[next], ring.corners[robot], g);
    if (over <= 0.0) continue;
    double slope;
    density += penalties_(Limit::net_topology, over, slope);
    ring.gradient[i] -= slope * g.a, ring.gradient[next] -= slope * g.b, ring.gradient[robot] -= slope * g.p;
    note(share.worst, Limit::net_topology, over);
  }
  return density;
}

void TeamTerms::add_net_sample(std::size_t robot, Sample& sample, Share& share) {
  Ring& ring = share.ring;
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    ring.places[k] = k == robot ? sample.place : robots_[k].curve().locate(sample.t);
    ring.corners[k] = attachment(ring.places[k], k);
  }
  std::ranges::fill(ring.gradient, Vec2{});
  double density = net_->size ? add_size(robot, share) : 0.0;
  if (net_->topology) density += add_topology(robot, share);
  if (density == 0.0) return;
  sample.density += density;
  sample.g_position += ring.gradient[robot];
  sample.g_direction += turning(ring.gradient[robot], net_->attachments[robot]);
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    if (k == robot || ring.gradient[k] == Vec2{}) continue;
    const Vec2 g = sample.weight * ring.gradient[k];
    sample.g_time += robots_[k].curve().pull_at_time(ring.places[k], g, turning(g, net_->attachments[k]),
                                                     share.gradients[k]);
  }
}

// The instant is given, or all robots have arrived: nothing depends on a sample's time.
void TeamTerms::pull_ring(double weight, Share& share) const {
  const Ring& ring = share.ring;
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    const Vec2 g = weight * ring.gradient[k];
    if (g == Vec2{}) continue;
    robots_[k].curve().pull_at_time(ring.places[k], g, turning(g, net_->attachments[k]), share.gradients[k]);
  }
}

// [Pei24, Eqs. 17-19]
double TeamTerms::add_catch(std::size_t meeting, Share& share) {
  Ring& ring = share.ring;
  const Meeting& m = net_->meetings[meeting];
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    ring.places[k] = robots_[k].curve().locate(m.time);
    ring.corners[k] = attachment(ring.places[k], k);
  }
  missed_[meeting] = net_distance(ring.corners, m.ground, settings_.clamp, ring.gradient);
  double slope;
  const double cost =
      catch_cost(missed_[meeting], {settings_.centring, settings_.catching, settings_.blend}, slope);
  pull_ring(slope, share);
  return cost;
}

// [Pei24, Eqs. 20-22] in the form of this house: the middle of the attachments ends in the region.
double TeamTerms::add_delivery(Share& share) {
  Ring& ring = share.ring;
  const double per = 1.0 / static_cast<double>(robots_.size());
  Vec2 middle;
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    ring.places[k] = robots_[k].curve().locate(robots_[k].curve().duration());
    middle += per * attachment(ring.places[k], k);
  }
  const Vec2 off = middle - net_->delivery->center;
  const double radius = net_->delivery->radius - settings_.slack;
  missed_.back() = geom::norm(off) - net_->delivery->radius;
  double slope;
  const double outside = math::hinge(geom::squared_norm(off) - radius * radius, settings_.knee, slope);
  std::ranges::fill(ring.gradient, (2.0 * slope * per) * off);
  pull_ring(settings_.end_weight, share);
  return settings_.end_weight * outside;
}

double TeamTerms::add_moments(Share& share) {
  double cost = 0.0;
  if (!net_) return cost;
  for (std::size_t m = 0; m < net_->meetings.size(); ++m) cost += add_catch(m, share);
  return net_->delivery ? cost + add_delivery(share) : cost;
}

}  // namespace seine::baseline::letter
