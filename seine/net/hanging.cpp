// A load at cloth point v and ground point p may hang D below the rim when
//   D² ≤ f_k(p, v) = |v − r_k|² − |p − a_k|²   for every corner k,
// so the equilibria are the local maxima of min_k f_k. All f_k share the quadratic part |v|² − |p|²; their
// differences are linear. In R⁴ with that indefinite "length", a set S of tight corners (r_k, a_k) therefore
// has one point at equal f from all of them and in their affine hull: its circumcentre
//   (v, p) = Σ_S λ_k (r_k, a_k),   Σ λ_k = 1,   B λ = ½ diag B,   B_ij = r_i·r_j − a_i·a_j
// (corners counted from the first of S). It is an equilibrium when the tension shares λ are not negative, no
// other corner is tighter, and it is a maximum along the directions that S leaves free. The form has as many
// positive as negative directions as (v, p) has dimensions, and only the negative ones may stay free: S needs
// three corners at least and five at most, and the free directions are negative exactly when B has two
// positive eigenvalues. (docs/net.md derives all this.)
//
// The same holds along an edge of the net, where v has one dimension: r_k is then the projection onto the
// edge and f_k grows by the squared distance of the corner from it.
#include "seine/net/hanging.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "seine/net/shape.hpp"

namespace seine::net {
namespace {

using geom::Vec2;

constexpr double kShareTolerance = 1e-9;
constexpr double kTautTolerance = 1e-9;   // of D², relative to the net's size squared
constexpr double kMergeTolerance = 1e-6;  // of places, relative to the net's size
constexpr double kSingular = 1e-11;       // a pivot of B, relative to its largest entry
constexpr std::size_t kMostTaut = 5;

// f_k(p, v) = |v − r_k|² − |p − a_k|² + extra_k, with v in `dimensions` dimensions.
struct Problem {
  std::span<const Vec2> r, a;
  std::span<const double> extra;  // empty: zero
  int dimensions = 2;

  double extra_of(std::size_t k) const { return extra.empty() ? 0.0 : extra[k]; }
  double squared_depth(Vec2 p, Vec2 v, std::size_t k) const {
    return geom::squared_norm(v - r[k]) - geom::squared_norm(p - a[k]) + extra_of(k);
  }
  double squared_depth(Vec2 p, Vec2 v) const {
    double least = squared_depth(p, v, 0);
    for (std::size_t k = 1; k < r.size(); ++k) least = std::min(least, squared_depth(p, v, k));
    return least;
  }
};

using Subset = std::span<const std::size_t>;

struct Circumcentre {
  Vec2 p, v;
  double squared_depth;
  double extra;  // Σ λ_k extra_k: how strongly v is pulled off the line it is kept on
  bool maximum;  // along the directions that the subset leaves free
};

// A small symmetric system B x = y, solved in place by elimination with row pivoting.
struct SmallSystem {
  std::size_t size;
  std::array<std::array<double, kMostTaut - 1>, kMostTaut - 1> b;
  std::array<double, kMostTaut - 1> y;
  double determinant = 1.0;

