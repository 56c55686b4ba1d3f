// Where |p'| vanishes, u may run far without anyone noticing, and the heading may turn on the spot.
#include <numbers>

#include "bench/deceive/construction.hpp"

namespace seine::deceive {
namespace {

using geom::Vec2;
using traj::Quintic;
using traj::Segment;

Vec2 direction(Genes& genes) {
  return geom::unit(genes.uniform(-std::numbers::pi, std::numbers::pi));
}

/// ∫ a (w − r)² + e: a tangent that almost vanishes at r.
Quintic dipping(double a, double r, double e) {
  return {0.0, a * r * r + e, -a * r, a / 3.0, 0.0, 0.0};
}

/// The tangent vanishes where the progress jumps: the jump is measured there only.
Case teleport(Genes genes) {
  const Vec2 d = direction(genes);
  const double length = genes.log(0.01, 10.0), size = genes.log(0.1, 100.0) * length;
  const double root = genes.uniform(0.2, 0.8), least = size * genes.log(1e-9, 1e-3);
  const double far = root + genes.uniform(0.05, 0.5) * (genes.coin() ? 1.0 : -1.0);
  const bool lands = genes.coin();
  const double leaves_at = lands ? far : root, lands_at = lands ? root : far;
  Segment segment;
  segment.curve = {along({}, d, dipping(12.0 * size, root, least))};
  segment.progress = {ramp(0.0, leaves_at), ramp(lands_at, std::max(1.0, lands_at))};
  segment.piece_duration = genes.log(5.0, 100.0) * std::sqrt(size);
  return case_of("teleport", car(length), {{{{segment}}}});
}

/// Two places with a vanishing tangent; the jump leads from one to the other.
Case two_roots(Genes genes) {
  const Vec2 d = direction(genes);
  const double length = genes.log(0.01, 10.0), size = genes.log(0.1, 100.0) * length;
  const double a = genes.uniform(0.1, 0.4), b = genes.uniform(0.6, 0.9),
               least = size * genes.log(1e-12, 1e-3);
  // c (w − a)² (w − b)² + least, integrated
  const double s = a + b, p = a * b, c = 30.0 * size;
  const Quintic x{0.0, c * p * p + least, -c * s * p, c * (s * s + 2.0 * p) / 3.0, -c * s / 2.0, c / 5.0};
  Segment segment;
  segment.curve = {along({}, d, x)};
  segment.progress = {ramp(0.0, a), ramp(b, 1.0)};
  segment.piece_duration = genes.log(5.0, 100.0) * std::sqrt(size);
  return case_of("two_roots", car(length), {{{{segment}}}});
}

/// The joint of the progress passes a knot: before it the car crawls, after it the curve is another.
Case over_the_knot(Genes genes) {
  const Vec2 d = direction(genes);
  const double length = genes.log(0.01, 10.0), size = genes.log(0.1, 10.0) * length;
  const double tiny = size * genes.log(1e-9, 1e-2), before = genes.log(1e-6, 0.9),
               after = genes.log(1e-6, 0.9);
  const double bend = genes.uniform(-1.0, 1.0) * size;
  Segment segment;
  segment.curve = {along({}, d, linear(0.0, tiny)), along(tiny * d, d, {0.0, tiny, 0.0, size, 0.0, 0.0})};
  const Vec2 n = geom::left_normal(d);
  segment.curve[1][0][3] += bend * n.x, segment.curve[1][1][3] += bend * n.y;
  segment.progress = {ramp(0.0, 1.0 - before), ramp(1.0 + after, 2.0)};
  segment.piece_duration = genes.log(5.0, 100.0) * std::sqrt(size);
  return case_of("over_the_knot", car(length), {{{{segment}}}});
}

/// Within one progress piece u leaves its curve piece (or the whole curve) and comes back; the proof looks at
/// the polynomial it left, on which the car seems to stand.
Case hidden_run(Genes genes) {
  const Vec2 d = direction(genes);
  const double length = genes.log(0.01, 10.0), size = genes.log(0.1, 20.0) * length;
  const double tiny = size * genes.log(1e-9, 1e-3);
  const int where = genes.below(4);  // over the upper knot, over the lower, below 0, beyond the end
  const double first = genes.uniform(0.01, 0.5), excursion = genes.uniform(0.5, 1.9);
  Segment segment;
  const auto crawl = along({}, d, linear(0.0, tiny));
  const auto run = along(tiny * d, d, {0.0, tiny, 0.0, size, 0.0, 0.0});
  const auto back = along({}, d, {-size - tiny, 3.0 * size + tiny, -3.0 * size, size, 0.0, 0.0});
  const auto grows = along({}, d, {0.0, tiny, 0.0, size, 0.0, 0.0});
  double start = first, sign = 1.0;
  if (where == 0) segment.curve = {crawl, run};
  if (where == 1) segment.curve = {back, crawl}, start = 2.0 - first, sign = -1.0;
  if (where == 2) segment.curve = {grows}, start = 0.0, sign = -1.0;
  if (where == 3) segment.curve = {crawl}, start = 1.0 - 1e-3 * first;
  const double a = sign * excursion;
  if (genes.coin()) {
    segment.progress = {{start, 0.0, 0.0, 0.0, 12.2 * a, -12.2 * a}};
  } else {
    segment.progress = {{start, 0.0, 16.0 * a, -32.0 * a, 16.0 * a, 0.0}};
  }
  segment.piece_duration = genes.log(0.5, 1000.0);
  Segment parked;
  parked.curve = {along(genes.uniform(1.5, 3.0) * length * d, d, linear(0.0, 0.1 * length))};
  parked.progress = {constant(0.0)};
  return case_of("hidden_run", car(length), {{{{segment}}, {{parked}}}});
}

/// The tangent swings round on the spot: p' = (a (w − r), e).
Case cusp(Genes genes) {
  const Vec2 d = direction(genes), n = geom::left_normal(d);
  const double length = genes.log(0.01, 10.0), size = genes.log(0.01, 10.0) * length;
  const double least = size * genes.log(1e-12, 1.0), r = genes.uniform(0.3, 0.7);
  Segment segment;
  segment.curve = {along({}, d, {0.0, -size * r, 0.5 * size, 0.0, 0.0, 0.0})};
  segment.curve[0][0][1] += least * n.x, segment.curve[0][1][1] += least * n.y;
  const double skipped = genes.log(1e-12, 1e-2);
  segment.progress = {ramp(0.0, r - skipped), ramp(r + (genes.coin() ? skipped : -skipped), 1.0)};
  segment.piece_duration = genes.log(1.0, 100.0) * std::sqrt(size);
  return case_of("cusp", car(length), {{{{segment}}}});
}

/// Forth and back slower than what is granted against the gear, over a bend too sharp for the car.
Case forth_and_back(Genes genes) {
  const Vec2 d = direction(genes), n = geom::left_normal(d);
  const double length = genes.log(0.01, 100.0), size = genes.log(0.1, 3.0) * length;
  const double sharp = genes.log(0.01, 30.0) * size, reach = genes.log(1e-4, 1.0);
  const int power = 2 + genes.below(3);
  Segment segment;
  segment.curve = {along({}, d, linear(0.0, size))};
  segment.curve[0][0][static_cast<std::size_t>(power)] += sharp * n.x;
  segment.curve[0][1][static_cast<std::size_t>(power)] += sharp * n.y;
  const double a = 16.0 * reach;
  segment.progress = {{0.0, 0.0, a, -2.0 * a, a, 0.0}};
  // back no faster than `share` of 1 mm/s; the fastest of w²(1 − w)² is 0.0962 a share of its range
  const double share = genes.log(0.1, 1.2);
  segment.piece_duration = 3.1 * reach * size / (1e-3 * share);
  if (segment.piece_duration > 1e5) segment.piece_duration = 1e5;
  return case_of("forth_and_back", car(length), {{{{segment}}}});
}

/// Creeping back, too slowly to be called driving against the gear.
Case creeping(Genes genes) {
  const double length = genes.log(0.01, 10.0), size = genes.log(0.1, 3.0) * length;
  const double speed = genes.log(1e-6, 1.2e-3), lasts = std::min(3e4, 0.9 * size / speed);
  vehicle::Model model = car(length);
  if (genes.coin()) model.limits.reverse_speed = 0.0;
  model.limits.speed = genes.log(0.01, 10.0);
  const int pieces = 1 + genes.below(20);
  Segment segment;
  segment.curve = {along({}, direction(genes), linear(0.0, size))};
  segment.progress = {ramp(0.0, 1.0)};
  segment.piece_duration = lasts / pieces;
  const double step = speed * segment.piece_duration / size;
  for (int i = 0; i < pieces; ++i) segment.progress.push_back(linear(1.0 - i * step, -step));
  return case_of("creeping", model, {{{{segment}}}});
}

/// A huge curve of which the progress uses a millionth, and leaves it by as much as is granted.
Case huge_curve(Genes genes) {
  const Vec2 d = direction(genes), n = geom::left_normal(d);
  const double length = genes.log(0.1, 10.0), size = genes.log(1.0, 1e8) * length;
  const double used = std::min(1.0, genes.log(0.1, 10.0) * length / size), outside = genes.log(1e-9, 1.1e-6);
  Segment segment;
  segment.curve = {along({}, d, linear(0.0, size))};
  const double bent = size * genes.log(1e-3, 1e3);
  segment.curve[0][0][3] += bent * n.x, segment.curve[0][1][3] += bent * n.y;
  segment.progress = {ramp(-outside, used)};
  if (genes.coin()) segment.progress = {{0.0, 0.0, -16.0 * outside, 32.0 * outside, -16.0 * outside, 0.0}};
  segment.piece_duration = genes.log(1.0, 100.0);
  return case_of("huge_curve", car(length), {{{{segment}}}});
}

}  // namespace

void add_tangent_constructions(std::vector<Construction>& all) {
  for (const Construction& c : {Construction{"teleport", teleport},
                                {"two_roots", two_roots},
                                {"over_the_knot", over_the_knot},
                                {"hidden_run", hidden_run},
                                {"cusp", cusp},
                                {"forth_and_back", forth_and_back},
                                {"creeping", creeping},
                                {"huge_curve", huge_curve}})
    all.push_back(c);
}

}  // namespace seine::deceive
