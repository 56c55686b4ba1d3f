// What a session makes of attempts that did not hold: slower plans, or a reason.
#include <cmath>
#include <utility>

#include "seine/planner/arc_plan.hpp"
#include "seine/planner/faults.hpp"
#include "seine/planner/session.hpp"

namespace seine::planner {

// Of what does not hold the nearest is told; what is a little over its limits may hold when it is driven
// slower.
void Session::keep_nearest() {
  const certify::Certificate& found = result_.certificate;
  const double now = severity(found);
  if (now < nearest_) nearest_ = now, fault_ = worst(found)->text;
  const std::optional<double> factor = slowing(found);
  if (!factor) return;
  const double end = *factor * result_.plan.makespan();
  if (slowable_ && end >= slowable_end_) return;
  slowable_ = Slowed{result_.plan, found};
  slowable_end_ = end;
}

void Session::slow_down() {
  if (!slowable_ || deadline_.expired()) return;
  const Stopwatch watch;
  const Slowed candidate = *std::exchange(slowable_, std::nullopt);
  auto slower = certified_slower(scenario_, map_, candidate.certificate, candidate.plan,
                                 {.threads = workers_.count(), .deadline = deadline_});
  if (slower && (!slowed_ || slower->plan.makespan() < slowed_->plan.makespan())) {
    slowed_by_ = slower->plan.makespan() / candidate.plan.makespan();
    slowed_ = std::move(slower);
  }
  result_.times.certify += watch.seconds();
}

// Where the optimiser does not get a car through its way, the car can still drive the way as it was found.
void Session::stop_and_steer() {
  if (scenario_.robots.size() != 1 || slowed_ || deadline_.expired()) return;
  const world::Robot& robot = scenario_.robots[0];
  Slowed drive;
  drive.plan.robots = {drive_arcs(guess_.robots[0].path, scenario_.model_of(robot), robot.start_speed)};
  if (drive.plan.robots[0].segments.empty()) return;
  drive.certificate = certify::certify(scenario_, map_, drive.plan, {.deadline = deadline_});
  if (!drive.certificate.holds) return;
  slowed_ = std::move(drive);
  slowed_by_ = std::numeric_limits<double>::infinity();
}

// Whether a car by itself goes forth and back often: then the optimiser has little to better, and much work.
bool Session::wriggles() const {
  if (guess_.robots.size() != 1) return false;
  const search::Path& path = guess_.robots[0].path;
  int changes = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i)
    changes += path.points[i].gear != path.points[i - 1].gear;
  return changes >= (path.wriggles ? 2 : 3);
}

// The shorter of what held at once and what held slower.
void Session::settle() {
  if (!slowed_ || (result_.certified && result_.plan.makespan() <= slowed_->plan.makespan())) return;
  result_.plan = std::move(slowed_->plan);
  result_.certificate = std::move(slowed_->certificate);
  result_.certified = true;
}

std::string Session::reason_to_give_up() const {
  if (fault_.empty())
    return deadline_.expired() ? "gave up at the deadline, during the first attempt"
                               : "no attempt came to a curve that a car can drive";
  return "gave up after " + std::to_string(attempts_) + (attempts_ == 1 ? " attempt" : " attempts") +
         (deadline_.expired() ? " at the deadline" : "") + "; the nearest fails because " + fault_;
}

PlanResult Session::finish() {
  if (result_.certified) {
    result_.reason.clear();
    result_.quality = measure(result_.plan);
  } else if (attempts_ > 0) {
    result_.reason = reason_to_give_up();
  }
  result_.impossible = !result_.certified && guess_.impossible;
  result_.times.compute = watch_.seconds();
  return std::move(result_);
}

// Of a search that was cut short: which cars it was busy with.
std::string Session::late_reason() const {
  std::vector<int> missing = guess_.without_way;
  missing.insert(missing.end(), guess_.without_motion.begin(), guess_.without_motion.end());
  std::string names;
  constexpr std::size_t kNamed = 3;
  for (std::size_t i = 0; i < std::min(missing.size(), kNamed); ++i)
    names += (i > 0 ? ", " : " for ") + scenario_.robots[static_cast<std::size_t>(missing[i])].name;
  if (missing.size() > kNamed) names += " and " + std::to_string(missing.size() - kNamed) + " more";
  return "gave up at the deadline, still looking for a way" + names +
         "; a longer deadline or smaller margins may help";
}

}  // namespace seine::planner
