// What is granted at one joint, taken at thousands.
#include <numbers>

#include "bench/deceive/construction.hpp"

namespace seine::deceive {
namespace {

using geom::Vec2;
using traj::Segment;

// What was granted at a joint when these were first built; the genes take a share of it.
constexpr double kPlace = 1e-5, kHeading = 1e-4, kSpeed = 1e-3, kRelative = 1e-3;

/// A share of a tolerance: often all of it, often far less, never quite none.
double share(Genes& genes) {
  return genes.coin() ? genes.uniform(0.7, 1.0) : genes.log(1e-4, 1.0);
}

int many(Genes& genes) {
  return static_cast<int>(genes.log(3.0, 4000.0));
}

/// A piece of curve from a place with a heading, a curvature and |p'|.
std::array<traj::Quintic, 2> bent(Vec2 at, double heading, double curvature, double tangent) {
  const Vec2 d = geom::unit(heading), n = geom::left_normal(d);
  auto piece = along(at, d, linear(0.0, tangent));
  const double half = 0.5 * curvature * tangent * tangent;
  piece[0][2] = half * n.x, piece[1][2] = half * n.y;
  return piece;
}

/// Segments in which the car stands (or moves by almost nothing), each a little off the one before.
Case standing(Genes genes) {
  const double length = genes.log(1e-3, 10.0);
  vehicle::Model model = car(length);
  if (genes.coin()) model.limits.steering_rate = genes.log(0.1, 2.0);
  const double most = std::tan(model.limits.steering) / model.wheelbase;
  const int count = many(genes), sort = genes.below(4);
  const double part = share(genes);
  const double slide = sort == 0 ? part * kPlace : 0.0, turn = sort == 1 ? part * kHeading : 0.0;
  const double steer = sort == 2 ? part * kRelative * most : 0.0;
  const double ahead = sort == 3 ? part * kPlace : 0.0;
  const double moved = genes.coin() ? 0.0 : genes.log(1e-9, 1e-3);
  const double lasts = genes.log(1e-6, 1e-2), wait = genes.coin() ? 0.0 : genes.log(1e-9, 1e-4);
  traj::RobotTrajectory way;
  Vec2 at;
  for (int i = 0; i < count; ++i) {
    const double heading = i * turn, curvature = std::min(0.99 * most, i * steer);
    Segment segment;
    segment.curve = {bent(at, heading, curvature, 0.2 * length)};
    segment.progress = {ramp(0.0, moved)};
    segment.piece_duration = lasts, segment.wait = wait;
    const auto& c = segment.curve.front();
    at = {at.x + c[0][1] * moved + c[0][2] * moved * moved, at.y + c[1][1] * moved + c[1][2] * moved * moved};
    at += slide * geom::left_normal(geom::unit(heading)) + ahead * geom::unit(heading);
    way.segments.push_back(std::move(segment));
  }
  return case_of("standing", model, {{way}});
}

/// One segment whose progress jumps ahead, or gains speed, at each of its joints.
Case jumping_progress(Genes genes) {
  const double length = genes.log(1e-3, 10.0), size = genes.log(1.0, 30.0) * length;
  const int count = many(genes);
  vehicle::Model model = car(length);
  model.limits.acceleration = genes.log(0.1, 10.0);
  model.limits.speed = genes.log(0.01, 10.0);
  const double hop = genes.coin() ? share(genes) * kPlace / size : 0.0;
  const double surge = genes.coin() ? share(genes) * kSpeed / size : 0.0;
  const double curvature = genes.coin() ? 0.0 : genes.uniform(0.1, 0.99) * std::tan(0.7) / model.wheelbase;
  Segment segment;
  segment.piece_duration = genes.log(1e-6, 1e-2);
  double u = 0.0;
  const double swing = genes.uniform(0.5, 1.0);
  for (int i = 0; i < count; ++i) {
    // faster until the middle, then slower, to end at rest
    const double rate = std::min(surge * std::min(i, count - 1 - i), swing * model.limits.speed / size);
    segment.progress.push_back(linear(u, rate * segment.piece_duration));
    u += rate * segment.piece_duration + hop;
  }
  const int pieces = std::max(1, static_cast<int>(std::ceil(u)));
  for (int i = 0; i < pieces; ++i) {
    const Vec2 at = curvature == 0.0 ? Vec2{i * size, 0.0}
                                     : (1.0 / curvature) * Vec2{std::sin(i * size * curvature),
                                                                1.0 - std::cos(i * size * curvature)};
    segment.curve.push_back(bent(at, i * size * curvature, curvature, size));
    if (pieces > 100) break;
  }
  return case_of("jumping_progress", model, {{{{segment}}}});
}

/// A curve that at each knot turns, bends, slides or stretches a little.
Case jumping_curve(Genes genes) {
  const double length = genes.log(1e-3, 10.0);
  vehicle::Model model = car(length);
  model.limits.speed = genes.log(0.01, 10.0);
  if (genes.coin()) model.limits.lateral_acceleration = genes.log(0.1, 10.0);
  if (genes.coin()) model.limits.steering_rate = genes.log(0.1, 2.0);
  const double most = std::tan(model.limits.steering) / model.wheelbase;
  const int count = many(genes), sort = genes.below(4);
  const double part = share(genes);
  const double turn = sort == 0 ? part * kHeading : 0.0, slide = sort == 1 ? part * kPlace : 0.0;
  const double stretch = 1.0 + (sort == 2 ? part * kRelative * 0.98 : 0.0);
  const double bend = sort == 3 ? part * kRelative * most : 0.0;
  double tangent = genes.log(1e-6, 1e-1) * length, heading = 0.0, curvature = 0.0;
  Segment segment;
  Vec2 at;
  double path = 0.0;
  for (int i = 0; i < count; ++i) {
    segment.curve.push_back(bent(at, heading, curvature, tangent));
    const auto& c = segment.curve.back();
    at = {at.x + c[0][1] + c[0][2], at.y + c[1][1] + c[1][2]};
    const Vec2 end{c[0][1] + 2.0 * c[0][2], c[1][1] + 2.0 * c[1][2]};
    heading = std::atan2(end.y, end.x) + turn;
    at += slide * geom::left_normal(geom::unit(heading));
    path += tangent;
    tangent *= i < count / 2 ? stretch : 1.0 / stretch;
    curvature = std::min(curvature + bend, 0.99 * most);
  }
  segment.progress = {ramp(0.0, count)};
  segment.piece_duration = genes.log(1.0, 30.0) * std::max(path / model.limits.speed, std::sqrt(path));
  if (genes.coin()) {  // steady, with a ramp at either end
    segment.progress = {{0.0, 0.0, 0.0, 0.1 * count, -0.05 * count, 0.0}, linear(0.05 * count, 0.1 * count)};
    for (double u = 0.15; u < 0.94; u += 0.1) segment.progress.push_back(linear(u * count, 0.1 * count));
    segment.progress.push_back({0.95 * count, 0.1 * count, 0.0, -0.1 * count, 0.05 * count, 0.0});
    segment.progress.back()[0] = segment.progress[segment.progress.size() - 2][0] + 0.1 * count;
    segment.piece_duration *= 0.2;
  }
  return case_of("jumping_curve", model, {{{{segment}}}});
}

/// Two or more segments driven without a stop, each off the one before by something, at speed.
Case rolling_segments(Genes genes) {
  const double length = genes.log(1e-3, 10.0);
  vehicle::Model model = car(length);
  const double speed = genes.log(1e-3, 2.0), lasts = genes.log(1e-6, 1e-1);
  const double most = std::tan(model.limits.steering) / model.wheelbase;
  const int count = std::min(many(genes), 4000), sort = genes.below(4);
  const double part = share(genes);
  const double slide = sort == 0 ? part * kPlace : 0.0, turn = sort == 1 ? part * kHeading : 0.0;
  const double surge = sort == 2 ? part * kSpeed : 0.0, bend = sort == 3 ? part * kRelative * most : 0.0;
  traj::RobotTrajectory way;
  Vec2 at;
  double heading = 0.0, fast = speed;
  for (int i = 0; i < count; ++i) {
    const double step = fast * lasts, curvature = std::min(0.99 * most, i * bend);
    Segment segment;
    segment.curve = {bent(at, heading, curvature, step)};
    segment.progress = {linear(0.0, 1.0)};
    segment.piece_duration = lasts;
    const auto& c = segment.curve.front();
    at = {at.x + c[0][1] + c[0][2], at.y + c[1][1] + c[1][2]};
    heading = std::atan2(c[1][1] + 2.0 * c[1][2], c[0][1] + 2.0 * c[0][2]) + turn;
    at += slide * geom::left_normal(geom::unit(heading));
    fast = std::max(1e-9, std::min(2.49, fast + (i < count / 2 ? surge : -surge)));
    way.segments.push_back(std::move(segment));
  }
  // to rest with half of the allowed deceleration: u' = 1 at first, s = v T / 2 for u = 2w − w²
  Segment last;
  last.piece_duration = std::max(1e-3, 2.0 * fast / model.limits.acceleration);
  last.curve = {bent(at, heading, std::min(0.99 * most, (count - 1) * bend), fast * last.piece_duration)};
  last.progress = {{0.0, 1.0, 0.0, -1.0, 0.5, 0.0}};
  way.segments.push_back(last);
  return case_of("rolling_segments", model, {{way}});
}

}  // namespace

void add_joint_constructions(std::vector<Construction>& all) {
  for (const Construction& c : {Construction{"standing", standing},
                                {"jumping_progress", jumping_progress},
                                {"jumping_curve", jumping_curve},
                                {"rolling_segments", rolling_segments}})
    all.push_back(c);
}

}  // namespace seine::deceive
