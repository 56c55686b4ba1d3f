#include "seine/certify/height.hpp"

#include <algorithm>
#include <cmath>

#include "seine/certify/slice_bounds.hpp"
#include "seine/certify/tolerances.hpp"
#include "seine/net/hanging.hpp"

namespace seine::certify {
namespace {

using geom::Vec2;

constexpr int kMostSteps = 1 << 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

Height::Height(const net::Net& net) : net_(net), share_(0.5 * (1.0 - 1.0 / static_cast<double>(net.size()))) {
  for (std::size_t i = 0; i < net.size(); ++i) {
    for (std::size_t j = i + 1; j < net.size(); ++j) pairs_.push_back({i, j});
  }
  least_squares_.resize(pairs_.size());
  shapes_.reserve(kMostShapes);
}

double Height::at(std::span<const Vec2> attachments) {
  const double depth = net::loaded_depth(net_, attachments);
  if (shapes_.size() < kMostShapes) shapes_.push_back({0.0, std::vector<double>(pairs_.size())});
  Shape& shape = shapes_[next_];
  next_ = (next_ + 1) % kMostShapes;
  shape.squared_depth = depth * depth;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    shape.squares[p] = geom::squared_norm(attachments[pairs_[p].i] - attachments[pairs_[p].j]);
  }
  return net_.rim() - depth;
}

double Height::least(const Slice& slice) {
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    least_squares_[p] = least_square_apart(slice, pairs_[p].i, pairs_[p].j);
  return net_.rim() - std::sqrt(depth_squared());
}

/// An upper bound of D² for all shapes whose squared distances are at least `least_squares_`.
double Height::depth_squared() const {
  double bound = kInfinity;
  for (const Shape& shape : shapes_) {
    double decrease = 0.0;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      decrease = std::max(decrease, shape.squares[p] - least_squares_[p]);
    bound = std::min(bound, shape.squared_depth + share_ * decrease);
  }
  return bound;
}

// Every attachment moved by s, a squared distance q decreases by 4 s √q at most, and D² grows by that times
// the share.
double Height::reserve(const Slice& slice, double least, double wanted) const {
  double longest = 0.0;
  for (const Pair& pair : pairs_)
    longest = std::max(longest, geom::squared_norm(slice.to[pair.i] - slice.to[pair.j]));
  const double depth = net_.rim() - least, allowed = net_.rim() - wanted;
  return (allowed * allowed - depth * depth) / (4.0 * share_ * std::sqrt(longest));
}

DragProof::DragProof(Context& context, const Formation& formation, Height& height)
    : context_(context),
      formation_(formation),
      height_(height),
      clearance_(context.scenario.net->clearance),
      levels_(static_cast<std::size_t>(kDeepest)) {}

void DragProof::run() {
  glimpse();
  for (const Beat& beat : formation_.beats()) {
    worst_ = 0.0;
    if (beat.strayed_within <= lasts_) continue;
    const Slice slice = formation_.slice(beat);
    const double least = height_.least(slice);
    if (!(least - clearance_ >= wanted())) {
      refine(slice, 0);
    } else {
      lasts_ = beat.strayed + height_.reserve(slice, least, clearance_ + wanted());
    }
  }
}

/// Looks first where the net is narrowest: it hangs deepest about there, and what hangs less deep
/// need not be resolved.
void DragProof::glimpse() {
  const Beat* narrowest = nullptr;
  double least = kInfinity;
  for (const Beat& beat : formation_.beats()) {
    const auto at = formation_.slice(beat).from;
    double sum = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      for (std::size_t j = i + 1; j < at.size(); ++j) sum += geom::squared_norm(at[i] - at[j]);
    }
    if (sum < least) least = sum, narrowest = &beat;
  }
  if (narrowest == nullptr) return;
  const Slice slice = formation_.slice(*narrowest);
  closest_ = {height_.at(slice.from) - clearance_, narrowest->t0, -1, -1};
}

void DragProof::look(const Slice& slice, std::span<const Vec2> at, double time) {
  const double room = height_.at(at) - clearance_;
  if (room < closest_.clearance) closest_ = {room, time, -1, -1};
  if (room < -tolerance::kNetSeen) {
    worst_ = std::min(worst_, room);
    episodes_.offer(slice.beat->t0, slice.beat->t1, time, clearance_ + room, -room);
  }
}

double DragProof::wanted() const {
  return worst_ < 0.0 ? worst_ - kHeightResolution
                      : std::max(-tolerance::kNetProved, closest_.clearance - kHeightResolution);
}

bool DragProof::keeps(const Slice& slice) {
  return height_.least(slice) - clearance_ >= wanted();
}

void DragProof::refine(const Slice& slice, int depth) {
  if (++steps_ % 512 == 0) context_.out_of_time();
  if (depth >= kDeepest || steps_ > kMostSteps || context_.expired.load(std::memory_order_relaxed)) {
    if (worst_ < 0.0 || !undecided_.empty()) return;
    undecided_.push_back({{Kind::undecided, slice.t0, -1, -1, 0.0, clearance_,
                           format("the height of the net could not be proved at t = %.4f s", slice.t0)},
                          0.0});
    return;
  }
  std::vector<Vec2>& at = levels_[static_cast<std::size_t>(depth)];
  at.resize(formation_.size());
  const double middle = 0.5 * (slice.t0 + slice.t1);
  formation_.place(*slice.beat, middle, at);
  look(slice, at, middle);
  Slice halves[2] = {slice, slice};
  halves[0].t1 = halves[1].t0 = middle;
  halves[0].to = halves[1].from = at;
  for (const Slice& half : halves) {
    if (!keeps(half)) refine(half, depth + 1);
  }
}

std::vector<Finding> DragProof::findings() const {
  std::vector<Finding> findings = undecided_;
  for (const Episodes::Episode& e : episodes_.all()) {
    findings.push_back(
        {{Kind::net_drag, e.time, -1, -1, e.value, clearance_,
          format("the net hangs down to %.4f m above the ground at t = %.4f s; %.4f m is required", e.value,
                 e.time, clearance_)},
         e.excess});
  }
  return findings;
}

}  // namespace seine::certify
