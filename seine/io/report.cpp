#include "seine/io/report.hpp"

#include "seine/io/certificate_json.hpp"
#include "seine/io/json_text.hpp"

namespace seine::io {

std::string report_json(const world::Scenario& scenario, const planner::PlanResult& result) {
  JsonObject object;
  object.add("certified", result.certified);
  object.add("reason", result.reason);
  object.add("robots", static_cast<int>(scenario.robots.size()));
  object.add("compute_s", result.times.compute);
  object.add("guess_s", result.times.guess);
  object.add("optimise_s", result.times.optimise);
  object.add("certify_s", result.times.certify);
  object.add("iterations", result.iterations);
  if (result.certified) {
    object.add("makespan_s", result.quality.makespan);
    object.add("mean_travel_s", result.quality.mean_travel);
    object.add("distance_m", result.quality.distance);
    object.add("acceleration_cost", result.quality.acceleration_cost);
    add_clearances(result.certificate, object);
    add_catches(result.certificate, object);
  }
  return object.lines() + "\n";
}

std::string report_json(const world::Scenario& scenario, const certify::Certificate& certificate) {
  JsonObject object;
  object.add("certified", certificate.holds);
  object.add("reason", certificate.violations.empty() ? std::string() : certificate.violations.front().text);
  object.add("robots", static_cast<int>(scenario.robots.size()));
  object.add("certify_s", certificate.seconds);
  add_clearances(certificate, object);
  add_catches(certificate, object);
  object.add_raw("violations", violations_json(scenario, certificate));
  return object.lines() + "\n";
}

std::string failure_json(const std::string& message) {
  JsonObject object;
  object.add("error", message);
  return object.line() + "\n";
}

}  // namespace seine::io