  bool eliminate() {
    double largest = 0.0;
    for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(b[i][i]));
    for (std::size_t c = 0; c < size; ++c) {
      std::size_t pivot = c;
      for (std::size_t i = c + 1; i < size; ++i)
        pivot = std::abs(b[i][c]) > std::abs(b[pivot][c]) ? i : pivot;
      if (!(std::abs(b[pivot][c]) > kSingular * largest)) return false;
      if (pivot != c) std::swap(b[pivot], b[c]), std::swap(y[pivot], y[c]), determinant = -determinant;
      determinant *= b[c][c];
      for (std::size_t i = c + 1; i < size; ++i) {
        const double factor = b[i][c] / b[c][c];
        for (std::size_t j = c + 1; j < size; ++j) b[i][j] -= factor * b[c][j];
        y[i] -= factor * y[c];
      }
    }
    return true;
  }
  void substitute() {
    for (std::size_t i = size; i-- > 0;) {
      for (std::size_t j = i + 1; j < size; ++j) y[i] -= b[i][j] * y[j];
      y[i] /= b[i][i];
    }
  }
};

SmallSystem system_of(const Problem& problem, Subset subset) {
  SmallSystem system{.size = subset.size() - 1, .b = {}, .y = {}};
  const std::size_t first = subset[0];
  for (std::size_t i = 0; i < system.size; ++i) {
    const std::size_t row = subset[i + 1];
    for (std::size_t j = 0; j <= i; ++j) {
      const std::size_t column = subset[j + 1];
      system.b[i][j] = geom::dot(problem.r[row] - problem.r[first], problem.r[column] - problem.r[first]) -
                       geom::dot(problem.a[row] - problem.a[first], problem.a[column] - problem.a[first]);
      system.b[j][i] = system.b[i][j];
    }
    system.y[i] = 0.5 * (system.b[i][i] + problem.extra_of(row) - problem.extra_of(first));
  }
  return system;
}

// None when it is undetermined, or when a corner would have to push.
std::optional<Circumcentre> circumcentre(const Problem& problem, Subset subset) {
  SmallSystem system = system_of(problem, subset);
  double trace = 0.0;
  for (std::size_t i = 0; i < system.size; ++i) trace += system.b[i][i];
  if (!system.eliminate()) return std::nullopt;
  system.substitute();
  const std::size_t first = subset[0];
  double first_share = 1.0;
  double extra = problem.extra_of(first);
  Vec2 v = problem.r[first];
  Vec2 p = problem.a[first];
  for (std::size_t i = 0; i < system.size; ++i) {
    const double share = system.y[i];
    if (!(share >= -kShareTolerance)) return std::nullopt;
    first_share -= share;
    extra += share * (problem.extra_of(subset[i + 1]) - problem.extra_of(first));
    v += share * (problem.r[subset[i + 1]] - problem.r[first]);
    p += share * (problem.a[subset[i + 1]] - problem.a[first]);
  }
  if (!(first_share >= -kShareTolerance)) return std::nullopt;
  // B has one row per tight corner but one, at least `dimensions` of them: as many positive eigenvalues as v
  // has dimensions, the rest negative.
  const auto negative = static_cast<int>(system.size) - problem.dimensions;
  const bool sign = negative % 2 == 0 ? system.determinant > 0.0 : system.determinant < 0.0;
  const bool maximum = sign && (negative > 0 || trace > 0.0);
  return Circumcentre{p, v, problem.squared_depth(p, v, first), extra, maximum};
}

// Calls visit(Subset) for every choice of `size` out of 0 … count − 1, in lexicographic order.
template <class Visit>
void for_each_subset(std::size_t count, std::size_t size, Visit&& visit) {
  if (size > count) return;
  std::array<std::size_t, kMostTaut> chosen{};
  for (std::size_t i = 0; i < size; ++i) chosen[i] = i;
  for (;;) {
    visit(Subset(chosen.data(), size));
    std::size_t last = size;
    while (last > 0 && chosen[last - 1] == count - size + last - 1) --last;
    if (last == 0) return;
    ++chosen[last - 1];
    for (std::size_t i = last; i < size; ++i) chosen[i] = chosen[i - 1] + 1;
  }
}

// Calls visit(Circumcentre) for every set of corners that can hold a load.
template <class Visit>
void for_each_circumcentre(const Problem& problem, Visit&& visit) {
  const auto least = static_cast<std::size_t>(problem.dimensions) + 1;
  for (std::size_t size = least; size <= least + 2; ++size) {
    for_each_subset(problem.r.size(), size, [&](Subset subset) {
      if (const auto found = circumcentre(problem, subset)) visit(*found);
    });
  }
}

// The net seen along its edge from corner `edge`: v = (s, 0), s from that corner on.
struct EdgeView {
  std::vector<Vec2> r;
  std::vector<double> extra;
  Vec2 tail, along;
  double length;

  EdgeView(std::span<const Vec2> rest, std::size_t edge) : tail(rest[edge]) {
    const Vec2 whole = rest[edge + 1 == rest.size() ? 0 : edge + 1] - tail;
    length = geom::norm(whole);
    along = whole / length;
    for (const Vec2 corner : rest) {
      r.push_back({geom::dot(corner - tail, along), 0.0});
      const double inward = geom::cross(along, corner - tail);
      extra.push_back(inward * inward);
    }
  }
  Problem problem(std::span<const Vec2> attachments) const { return {r, attachments, extra, 1}; }
  bool holds(Vec2 v) const { return v.x >= 0.0 && v.x <= length; }
};

double size_squared(std::span<const Vec2> rest) {
  double largest = 0.0;
  for (const Vec2 corner : rest) largest = std::max(largest, geom::squared_norm(corner - rest[0]));
  return largest;
}

struct Collector {
  std::span<const Vec2> rest, attachments;
  double height, scale_squared;
  std::vector<Hanging> found;

