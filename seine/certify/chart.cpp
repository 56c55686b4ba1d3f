#include "seine/certify/chart.hpp"

#include <algorithm>
#include <cmath>

#include "seine/certify/limits.hpp"
#include "seine/certify/tolerances.hpp"
#include "seine/math/bernstein.hpp"

namespace seine::certify {
namespace {

using traj::Quintic;
using traj::Segment;

// A cell is short enough when its body leaves the chord by less than this, in car lengths: finer cells make
// box tests sharper and cost more to make.
constexpr double kGrain = 0.03;
// … and when |p'| provably stays above this fraction of its middle value: the bounds divide by it.
constexpr double kRegular = 0.5;
constexpr double kShortestTangent = 1e-6;  // m, |p'| below it is no direction
constexpr int kDeepest = 40;
constexpr std::size_t kMostCells = 1u << 17;  // of one car; sane plans have hundreds

double value_at(const Quintic& c, double w) {
  return c[0] + w * (c[1] + w * (c[2] + w * (c[3] + w * (c[4] + w * c[5]))));
}

/// Where u(w) passes `level` between two parameters that enclose it.
double crossing(const Quintic& c, double level, double low, double high) {
  for (int i = 0; i < 60 && high - low > 1e-16; ++i) {
    const double middle = 0.5 * (low + high);
    (value_at(c, middle) < level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// An upper bound of |p'| over a segment's curve.
double longest_tangent(const Segment& segment) {
  double longest = 0.0;
  for (const auto& piece : segment.curve) {
    double sum = 0.0;
    for (std::size_t k = 1; k < 6; ++k) sum += static_cast<double>(k) * std::hypot(piece[0][k], piece[1][k]);
    longest = std::max(longest, sum);
  }
  return longest;
}

class Charter {
 public:
  Charter(Context& context, int robot, Chart& chart)
      : context_(context),
        robot_(robot),
        model_(context.scenario.model_of(context.scenario.robots[static_cast<std::size_t>(robot)])),
        grain_(kGrain * model_.length()),
        chart_(chart),
        limits_(context, robot) {
    mover().core = model_.footprint;
    mover().reach = model_.reach();
    // The attachment's acceleration is bounded with that of the footprint.
    if (context.scenario.net) {
      const geom::Vec2 held = context.scenario.net->attachments[static_cast<std::size_t>(robot)].at;
      mover().reach = std::max(mover().reach, geom::norm(held));
    }
  }

  void run(const traj::RobotTrajectory& trajectory, double horizon) {
    double begin = 0.0;
    for (const Segment& segment : trajectory.segments) {
      if (segment.wait > 0.0) {
        const Stretch first = stretch_on(segment, 0, segment.progress.front()[0], begin);
        mover().add_rest(begin, begin + segment.wait, first.frame(0.0));
        begin += segment.wait;
      }
      chart_segment(segment, begin);
      begin += segment.duration();
    }
    for (Finding& finding : limits_.findings()) chart_.findings.push_back(std::move(finding));
    if (failed_) return;
    chart_.complete = true;
    if (trajectory.stands) {
      const geom::Pose2& pose = *trajectory.stands;
      mover().add_rest(0.0, horizon, {pose.position(), pose.direction()});
    }
    rest_for_good(horizon);
  }

 private:
  Mover& mover() { return chart_.mover; }

  /// The stretch of progress piece `j` on the curve piece that holds `u`.
  static Stretch stretch_on(const Segment& segment, std::size_t j, double u, double segment_begin) {
    const double last = static_cast<double>(segment.curve.size()) - 1.0;
    const double knot = std::clamp(std::floor(u), 0.0, last);
    const auto& piece = segment.curve[static_cast<std::size_t>(knot)];
    return {.x = &piece[0],
            .y = &piece[1],
            .progress = &segment.progress[j],
            .knot = knot,
            .begin = segment_begin + segment.piece_duration * static_cast<double>(j),
            .h = segment.piece_duration,
            .gear = static_cast<double>(segment.gear)};
  }

  void chart_segment(const Segment& segment, double begin) {
    constexpr double kAtKnot = 1e-9;  // a knot nearer than this to an end is the end
    const double tangent = longest_tangent(segment);
    for (std::size_t j = 0; j < segment.progress.size() && !failed_; ++j) {
      const Quintic& progress = segment.progress[j];
      const auto rate = math::Bernstein::from_power(progress).derivative();
      forwards_ = rate.lower_bound() * tangent / segment.piece_duration >= -tolerance::kSpeed;
      const double u0 = value_at(progress, 0.0), u1 = value_at(progress, 1.0);
      double from = 0.0;
      for (double knot = std::max(1.0, std::floor(u0) + 1.0);
           knot < static_cast<double>(segment.curve.size()); ++knot) {
        if (knot <= u0 + kAtKnot) continue;
        if (knot >= u1 - kAtKnot) break;
        const double to = crossing(progress, knot, from, 1.0);
        chart_chunk(stretch_on(segment, j, value_at(progress, 0.5 * (from + to)), begin), from, to);
        from = to;
      }
      chart_chunk(stretch_on(segment, j, value_at(progress, 0.5 * (from + 1.0)), begin), from, 1.0);
    }
  }

  void chart_chunk(const Stretch& stretch, double from, double to) {
    if (failed_ || to <= from) return;
    mover().stretches.push_back(stretch);
    divide(stretch, stretch.sample(from, model_.wheelbase), stretch.sample(to, model_.wheelbase), 0);
  }

  void divide(const Stretch& stretch, const Sample& a, const Sample& b, int depth) {
    if (failed_) return;
    const Bends bends = stretch.bends(a.w, b.w, model_.wheelbase, mover().reach);
    const double duration = (b.w - a.w) * stretch.h;
    const bool regular =
        bends.least_length >= kRegular * bends.middle_length && bends.middle_length > kShortestTangent;
    if ((!regular || !(chord_loss(bends.vertex, duration) <= grain_)) && depth < kDeepest) {
      const Sample middle = stretch.sample(0.5 * (a.w + b.w), model_.wheelbase);
      divide(stretch, a, middle, depth + 1);
      divide(stretch, middle, b, depth + 1);
      return;
    }
    if (!regular) return fail(stretch.clock(a.w), Kind::malformed, "the curve has no tangent");
    if (mover().cells.size() >= kMostCells)
      return fail(stretch.clock(a.w), Kind::undecided, "too many cells");
    if (mover().cells.size() % 64 == 0 && context_.out_of_time())
      return fail(stretch.clock(a.w), Kind::undecided, "out of time");
    check_on_piece(stretch, a, b, bends);
    mover().add_cell(stretch.clock(a.w), stretch.clock(b.w), bends.vertex,
                     static_cast<int>(mover().stretches.size()) - 1, a.frame, b.frame);
    limits_.check(stretch, a, b, bends, forwards_);
  }

  /// u̇ may be negative by a tolerance; that must not take the car back across a knot, where another
  /// polynomial holds.
  void check_on_piece(const Stretch& stretch, const Sample& a, const Sample& b, const Bends& bends) {
    const double off = std::max({-a.u, -b.u, a.u - 1.0, b.u - 1.0}) * bends.middle_length;
    if (off > tolerance::kJunction)
      note(stretch.clock(a.w), Kind::gear, "the progress goes back across a knot of the curve");
  }

  void fail(double time, Kind kind, const char* what) {
    failed_ = true;
    note(time, kind, what);
  }

  void note(double time, Kind kind, const char* what) {
    chart_.findings.push_back(
        {{kind, time, robot_, -1, 0.0, 0.0,
          format("%s: %s at t = %.4f s", context_.robot_name(robot_).c_str(), what, time)},
         0.0});
  }

  void rest_for_good(double horizon) {
    Cell& last = mover().cells.back();
    if (last.t1 < horizon) {
      const double arrival = last.t1;
      mover().add_rest(arrival, horizon, mover().frame(last, arrival));
    }
  }

  Context& context_;
  int robot_;
  const vehicle::Model& model_;
  double grain_;
  Chart& chart_;
  LimitProof limits_;
  bool forwards_ = false;
  bool failed_ = false;
};

}  // namespace

Chart chart_of(Context& context, int robot, const traj::RobotTrajectory& trajectory, double horizon) {
  Chart chart;
  Charter(context, robot, chart).run(trajectory, horizon);
  return chart;
}

}  // namespace seine::certify
