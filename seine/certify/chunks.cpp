#include "seine/certify/chunks.hpp"

#include <algorithm>
#include <cmath>

namespace seine::certify {
namespace {

using traj::Quintic;

/// A polynomial of degree four by its Bernstein coefficients.
using Quartic = std::array<double, 5>;

/// Of the derivative of a quintic.
Quartic slope_of(const Quintic& c) {
  const double r0 = c[1], r1 = 2.0 * c[2] / 4.0, r2 = 3.0 * c[3] / 6.0, r3 = 4.0 * c[4] / 4.0,
               r4 = 5.0 * c[5];
  return {r0, r0 + r1, r0 + 2.0 * r1 + r2, r0 + 3.0 * r1 + 3.0 * r2 + r3,
          r0 + 4.0 * r1 + 6.0 * r2 + 4.0 * r3 + r4};
}

/// On the left half and on the right half (de Casteljau).
std::array<Quartic, 2> halves_of(Quartic b) {
  Quartic left{}, right{};
  for (std::size_t i = 0; i < 5; ++i) {
    left[i] = b[0];
    right[4 - i] = b[4 - i];
    for (std::size_t k = 0; k + i < 4; ++k) b[k] = 0.5 * (b[k] + b[k + 1]);
  }
  return {left, right};
}

bool all_at_least_zero(const Quartic& b) {
  return std::all_of(b.begin(), b.end(), [](double value) { return value >= 0.0; });
}
bool all_at_most_zero(const Quartic& b) {
  return std::all_of(b.begin(), b.end(), [](double value) { return value <= 0.0; });
}

class Cutter {
 public:
  Cutter(const traj::Segment& segment, std::size_t j, double still, std::vector<Chunk>& chunks)
      : progress_(segment.progress[j]),
        pieces_(segment.curve.size()),
        last_knot_(static_cast<double>(pieces_)),
        still_(still),
        chunks_(chunks) {}

  void run() {
    cut(slope_of(progress_), 0.0, 1.0, 0);
    if (run_direction_ != 0) close_run(1.0);
  }

 private:
  static constexpr int kDeepest = 60;

  double u(double w) const { return traj::value_at(progress_, w); }

  /// Finds runs of one direction, in order.
  void cut(const Quartic& slope, double from, double to, int depth) {
    const int direction = all_at_least_zero(slope) ? 1 : all_at_most_zero(slope) ? -1 : 0;
    if (direction != 0) {
      if (direction == run_direction_) return;  // the run goes on
      if (run_direction_ != 0) close_run(from);
      run_direction_ = direction;
      run_from_ = from;
      return;
    }
    double fastest = 0.0;
    for (const double value : slope) fastest = std::max(fastest, std::abs(value));
    const double middle = 0.5 * (from + to);
    if (fastest * (to - from) <= still_ || depth == kDeepest || !(from < middle && middle < to)) {
      if (run_direction_ != 0) close_run(from);
      run_direction_ = 0;
      add_still(from, to, fastest * (to - from));
      return;
    }
    const auto [left, right] = halves_of(slope);
    cut(left, from, middle, depth + 1);
    cut(right, middle, to, depth + 1);
  }

  void add_still(double from, double to, double range) {
    const double middle = u(0.5 * (from + to)), knot = std::round(middle);
    const bool near = knot >= 1.0 && knot < last_knot_ && std::abs(middle - knot) <= range;
    chunks_.push_back({traj::piece_at(middle, pieces_), from, to, 0, range, near ? knot : -1.0});
  }

  /// The run from run_from_ to `to`, cut at the knots it passes; knots nearer than `still_` to an end are the
  /// end.
  void close_run(double to) {
    const double sign = run_direction_, begin = u(run_from_), end = u(to);
    double from = run_from_;
    double knot_from = knot_at(begin);
    double knot = sign > 0.0 ? std::max(1.0, std::floor(begin) + 1.0)
                             : std::min(last_knot_ - 1.0, std::ceil(begin) - 1.0);
    for (; knot >= 1.0 && knot < last_knot_; knot += sign) {
      if (sign * (knot - begin) <= still_) continue;
      if (sign * (end - knot) <= still_) break;
      const double at = crossing(knot, sign, from, to);
      add_run(from, at, knot_from, -1.0);
      from = at;
      knot_from = -1.0;
    }
    add_run(from, to, knot_from, knot_at(end));
  }

  /// The inner knot nearer than `still_`; negative: none.
  double knot_at(double u) const {
    const double knot = std::round(u);
    return knot >= 1.0 && knot < last_knot_ && std::abs(u - knot) <= still_ ? knot : -1.0;
  }

  void add_run(double from, double to, double knot_from, double knot_to) {
    if (!(from < to)) return;
    const double middle = u(0.5 * (from + to));
    const double back = run_direction_ < 0 ? std::max(0.0, u(from) - u(to)) : 0.0;
    chunks_.push_back(
        {traj::piece_at(middle, pieces_), from, to, run_direction_, back, -1.0, knot_from, knot_to});
  }

  /// Where u passes `level` between two parameters that enclose it: Newton's steps, or halves where those
  /// leave the bracket.
  double crossing(double level, double sign, double low, double high) const {
    constexpr double kAsGood = 1e-15;
    double at = 0.5 * (low + high);
    for (int i = 0; i < 60; ++i) {
      const double off = u(at) - level;
      (sign * off < 0.0 ? low : high) = at;
      const double newton = at - off / traj::slope_at(progress_, at);
      const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
      if (std::abs(next - at) <= kAsGood) return next;
      at = next;
    }
    return at;
  }

  const Quintic& progress_;
  std::size_t pieces_;
  double last_knot_;
  double still_;
  std::vector<Chunk>& chunks_;
  int run_direction_ = 0;  // of the run that is open, 0: none is
  double run_from_ = 0.0;
};

}  // namespace

double longest_tangent(const std::array<Quintic, 2>& piece) {
  const Quartic x = slope_of(piece[0]), y = slope_of(piece[1]);
  double longest = 0.0;
  for (std::size_t i = 0; i < 5; ++i) longest = std::max(longest, geom::norm(geom::Vec2{x[i], y[i]}));
  return longest;
}

void chunks_of(const traj::Segment& segment, std::size_t j, double still, std::vector<Chunk>& chunks) {
  chunks.clear();
  Cutter(segment, j, still, chunks).run();
}

}  // namespace seine::certify
