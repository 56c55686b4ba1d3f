#include "seine/certify/chart.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "seine/certify/chunks.hpp"
#include "seine/certify/joints.hpp"
#include "seine/certify/limits.hpp"
#include "seine/certify/tolerances.hpp"

namespace seine::certify {
namespace {

using traj::Segment;

// A cell is short enough when its body leaves the chord by less than this, in car lengths: finer cells make
// box tests sharper and cost more to make.
constexpr double kGrain = 0.03;
// … and when |p'| provably stays above this fraction of its middle value: the bounds divide by it.
constexpr double kRegular = 0.5;
// u hardly moves: so little of it, and of a small car's own metres.
constexpr double kStill = 1e-12, kStillMetres = 1e-9;
constexpr const char* kBetweenProgressPieces = "between progress pieces";
constexpr const char* kBetweenCurvePieces = "between curve pieces";
constexpr int kDeepest = 40;
constexpr std::size_t kMostCells = 1u << 17;  // of one car; sane plans have hundreds

class Charter {
 public:
  Charter(Context& context, int robot, Chart& chart)
      : context_(context),
        robot_(robot),
        model_(context.scenario.model_of(context.scenario.robots[static_cast<std::size_t>(robot)])),
        grain_(kGrain * model_.length()),
        chart_(chart),
        granted_(granted_to(model_)),
        joints_(context, robot),
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
      stops_ = segment.wait > 0.0 || segment.gear != gear_;
      gear_ = segment.gear;
      wait_ = segment.wait;
      if (segment.wait > 0.0) {
        const Stretch first{traj::drive_at(segment, 0, segment.progress.front()[0]), begin};
        mover().add_rest(begin, begin + segment.wait, first.frame(0.0));
        begin += segment.wait;
      }
      chart_segment(segment, begin);
      if (failed_) break;
      begin += segment.duration();
    }
    collect();
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

  void collect() {
    for (Finding& finding : joints_.findings()) chart_.findings.push_back(std::move(finding));
    for (Finding& finding : limits_.findings()) chart_.findings.push_back(std::move(finding));
    if (backwards_ > granted_.backwards) {
      complain(backwards_at_, Kind::gear, backwards_, granted_.backwards,
               "its way against the gear (m, in all), most of it");
    }
    if (off_curve_ > tolerance::kRange) {
      complain(off_curve_at_, Kind::continuity, off_curve_, tolerance::kRange,
               "how far its progress u leaves the pieces of the curve");
    }
  }

  void chart_segment(const Segment& segment, double begin) {
    tangents_.clear();
    for (const auto& piece : segment.curve) tangents_.push_back(longest_tangent(piece));
    const double longest = *std::max_element(tangents_.begin(), tangents_.end());
    const double still = std::min(kStill, kStillMetres * granted_.size / std::max(longest, 1e-300));
    joint_ = kBetweenCurvePieces;
    enter(segment, begin);
    for (std::size_t j = 0; j < segment.progress.size() && !failed_; ++j) {
      const double clock = begin + segment.piece_duration * static_cast<double>(j);
      chunks_of(segment, j, still, chunks_);
      for (const Chunk& chunk : chunks_) {
        if (failed_) return;
        chart_chunk(segment, j, chunk, clock);
        joint_ = kBetweenCurvePieces;
      }
      joint_ = kBetweenProgressPieces;
    }
    if (!failed_) leave(segment, begin);
  }

  /// Where the plan has the car before a segment and after it: at an inner knot of the curve that is the
  /// piece on the right of it, whichever way u goes from there.
  void enter(const Segment& segment, double begin) {
    const Stretch at{traj::drive_at(segment, 0, segment.progress.front()[0]), begin};
    const Side side = side_of(at, at.sample(0.0, model_.wheelbase));
    if (last_) joints_.join_segments(*last_, side, begin, stops_, wait_);
    last_ = side;
  }
  void leave(const Segment& segment, double begin) {
    const std::size_t j = segment.progress.size() - 1;
    const double u = traj::value_at(segment.progress[j], 1.0);
    const Stretch at{traj::drive_at(segment, j, u), begin + segment.piece_duration * static_cast<double>(j)};
    const Side side = side_of(at, at.sample(1.0, model_.wheelbase));
    joints_.join(*last_, side, at.clock(1.0), kBetweenCurvePieces);
    last_ = side;
  }

