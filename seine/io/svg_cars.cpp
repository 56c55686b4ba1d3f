#include <cmath>
#include <numbers>
#include <numeric>

#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/palette.hpp"
#include "seine/io/svg_layers.hpp"

namespace seine::io {
namespace {

using geom::Vec2;

constexpr std::size_t kNamedCars = 16;  // more names than this hide the picture

/// "translate(x y) rotate(degrees)" of a body frame on the page.
std::string placement(const geom::Pose2& pose, const SvgView& view) {
  const double degrees = -pose.heading * 180.0 / std::numbers::pi;
  return joined("translate(", px(view(pose.position())), ") rotate(", px(degrees), ")");
}

std::string car(int model, const geom::Pose2& pose, const SvgView& view, const std::string& attributes) {
  return joined("<use xlink:href=\"#m", model, "\" transform=\"", placement(pose, view), "\"", attributes,
                "/>\n");
}

/// One quintic as two cubic Bézier curves that share its ends and tangents: off by less than the width of the
/// line.
std::string bezier(const std::array<traj::Quintic, 2>& piece, const SvgView& view) {
  const auto value = [&](double w) {
    Vec2 p;
    for (std::size_t k = 6; k-- > 0;) p = w * p + Vec2{piece[0][k], piece[1][k]};
    return p;
  };
  const auto slope = [&](double w) {
    Vec2 d;
    for (std::size_t k = 6; k-- > 1;) d = w * d + static_cast<double>(k) * Vec2{piece[0][k], piece[1][k]};
    return d;
  };
  constexpr int kParts = 2;
  std::string data;
  for (int part = 0; part < kParts; ++part) {
    const double from = part / double(kParts), to = (part + 1) / double(kParts), third = (to - from) / 3.0;
    data += joined("C", px(view(value(from) + third * slope(from))), " ",
                   px(view(value(to) - third * slope(to))), " ", px(view(value(to))));
  }
  return data;
}

Vec2 beginning(const traj::Segment& segment) {
  return {segment.curve[0][0][0], segment.curve[0][1][0]};
}

/// False for a segment whose progress stays at 0: the car has nowhere to go.
bool moves(const traj::Segment& segment) {
  if (segment.curve.empty() || segment.progress.empty()) return false;
  const traj::Quintic& last = segment.progress.back();
  return std::accumulate(last.begin(), last.end(), 0.0) > 1e-6;
}

/// Path data of a robot's segments in one gear; gear 0 takes all.
std::string way(const traj::RobotTrajectory& robot, int gear, const SvgView& view) {
  std::string data;
  for (const traj::Segment& segment : robot.segments) {
    if (!moves(segment) || (gear != 0 && segment.gear != gear)) continue;
    data += joined("M", px(view(beginning(segment))));
    for (const auto& piece : segment.curve) data += bezier(piece, view);
  }
  return data;
}

std::string stroke(const std::string& data, const char* attributes) {
  return data.empty() ? "" : joined("<path ", attributes, " d=\"", data, "\"/>\n");
}

std::string cusps(const traj::RobotTrajectory& robot, const SvgView& view) {
  std::string out;
  for (std::size_t i = 1; i < robot.segments.size(); ++i) {
    if (robot.segments[i].curve.empty() || robot.segments[i].gear == robot.segments[i - 1].gear) continue;
    const Vec2 at = view(beginning(robot.segments[i]));
    out += joined("<circle cx=\"", px(at.x), "\" cy=\"", px(at.y),
                  "\" r=\"3\" fill=\"#fff\" stroke-width=\"1.4\"/>\n");
  }
  return out;
}

/// From the middle of the footprint to its front edge, in the body frame, px.
std::string tick(const vehicle::Model& model, const SvgView& view) {
  const geom::Box box = geom::bounding_box(model.footprint);
  return joined("<path d=\"M", px(view.scale * box.center().x), " 0H",
                px(view.scale * (box.high.x - 0.08 * box.size().x)), "\"/>");
}

/// Whether a car at the one place covers, to the eye, the one at the other.
bool hides(const geom::Pose2& a, const geom::Pose2& b, double length) {
  constexpr double kPlace = 0.05, kTurn = 0.05;  // car lengths, rad
  return geom::norm(a.position() - b.position()) < kPlace * length &&
         std::abs(geom::wrap_angle(a.heading - b.heading)) < kTurn;
}

/// Above the car as it stands at its start.
std::string name_label(const world::Robot& robot, const vehicle::Model& model, const SvgView& view) {
  geom::Box box;
  for (const Vec2 corner : model.footprint) box.include(robot.start * corner);
  const Vec2 at = view({box.center().x, box.high.y}) - Vec2{0.0, 4.5};
  return joined("<text x=\"", px(at.x), "\" y=\"", px(at.y), "\">", xml_text(robot.name), "</text>\n");
}

}  // namespace

std::string footprint_definitions(const world::Scenario& scenario, const SvgView& view) {
  std::string out;
  for (std::size_t i = 0; i < scenario.models.size(); ++i) {
    std::string data;
    for (const Vec2 p : scenario.models[i].footprint) {
      data += joined(data.empty() ? "M" : "L", px(view.scale * Vec2{p.x, -p.y}));
    }
    out += joined("<path id=\"m", i, "\" d=\"", data, "Z\"/>\n");
  }
  return out;
}

std::string ghost_layer(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                        const SvgView& view, double interval) {
  const double makespan = std::max(plan.makespan(), 1e-9);
  std::string out = "<g stroke-width=\"0.5\" stroke-opacity=\"0.4\">\n";
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const std::string colour = car_colour(k);
    out += joined("<g fill=\"", colour, "\" stroke=\"", colour, "\">\n");
    const double arrival = plan.robots[k].arrival();
    for (int i = 1; i < 400 && i * interval < arrival; ++i) {
      const double opacity = 0.05 + 0.22 * (i * interval) / makespan;
      out += car(scenario.robots[k].model, plan.robots[k].at(i * interval).pose, view,
                 joined(" fill-opacity=\"", px(opacity), "\""));
    }
    out += "</g>\n";
  }
  return out + "</g>\n";
}

