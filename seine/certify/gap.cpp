#include "seine/certify/gap.hpp"

#include <algorithm>
#include <cmath>

#include "seine/certify/tolerances.hpp"
#include "seine/geom/convex.hpp"

namespace seine::certify {

using geom::Vec2;

namespace {
constexpr int kDeepest = 48;
constexpr int kMostSteps = 1 << 16;  // of one interval; sane ones need a handful
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}  // namespace

GapProof::GapProof(Context& context, double margin)
    : context_(context),
      size_(smallest_size(context.scenario)),
      levels_(static_cast<std::size_t>(kDeepest) + 3) {
  require(margin);
}

void GapProof::require(double margin) {
  seen_ = margin - tolerance::kGapSeen * size_;
  proved_ = margin - tolerance::kGapProved * size_;
}

void GapProof::between(const Mover& a, const Mover& b) {
  a_ = &a;
  b_ = &b;
  radii_ = a.radius + b.radius;
  normal_ = {};
  points_a_ = a.core.size(), points_b_ = b.core.size();
}

void GapProof::between(const Mover& a, std::span<const Vec2> fixed, double radius) {
  a_ = &a;
  b_ = nullptr;
  fixed_ = fixed;
  radii_ = a.radius + radius;
  normal_ = {};
  points_a_ = a.core.size();
}

GapProof::Placed& GapProof::level(int depth) {
  Placed& placed = levels_[static_cast<std::size_t>(depth)];
  if (placed.a.size() != points_a_) placed.a.resize(points_a_);
  if (placed.b.size() != points_b_) placed.b.resize(points_b_);
  return placed;
}

double GapProof::wanted() const {
  return std::max(proved_, closest - kClosestResolution);
}

void GapProof::place(double t, Placed& out) const {
  a_->place(*cell_a_, t, out.a);
  if (b_ != nullptr) b_->place(*cell_b_, t, out.b);
}

double GapProof::gap_along(Vec2 normal, const Placed& at) const {
  double a = -kInfinity, b = kInfinity;
  for (const Vec2 p : at.a) a = std::max(a, geom::dot(normal, p));
  for (const Vec2 p : b_ != nullptr ? std::span<const Vec2>(at.b) : fixed_)
    b = std::min(b, geom::dot(normal, p));
  return b - a - radii_;
}

void GapProof::met(double distance, double time) {
  if (distance < closest) closest = distance, closest_time = time, closest_changed = true;
  if (distance < worst_.distance) worst_ = {time, distance};
}

std::optional<GapProof::Worst> GapProof::result() const {
  if (worst_.distance < seen_) return worst_;
  return std::nullopt;
}

bool GapProof::give_up(double time, int depth) {
  if (++steps_ % 512 == 0) context_.out_of_time();
  const bool late = depth > 4 && context_.expired.load(std::memory_order_relaxed);
  if (depth < kDeepest && steps_ < kMostSteps && !late) return false;
  if (!(worst_.distance < seen_)) undecided = time;
  return true;
}

std::optional<GapProof::Worst> GapProof::prove(const Cell& a, const Cell* b, double t0, double t1) {
  cell_a_ = &a;
  cell_b_ = b;
  bend_ = a.bend + (b != nullptr ? b->bend : 0.0);
  worst_ = {t0, kInfinity};
  steps_ = 0;
  closest_changed = false;
  Placed &from = level(kDeepest + 1), &to = level(kDeepest + 2);
  place(t0, from);
  place(t1, to);
  if (normal_ != Vec2{}) {
    const double least =
        std::min(gap_along(normal_, from), gap_along(normal_, to)) - chord_loss(bend_, t1 - t0);
    if (least >= wanted()) return std::nullopt;
  }
  refine(t0, from, t1, to, 0);
  return result();
}

void GapProof::refine(double t0, const Placed& from, double t1, const Placed& to, int depth) {
  if (give_up(t0, depth)) return;
  const double middle = 0.5 * (t0 + t1);
  Placed& at = level(depth);
  place(middle, at);
  const auto other = b_ != nullptr ? std::span<const Vec2>(at.b) : fixed_;
  const geom::Separation parted = geom::separation(std::span<const Vec2>(at.a), other);
  const double distance = parted.distance - radii_;
  met(distance, middle);
  const Vec2 normal = normal_ = parted.normal;
  const double loss = chord_loss(bend_, 0.5 * (t1 - t0));
  // What is wanted depends on what has been met: a broken margin is followed to its worst, not to its end.
  const auto proved = [&](const Placed& end) {
    const double needed = worst_.distance < seen_ ? worst_.distance - kClosestResolution : wanted();
    return std::min(gap_along(normal, end), distance) - loss >= needed;
  };
  if (!proved(from)) refine(t0, from, middle, at, depth + 1);
  if (!proved(to)) refine(middle, at, t1, to, depth + 1);
}

double GapProof::gap_inside(const geom::Box& bounds, double t) {
  Placed& at = level(0);
  a_->place(*cell_a_, t, at.a);
  double gap = kInfinity;
  for (const Vec2 p : at.a) {
    gap = std::min({gap, p.x - bounds.low.x, p.y - bounds.low.y, bounds.high.x - p.x, bounds.high.y - p.y});
  }
  met(gap - a_->radius, t);
  return gap - a_->radius;
}

std::optional<GapProof::Worst> GapProof::prove_inside(const geom::Box& bounds, const Mover& mover,
                                                      const Cell& cell, double t0, double t1) {
  between(mover, {}, 0.0);
  cell_a_ = &cell;
  worst_ = {t0, kInfinity};
  steps_ = 0;
  closest_changed = false;
  bend_ = cell.bend;
  const double gap0 = gap_inside(bounds, t0), gap1 = gap_inside(bounds, t1);
  refine_inside(bounds, t0, gap0, t1, gap1, 0);
  return result();
}

void GapProof::refine_inside(const geom::Box& bounds, double t0, double gap0, double t1, double gap1,
                             int depth) {
  const double needed = worst_.distance < seen_ ? worst_.distance - kClosestResolution : wanted();
  if (std::min(gap0, gap1) - chord_loss(bend_, t1 - t0) >= needed || give_up(t0, depth)) return;
  const double middle = 0.5 * (t0 + t1), gap = gap_inside(bounds, middle);
  refine_inside(bounds, t0, gap0, middle, gap, depth + 1);
  refine_inside(bounds, middle, gap, t1, gap1, depth + 1);
}

}  // namespace seine::certify