  void chart_chunk(const Segment& segment, std::size_t j, const Chunk& chunk, double clock) {
    const Stretch stretch{traj::drive_on(segment, j, chunk.curve_piece), clock};
    mover().stretches.push_back(stretch);
    direction_ = chunk.direction;
    const double tangent = tangents_[chunk.curve_piece];
    least_tangent_ =
        std::max(tolerance::kLeastTangent * tangent, tolerance::kLeastTangentFloor * granted_.size);
    const Sample from = stretch.sample(chunk.from, model_.wheelbase),
                 to = stretch.sample(chunk.to, model_.wheelbase);
    look_at_range(segment, stretch, from, to);
    if (failed_) return;
    if (chunk.backwards > 0.0) {
      const double back = chunk.backwards * tangent;
      if (back > most_backwards_) most_backwards_ = back, backwards_at_ = stretch.clock(from.w);
      backwards_ += back;
    }
    joints_.join(*last_, side_of(stretch, from), stretch.clock(from.w), joint_);
    if (chunk.knot_near >= 0.0) chart_both_sides(segment, j, chunk, clock);
    if (chunk.knot_from >= 0.0) join_pieces_at(segment, j, chunk.knot_from, chunk.from, clock);
    divide(stretch, from, to, 0);
    if (chunk.knot_to >= 0.0) join_pieces_at(segment, j, chunk.knot_to, chunk.to, clock);
    last_ = side_of(stretch, to);
  }

  /// An end so near to a knot that it may lie beyond it is not cut off: the curve pieces must agree there.
  /// How fast the car would move there does not count, for it moves by less than the size of that end.
  void join_pieces_at(const Segment& segment, std::size_t j, double knot, double w, double clock) {
    const auto right = static_cast<std::size_t>(knot);
    const Stretch before{traj::drive_on(segment, j, right - 1), clock},
        after{traj::drive_on(segment, j, right), clock};
    const Side left = side_of(before, before.sample(w, model_.wheelbase));
    Side beyond = side_of(after, after.sample(w, model_.wheelbase));
    beyond.speed = left.speed;  // of the next progress piece, whose unit of u may be another
    joints_.join(left, beyond, before.clock(w), kBetweenCurvePieces);
  }

  /// u at its turning points and joints: in between it is monotone.
  void look_at_range(const Segment& segment, const Stretch& stretch, const Sample& from, const Sample& to) {
    const double count = static_cast<double>(segment.curve.size());
    for (const Sample* at : {&from, &to}) {
      const double u = stretch.drive.knot + at->u, off = std::max(-u, u - count);
      if (off <= off_curve_) continue;
      off_curve_ = off, off_curve_at_ = stretch.clock(at->w);
      failed_ = off > tolerance::kRange;
    }
  }

  static Side side_of(const Stretch& stretch, const Sample& at) {
    const double gear = stretch.drive.gear;
    return {at.frame, gear * at.value[pace], gear * at.value[curvature]};
  }

  /// Where u hardly moves, but may pass a knot as often as a quintic can: each time is a joint, and the
  /// limits hold on both sides.
  void chart_both_sides(const Segment& segment, std::size_t j, const Chunk& chunk, double clock) {
    constexpr int kMostPasses = 5;
    const auto right = static_cast<std::size_t>(chunk.knot_near);
    const Stretch stretches[] = {{traj::drive_on(segment, j, right - 1), clock},
                                 {traj::drive_on(segment, j, right), clock}};
    std::array<Side, 2> sides;
    for (std::size_t s = 0; s < 2; ++s) {
      const Sample from = stretches[s].sample(chunk.from, model_.wheelbase),
                   to = stretches[s].sample(chunk.to, model_.wheelbase);
      sides[s] = side_of(stretches[s], from);
      limits_.check(stretches[s], from, to, stretches[s].bends(from.w, to.w, model_.wheelbase, mover().reach),
                    0);
    }
    for (int i = 0; i < kMostPasses; ++i)
      joints_.join(sides[0], sides[1], stretches[0].clock(chunk.from), kBetweenCurvePieces);
  }