std::string path_layer(const traj::TeamTrajectory& plan, const SvgView& view) {
  std::string halo,
      out = "<g fill=\"none\" stroke-width=\"1.9\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
  for (const traj::RobotTrajectory& robot : plan.robots) halo += way(robot, 0, view);
  out += stroke(halo, "stroke=\"#fff\" stroke-width=\"4\" stroke-opacity=\"0.7\"");
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const traj::RobotTrajectory& robot = plan.robots[k];
    out += joined("<g stroke=\"", car_colour(k), "\">\n", stroke(way(robot, 1, view), ""),
                  stroke(way(robot, -1, view), "stroke-dasharray=\"5 4\" stroke-linecap=\"butt\""),
                  cusps(robot, view), "</g>\n");
  }
  return out + "</g>\n";
}

std::string end_layer(const world::Scenario& scenario, const SvgView& view) {
  std::string starts = "<g fill=\"#fff\" stroke-width=\"1.4\" stroke-linejoin=\"round\">\n";
  std::string goals = "<g stroke-width=\"1.2\" stroke-linejoin=\"round\">\n";
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const world::Robot& robot = scenario.robots[k];
    const vehicle::Model& model = scenario.model_of(robot);
    const std::string colour = car_colour(k), line = joined(" stroke=\"", colour, "\"");
    // Where the start would hide the goal it is filled like one.
    const bool stays = robot.goal && hides(robot.start, *robot.goal, model.length());
    starts += car(robot.model, robot.start, view, stays ? joined(line, " fill=\"", colour, "\"") : line);
    starts += joined("<g transform=\"", placement(robot.start, view), "\"",
                     stays ? std::string(" stroke=\"#fff\"") : line, ">", tick(model, view), "</g>\n");
    if (!robot.goal) continue;
    goals += car(robot.model, *robot.goal, view, joined(line, " fill=\"", colour, "\""));
    goals += joined("<g transform=\"", placement(*robot.goal, view), "\" stroke=\"#fff\">", tick(model, view),
                    "</g>\n");
  }
  return joined(goals, "</g>\n", starts, "</g>\n");
}

std::string name_layer(const world::Scenario& scenario, const SvgView& view) {
  if (scenario.robots.size() > kNamedCars) return "";
  std::string labels;
  for (const world::Robot& robot : scenario.robots)
    labels += name_label(robot, scenario.model_of(robot), view);
  return joined("<g font-size=\"10\" text-anchor=\"middle\" fill=\"", SvgInk::kText,
                "\" stroke=\"#fff\" stroke-width=\"2.5\" stroke-linejoin=\"round\" paint-order=\"stroke\">\n",
                labels, "</g>\n");
}

}  // namespace seine::io