  void add(Vec2 p, Vec2 v, double squared_depth, bool at_edge) {
    const Problem whole{rest, attachments, {}};
    if (squared_depth < 0.0) return;
    for (const Hanging& other : found) {
      const double apart =
          geom::squared_norm(other.position.ground() - p) + geom::squared_norm(other.contact - v);
      if (apart < kMergeTolerance * kMergeTolerance * scale_squared) return;
    }
    Hanging hanging{{p.x, p.y, height - std::sqrt(squared_depth)}, v, {}, at_edge};
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const double slack = whole.squared_depth(p, v, k) - squared_depth;
      if (slack < 10.0 * kTautTolerance * scale_squared) hanging.taut.push_back(static_cast<int>(k));
    }
    found.push_back(std::move(hanging));
  }
};

void collect_inside(Collector& out) {
  const Problem problem{out.rest, out.attachments, {}};
  for_each_circumcentre(problem, [&](const Circumcentre& c) {
    if (!c.maximum) return;
    const double held = problem.squared_depth(c.p, c.v);
    if (held >= c.squared_depth - kTautTolerance * out.scale_squared) out.add(c.p, c.v, held, false);
  });
}

void collect_on_edges(Collector& out) {
  for (std::size_t edge = 0; edge < out.rest.size(); ++edge) {
    const EdgeView view(out.rest, edge);
    const Problem problem = view.problem(out.attachments);
    for_each_circumcentre(problem, [&](const Circumcentre& c) {
      if (!c.maximum || !view.holds(c.v)) return;
      const double held = problem.squared_depth(c.p, c.v);
      if (held < c.squared_depth - kTautTolerance * out.scale_squared) return;
      // Held by the edge's own corners alone, the load rolls inwards and down: others must pull it outwards.
      if (c.extra < kTautTolerance * out.scale_squared) return;
      out.add(c.p, view.tail + c.v.x * view.along, held, true);
    });
  }
}

}  // namespace

std::vector<Hanging> equilibria(std::span<const Vec2> rest, std::span<const Vec2> attachments,
                                double height) {
  assert(rest.size() >= 3 && attachments.size() == rest.size());
  Collector collector{rest, attachments, height, size_squared(rest), {}};
  collect_inside(collector);
  collect_on_edges(collector);
  std::stable_sort(collector.found.begin(), collector.found.end(),
                   [](const Hanging& a, const Hanging& b) { return a.position.z < b.position.z; });
  return std::move(collector.found);
}

double loaded_depth(const Net& net, std::span<const Vec2> attachments) {
  assert(net.size() >= 3 && attachments.size() == net.size());
  const Problem problem{net.rest, attachments, {}};
  // Whatever min_k f_k is at a circumcentre, a load can hang that deep: no test for an equilibrium is needed.
  double deepest = 0.0;
  for_each_circumcentre(problem, [&](const Circumcentre& c) {
    if (c.squared_depth > deepest) deepest = std::max(deepest, problem.squared_depth(c.p, c.v));
  });
  for (std::size_t i = 0; i < net.size(); ++i) {
    const std::size_t j = i + 1 == net.size() ? 0 : i + 1;
    // A load on an edge hangs no deeper than in the middle of that edge alone.
    const double alone = 0.25 * (geom::squared_norm(net.rest[i] - net.rest[j]) -
                                 geom::squared_norm(attachments[i] - attachments[j]));
    if (alone <= deepest) continue;
    const EdgeView view(net.rest, i);
    const Problem along = view.problem(attachments);
    for_each_circumcentre(along, [&](const Circumcentre& c) {
      if (c.squared_depth > deepest && view.holds(c.v)) {
        deepest = std::max(deepest, along.squared_depth(c.p, c.v));
      }
    });
  }
  return std::sqrt(deepest);
}

double holding_reserve(const Net& net, std::span<const Vec2> attachments) {
  assert(net.size() >= 3 && attachments.size() == net.size());
  const auto slack = [&](std::size_t i, std::size_t j) {
    return geom::squared_norm(net.rest[i] - net.rest[j]) -
           geom::squared_norm(attachments[i] - attachments[j]);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < net.size(); ++i) {
    const std::size_t j = i + 1 == net.size() ? 0 : i + 1;
    const double edge = slack(i, j);
    for (std::size_t k = 0; k < net.size(); ++k) {
      if (k != i && k != j) least = std::min(least, slack(i, k) + slack(j, k) - edge);
    }
  }
  return least;
}

double holding_margin(const Net& net, std::span<const Vec2> attachments) {
  const std::vector<Hanging> all = equilibria(net.rest, attachments, net.rim());
  double least = all.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const Hanging& hanging : all)
    least = std::min(least, hanging.at_edge ? 0.0 : margin_inside(net.rest, hanging.contact));
  return least;
}

}  // namespace seine::net
