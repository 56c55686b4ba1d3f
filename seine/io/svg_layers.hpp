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
  static constexpr const char* kLow = "#efe3c8";    ///< obstacles that a net passes over
  static constexpr const char* kLowEdge = "#b08d3c";
  static constexpr const char* kLowText = "#7a5d16";
  static constexpr const char* kMoving = "#c2255c";
  static constexpr const char* kNet = "#0f766e";
  static constexpr const char* kTarget = "#9f1239";  ///< what flies, and what lies in the net
  static constexpr const char* kDelivery = "#2b8a3e";
};

/// Blocked cells as two embedded pictures: the inside of walls, and their outline. Empty without a map.
std::string map_layer(const world::Scenario& scenario, const SvgView& view);

/// Obstacles over which a net may pass are hatched and show their height.
/// @param makespan s, how long moving obstacles are followed
/// @param interval s between their drawn positions
std::string obstacle_layer(const world::Scenario& scenario, const SvgView& view, double makespan,
                           double interval);

/// Whether a net, where there is one, could pass over it.
bool is_low(const world::Scenario& scenario, const world::Obstacle& obstacle);
/// The hatching of low obstacles, with the id "low".
std::string hatch_definition();

/// One outline a model, with the id "m<index>": origin at the rear axle, x forward, px.
std::string footprint_definitions(const world::Scenario& scenario, const SvgView& view);

/// Cars on their way, every `interval` seconds, more solid the later.
std::string ghost_layer(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                        const SvgView& view, double interval);
/// The ways of the rear axles: solid forward, dashed backward, a ring at every gear change.
std::string path_layer(const traj::TeamTrajectory& plan, const SvgView& view);
/// The region in which the team delivers.
std::string delivery_layer(const world::Scenario& scenario, const SvgView& view);
/// The net at the start, at every catch and at the end, more faintly in between, and the ways of its corners.
std::string net_layer(const world::Scenario& scenario, const traj::TeamTrajectory* plan, const SvgView& view);
/// Targets over ground until they fall through the rim, and what lies in the net.
std::string target_layer(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                         const SvgView& view);
/// Starts as outlines, goals filled, both with a tick that points forward.
std::string end_layer(const world::Scenario& scenario, const SvgView& view);
/// Names at the starts, where they are few.
std::string name_layer(const world::Scenario& scenario, const SvgView& view);

}  // namespace seine::io
