#include "seine/io/report.hpp"

#include "seine/io/certificate_json.hpp"
#include "seine/io/json_text.hpp"

namespace seine::io {

constexpr double kNeverSeen = 1e6;  // m: above what any object flies

namespace {

// @param made by the planner just now, not read from a file
void add_plan(const world::Scenario& scenario, const planner::PlanResult& result, bool made,
              JsonObject& object) {
  object.add("certified", result.certified);
  if (result.claimed) object.add("claimed", *result.claimed);
  if (!result.certified && made) object.add("impossible", result.impossible);
  object.add("reason", result.reason);
  object.add("robots", static_cast<int>(scenario.robots.size()));
  if (made) {
    object.add("compute_s", result.times.compute);
    object.add("guess_s", result.times.guess);
    object.add("optimise_s", result.times.optimise);
  }
  object.add("certify_s", result.times.certify);
  if (made) object.add("iterations", result.iterations);
  if (!result.certified && !result.claimed.value_or(false)) return;
  object.add("makespan_s", result.quality.makespan);
  object.add("mean_travel_s", result.quality.mean_travel);
  object.add("distance_m", result.quality.distance);
  object.add("acceleration_cost", result.quality.acceleration_cost);
  add_clearances(result.certificate, object);
  add_catches(result.certificate, object);
}

// [{"fate": …, "delivered": …, "crossing_s": …, "rest_s": …, "lowest_m": …}, …]
std::string outcomes_json(const std::vector<sim::Outcome>& outcomes) {
  std::string all;
  for (const sim::Outcome& outcome : outcomes) {
    JsonObject object;
    object.add("fate", sim::name_of(outcome.fate));
    object.add("delivered", outcome.delivered);
    if (outcome.crossing_time > 0.0) object.add("crossing_s", outcome.crossing_time);
    if (outcome.catch_time > 0.0) object.add("rest_s", outcome.catch_time);
    if (outcome.lowest < kNeverSeen) object.add("lowest_m", outcome.lowest);
    all += (all.empty() ? "" : ", ") + object.line();
  }
  return "[" + all + "]";
}

std::string notes_json(const std::vector<sim::Note>& notes) {
  std::string all;
  for (const sim::Note& note : notes) {
    JsonObject object;
    object.add("time_s", note.time);
    object.add("text", note.text);
    all += (all.empty() ? "" : ", ") + object.line();
  }
  return "[" + all + "]";
}

}  // namespace

std::string report_json(const world::Scenario& scenario, const planner::PlanResult& result) {
  JsonObject object;
  add_plan(scenario, result, true, object);
  return object.lines() + "\n";
}

std::string report_json(const world::Scenario& scenario, const planner::PlanResult& result,
                        const sim::SimulationResult& driven) {
  JsonObject object;
  add_plan(scenario, result, result.times.compute > 0.0, object);
  if (!driven.outcomes.empty()) object.add("caught", driven.caught);
  object.add("delivered", driven.delivered);
  // Who reads "delivered" must see beside it what happened on the way.
  object.add("done", driven.done());
  object.add("collision", !(driven.min_clearance > 0.0));
  if (scenario.net) object.add("torn", driven.worst_stretch > 1.0);
  object.add("tracking_rms_m", driven.tracking_rms);
  object.add("replans", driven.replans);
  object.add("real_time_factor", driven.real_time_factor);
  object.add("tracking_worst_m", driven.tracking_worst);
  object.add("replans_asked", driven.replans_asked);
  object.add("replans_late", driven.replans_late);
  object.add("stopped", driven.stopped);
  object.add("driven_s", driven.duration);
  object.add("driven_clearance_m", driven.min_clearance);
  if (scenario.net) object.add("driven_stretch", driven.worst_stretch);
  object.add("goal_error_m", driven.goal_error);
  object.add_raw("outcomes", outcomes_json(driven.outcomes));
  object.add_raw("notes", notes_json(driven.notes));
  return object.lines() + "\n";
}

std::string report_json(const world::Scenario& scenario, const certify::Certificate& certificate,
                        const std::optional<std::vector<std::string>>& changed) {
  JsonObject object;
  object.add("certified", certificate.holds);
  object.add("verdict", certificate.holds                                      ? "certified"
                        : certificate.verdict() == certify::Verdict::undecided ? "undecided"
                                                                               : "refuted");
  object.add("reason", certificate.violations.empty() ? std::string() : certificate.violations.front().text);
  object.add("robots", static_cast<int>(scenario.robots.size()));
  object.add("certify_s", certificate.seconds);
  add_clearances(certificate, object);
  add_catches(certificate, object);
  std::string parts;
  for (const std::string& part : changed.value_or(std::vector<std::string>()))
    parts += (parts.empty() ? "" : ", ") + json_string(part);
  object.add_raw("made_for_this", !changed ? "null" : changed->empty() ? "true" : "false");
  object.add_raw("changed_since", "[" + parts + "]");
  object.add_raw("violations", violations_json(scenario, certificate));
  return object.lines() + "\n";
}

std::string failure_json(const std::string& message) {
  JsonObject object;
  object.add("error", message);
  return object.line() + "\n";
}

}  // namespace seine::io
