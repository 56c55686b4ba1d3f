#include "seine/certify/underneath.hpp"

#include <algorithm>
#include <cmath>

#include "seine/certify/tolerances.hpp"
#include "seine/geom/blocked.hpp"
#include "seine/geom/convex.hpp"

namespace seine::certify {

using geom::Box;
using geom::Vec2;
using world::StaticMap;

namespace {
constexpr int kMostSteps = 1 << 16;        // of one interval; sane ones need a handful
constexpr long kMostStepsInAll = 1 << 17;  // of one team, so that a wild plan is not looked at for minutes
// Beats that share a query of the map: their boxes overlap almost wholly.
constexpr std::size_t kBlock = 8;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}  // namespace

UnderneathProof::UnderneathProof(Context& context, const Formation& formation, Height& height, double lowest)
    : context_(context),
      formation_(formation),
      height_(height),
      lowest_(lowest),
      clearance_(context.scenario.net->clearance),
      levels_(static_cast<std::size_t>(kDeepest) + 2) {
  closest_.clearance = kNetSearch;
}

void UnderneathProof::run(const Scene& scene) {
  const auto beats = formation_.beats();
  starts_inside();
  for (std::size_t first = 0; first < beats.size() && !context_.out_of_time(); first += kBlock)
    against_block(beats.subspan(first, std::min(kBlock, beats.size() - first)));
  for (const auto& [index, episodes] : pieces_) {
    const int obstacle = context_.map.pieces()[static_cast<std::size_t>(index)].obstacle;
    report(index, context_.map.describe(index), context_.height_of(obstacle), episodes);
  }
  for (const MovingPart& part : scene.moving) against(part);
}

/// The static map has only the rims of blocked areas: a net that starts wholly inside one never meets its
/// rim.
void UnderneathProof::starts_inside() {
  if (!context_.scenario.map) return;
  const Vec2 corner = formation_.slice(formation_.beats().front()).from.front();
  if (!geom::is_blocked(*context_.scenario.map, corner)) return;
  findings_.push_back({{Kind::net_obstacle, 0.0, -1, -1, 0.0, clearance_,
                        "the net is inside a blocked area of the map at t = 0"},
                       clearance_});
}

double UnderneathProof::wanted() const {
  if (worst_.room < -tolerance::kNetSeen) return worst_.room - kHeightResolution;
  return std::max(-tolerance::kNetProved, closest_.clearance - kHeightResolution);
}

/// Whether the net clears something of this height all the time.
bool UnderneathProof::passes_under(double height) const {
  return lowest_ - clearance_ - height >= std::max(0.0, closest_.clearance);
}

void UnderneathProof::against_block(std::span<const Beat> block) {
  Box whole;
  for (const Beat& beat : block) {
    const Box box = formation_.slice(beat).box();
    whole.include(box.low), whole.include(box.high);
  }
  context_.map.for_each_near(whole.inflated(kNetSearch), [&](const StaticMap::Piece& piece) {
    if (!passes_under(context_.height_of(piece.obstacle))) against(piece, block);
  });
}

void UnderneathProof::against(const StaticMap::Piece& piece, std::span<const Beat> block) {
  const int index = static_cast<int>(&piece - context_.map.pieces().data());
  const Other other{.fixed = piece.shape.core,
                    .radius = piece.shape.radius,
                    .needed = context_.height_of(piece.obstacle) + clearance_};
  normal_ = {};
  for (const Beat& beat : block) {
    const Slice slice = formation_.slice(beat);
    worst_ = {};
    if (box_gap(slice.box(), piece.box) >= wanted()) continue;
    const auto broken = prove(slice, other);
    if (closest_changed_) closest_.other = index;
    if (broken) pieces_[index].offer(beat.t0, beat.t1, broken->time, broken->room, -broken->room);
    if (undecided_) report_undecided(index, context_.map.describe(index));
  }
}

void UnderneathProof::against(const MovingPart& part) {
  if (passes_under(context_.height_of(part.obstacle))) return;
  Episodes episodes;
  std::vector<Vec2> from(formation_.size()), to(formation_.size());
  normal_ = {};
  const auto& cells = part.mover.cells;
  std::size_t c = 0;
  for (const Beat& beat : formation_.beats()) {
    Slice slice = formation_.slice(beat);
    const Box box = slice.box();
    for (double t = beat.t0; t < beat.t1;) {
      while (c + 1 < cells.size() && cells[c].t1 <= t) ++c;
      const double until = c + 1 < cells.size() ? std::min(beat.t1, cells[c].t1) : beat.t1;
      worst_ = {};
      if (box_gap(box, cells[c].box) < wanted()) {
        slice.t0 = t, slice.t1 = until;
        formation_.place(beat, t, from), formation_.place(beat, until, to);
        slice.from = from, slice.to = to;
        against(part, cells[c], slice, episodes);
      }
      t = until;
    }
  }
  report(part.obstacle, context_.obstacle_name(part.obstacle), context_.height_of(part.obstacle), episodes);
}

void UnderneathProof::against(const MovingPart& part, const Cell& cell, const Slice& slice,
                              Episodes& episodes) {
  const auto broken = prove(slice, {.mover = &part.mover,
                                    .cell = &cell,
                                    .radius = part.mover.radius,
                                    .needed = context_.height_of(part.obstacle) + clearance_});
  if (closest_changed_) closest_.other = part.obstacle;
  if (broken) episodes.offer(slice.t0, slice.t1, broken->time, broken->room, -broken->room);
  if (undecided_) report_undecided(part.obstacle, context_.obstacle_name(part.obstacle));
}

std::optional<UnderneathProof::Broken> UnderneathProof::prove(const Slice& slice, const Other& other) {
  other_ = other;
  worst_ = {};
  closest_changed_ = false;
  undecided_.reset();
  steps_ = 0;
  Placed &from = level(kDeepest), &to = level(kDeepest + 1);
  std::copy(slice.from.begin(), slice.from.end(), from.net.begin());
  std::copy(slice.to.begin(), slice.to.end(), to.net.begin());
  place_other(slice.t0, from), place_other(slice.t1, to);
  if (normal_ != Vec2{} && keeps(slice, from, gap_along(normal_, to))) return std::nullopt;
  refine(slice, from, to, 0);
  if (worst_.room < -tolerance::kNetSeen) return worst_;
  return std::nullopt;
}

bool UnderneathProof::keeps(const Slice& slice, const Placed& end, double distance) {
  double bend = other_.cell != nullptr ? other_.cell->bend : 0.0;
  bend += *std::max_element(slice.bends.begin(), slice.bends.end());
  const double beside = std::min(gap_along(normal_, end), distance) - chord_loss(bend, slice.t1 - slice.t0);
  if (beside >= wanted()) return true;
  return std::isfinite(other_.needed) && height_.least(slice) - other_.needed >= wanted();
}

void UnderneathProof::refine(const Slice& slice, const Placed& from, const Placed& to, int depth) {
  if (give_up(slice.t0, depth)) return;
  const double middle = 0.5 * (slice.t0 + slice.t1);
  Placed& at = level(depth);
  formation_.place(*slice.beat, middle, at.net);
  place_other(middle, at);
  const geom::Separation parted =
      geom::separation(std::span<const Vec2>(at.net), std::span<const Vec2>(at.other));
  const double distance = parted.distance - other_.radius;
  const Vec2 normal = parted.normal;
  // The height is asked only where it can matter.
  const bool by_height = std::isfinite(other_.needed) && distance < closest_.clearance;
  met(by_height ? std::max(distance, height_.at(at.net) - other_.needed) : distance, middle);
  Slice halves[2] = {slice, slice};
  halves[0].t1 = halves[1].t0 = middle;
  halves[0].to = halves[1].from = at.net;
  normal_ = normal;
  if (!keeps(halves[0], from, distance)) refine(halves[0], from, at, depth + 1);
  normal_ = normal;
  if (!keeps(halves[1], to, distance)) refine(halves[1], at, to, depth + 1);
}

double UnderneathProof::gap_along(Vec2 normal, const Placed& at) const {
  double net = -kInfinity, other = kInfinity;
  for (const Vec2 p : at.net) net = std::max(net, geom::dot(normal, p));
  for (const Vec2 p : at.other) other = std::min(other, geom::dot(normal, p));
  return other - net - other_.radius;
}

void UnderneathProof::place_other(double t, Placed& out) const {
  if (other_.mover == nullptr) {
    out.other.assign(other_.fixed.begin(), other_.fixed.end());
    return;
  }
  out.other.resize(other_.mover->core.size());
  other_.mover->place(*other_.cell, t, out.other);
}

void UnderneathProof::met(double room, double time) {
  if (room < closest_.clearance) closest_ = {room, time, -1, -1}, closest_changed_ = true;
  if (room < worst_.room) worst_ = {time, room};
}

bool UnderneathProof::give_up(double time, int depth) {
  if (++steps_ % 512 == 0) context_.out_of_time();
  const bool late = depth > 4 && context_.expired.load(std::memory_order_relaxed);
  ++steps_in_all_;
  if (depth < kDeepest && steps_ < kMostSteps && steps_in_all_ < kMostStepsInAll && !late) return false;
  if (!(worst_.room < -tolerance::kNetSeen)) undecided_ = time;
  return true;
}

void UnderneathProof::report(int other, const std::string& name, double height, const Episodes& episodes) {
  for (const Episodes::Episode& e : episodes.all()) {
    const std::string what =
        std::isfinite(height)
            ? format(
                  "the net passes over %s, %.4f m tall, at t = %.4f s and lacks %.4f m of height or distance",
                  name.c_str(), height, e.time, e.excess)
            : format("%s reaches %.4f m into the net at t = %.4f s", name.c_str(), e.excess, e.time);
    findings_.push_back({{Kind::net_obstacle, e.time, -1, other, e.value, 0.0, what}, e.excess});
  }
}

void UnderneathProof::report_undecided(int other, const std::string& name) {
  findings_.push_back(
      {{Kind::undecided, *undecided_, -1, other, closest_.clearance, 0.0,
        format("the distance of the net to %s could not be proved at t = %.4f s", name.c_str(), *undecided_)},
       0.0});
}

}  // namespace seine::certify
