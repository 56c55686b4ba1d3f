#pragma once

#include <string>

#include "seine/sim/json_text.hpp"
#include "seine/sim/recorder.hpp"

namespace seine::sim::foxglove {

// The kinds of message a log has, as JSON Schema: Foxglove's own [Foxglove] as far as they are used here, and
// two of ours for plots.
std::string scene_update_schema();
std::string frame_transform_schema();
std::string log_schema();
std::string car_schema();
std::string target_schema();

// The messages.
std::string scene_update(const world::Scenario& scenario, const Record& record);
/// Obstacles and bounds, which do not change.
std::string surroundings(const world::Scenario& scenario);
std::string frame_transform(const std::string& name, const geom::Pose2& pose, double time);
std::string log(const Note& note);
std::string car(const CarRecord& record, double time);
std::string target(const TargetRecord& record, double time);

}  // namespace seine::sim::foxglove