  void divide(const Stretch& stretch, const Sample& a, const Sample& b, int depth) {
    if (failed_) return;
    const Bends bends = stretch.bends(a.w, b.w, model_.wheelbase, mover().reach);
    const double duration = (b.w - a.w) * stretch.drive.h;
    if (!(bends.middle_length >= least_tangent_))
      return fail_tangent(stretch.clock(0.5 * (a.w + b.w)), bends.middle_length);
    const bool regular = bends.least_length >= std::max(kRegular * bends.middle_length, least_tangent_);
    if ((!regular || !(chord_loss(bends.vertex, duration) <= grain_)) && depth < kDeepest) {
      const Sample middle = stretch.sample(0.5 * (a.w + b.w), model_.wheelbase);
      divide(stretch, a, middle, depth + 1);
      divide(stretch, middle, b, depth + 1);
      return;
    }
    if (!regular) return fail_tangent(stretch.clock(a.w), bends.least_length);
    if (mover().cells.size() >= kMostCells)
      return fail(stretch.clock(a.w), Kind::undecided, "too many cells");
    if (mover().cells.size() % 64 == 0 && context_.out_of_time())
      return fail(stretch.clock(a.w), Kind::undecided, "out of time");
    mover().add_cell(stretch.clock(a.w), stretch.clock(b.w), bends.vertex,
                     static_cast<int>(mover().stretches.size()) - 1, a.frame, b.frame);
    limits_.check(stretch, a, b, bends, direction_);
  }

  void fail_tangent(double time, double length) {
    failed_ = true;
    complain(time, Kind::malformed, length, least_tangent_, "the curve has no tangent, |p'| (m)");
  }

  /// `value` is not within `limit`.
  void complain(double time, Kind kind, double value, double limit, const char* what) {
    const auto [found, allowed] = told_apart(value, limit);
    chart_.findings.push_back(
        {{kind, time, robot_, -1, value, limit,
          format("%s: %s at t = %.4f s: %s; %s is %s", context_.robot_name(robot_).c_str(), what, time,
                 found.c_str(), allowed.c_str(), kind == Kind::malformed ? "needed" : "allowed")},
         std::abs(value - limit)});
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
  Granted granted_;
  Joints joints_;
  LimitProof limits_;
  std::vector<double> tangents_;                   // m, of each curve piece of the segment at hand
  std::vector<Chunk> chunks_;                      // of the progress piece at hand
  double least_tangent_ = 0.0;                     // m, on the chunk at hand
  int direction_ = 1;                              // of the chunk at hand
  std::optional<Side> last_;                       // where the chunk before ended
  const char* joint_ = kBetweenCurvePieces;        // before the next chunk
  bool stops_ = false;                             // whether the car rests before this segment …
  double wait_ = 0.0;                              // s, … for so long
  int gear_ = 0;                                   // of the segment before
  double backwards_ = 0.0, most_backwards_ = 0.0;  // m against the gear, in all and in one chunk
  double backwards_at_ = 0.0;                      // s, that chunk
  double off_curve_ = 0.0, off_curve_at_ = 0.0;    // u outside [0, M] at most, s
  bool failed_ = false;
};

}  // namespace

Chart chart_of(Context& context, int robot, const traj::RobotTrajectory& trajectory, double horizon) {
  Chart chart;
  Charter(context, robot, chart).run(trajectory, horizon);
  return chart;
}

}  // namespace seine::certify
