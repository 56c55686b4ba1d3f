#pragma once

#include <string>

#include "seine/io/svg_view.hpp"

// The layers of the picture from the floor up, as SVG elements.
namespace seine::io {

/// Colours that layers and legend share.
struct SvgInk {
  static constexpr const char* kFloor = "#f8f9fb";
  static constexpr const char* kText = "#1f2733";
  static constexpr const char* kFaint = "#6b7684";
  static constexpr const char* kSolid = "#d3d9e2";  ///< inside of walls and obstacles
  static constexpr const char* kEdge = "#4a5563";   ///< their outline
  static constexpr const char* kLow = "#efe3c8";    ///< obstacles of finite height
  static constexpr const char* kLowEdge = "#b08d3c";
  static constexpr const char* kMoving = "#c2255c";
};

/// Blocked cells as two embedded pictures: the inside of walls, and their outline. Empty without a map.
std::string map_layer(const world::Scenario& scenario, const SvgView& view);

/// @param makespan s, how long moving obstacles are followed
/// @param interval s between their drawn positions
std::string obstacle_layer(const world::Scenario& scenario, const SvgView& view, double makespan,
                           double interval);

/// One outline a model, with the id "m<index>": origin at the rear axle, x forward, px.
std::string footprint_definitions(const world::Scenario& scenario, const SvgView& view);

/// Cars on their way, every `interval` seconds, more solid the later.
std::string ghost_layer(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                        const SvgView& view, double interval);
/// The ways of the rear axles: solid forward, dashed backward, a ring at every gear change.
std::string path_layer(const traj::TeamTrajectory& plan, const SvgView& view);
/// Starts as outlines, goals filled, both with a tick that points forward.
std::string end_layer(const world::Scenario& scenario, const SvgView& view);
/// Names at the starts, where they are few.
std::string name_layer(const world::Scenario& scenario, const SvgView& view);

}  // namespace seine::io
