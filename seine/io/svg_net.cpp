// The net along time, what flies into it or lies in it, and where it is to be brought.
#include <algorithm>
#include <cmath>

#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/palette.hpp"
#include "seine/io/svg_layers.hpp"
#include "seine/net/flight.hpp"
#include "seine/net/hanging.hpp"

namespace seine::io {
namespace {

using geom::Vec2;

constexpr int kPathSamples = 120;  // of an attachment's way: hardly a pixel off
constexpr int kFlightSamples = 40;
constexpr double kMostBetween = 5.0;  // nets between the start, the catches and the end
constexpr double kLeastBall = 3.5;    // px

/// Where the net is held at time t; at the starts without a plan.
std::vector<Vec2> corners_at(const world::Scenario& scenario, const traj::TeamTrajectory* plan, double t) {
  std::vector<Vec2> corners;
  for (std::size_t k = 0; k < scenario.robots.size(); ++k) {
    const geom::Pose2 pose = plan != nullptr ? plan->robots[k].at(t).pose : scenario.robots[k].start;
    corners.push_back(pose * scenario.net->attachments[k].at);
  }
  return corners;
}

std::string ring(const std::vector<Vec2>& corners, const SvgView& view) {
  std::string data;
  for (const Vec2 corner : corners) data += joined(data.empty() ? "M" : "L", px(view(corner)));
  return data + "Z";
}

/// Times of the catches that a plan of this length meets, s.
std::vector<double> catches(const world::Scenario& scenario, double makespan) {
  std::vector<double> times;
  for (const net::Target& target : scenario.targets) {
    const auto crossing = net::Flight(target).crossing(scenario.net->rim());
    if (crossing && crossing->state.time >= 0.0 && crossing->state.time <= makespan)
      times.push_back(crossing->state.time);
  }
  return times;
}

std::string attachment_ways(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
                            const SvgView& view) {
  std::string out;
  for (std::size_t k = 0; k < plan.robots.size(); ++k) {
    const double arrival = plan.robots[k].arrival();
    std::string data;
    for (int i = 0; i <= kPathSamples; ++i) {
      const Vec2 at = plan.robots[k].at(arrival * i / kPathSamples).pose * scenario.net->attachments[k].at;
      data += joined(data.empty() ? "M" : "L", px(view(at)));
    }
    out += joined("<path stroke=\"", car_colour(k), "\" d=\"", data, "\"/>\n");
  }
  return joined("<g fill=\"none\" stroke-width=\"0.9\" stroke-opacity=\"0.6\" stroke-dasharray=\"1 2.5\">\n",
                out, "</g>\n");
}

std::string ball(const char* fill, const char* edge, Vec2 at, double radius, const SvgView& view) {
  const Vec2 p = view(at);
  return joined("<circle cx=\"", px(p.x), "\" cy=\"", px(p.y), "\" r=\"",
                px(std::max(kLeastBall, view.scale * radius)), "\" fill=\"", fill, "\" stroke=\"", edge,
                "\"/>\n");
}

/// What lies in the net, where it hangs.
std::string load(const std::vector<Vec2>& corners, const world::Scenario& scenario, double radius,
                 const SvgView& view) {
  for (const net::Hanging& hanging : net::equilibria(scenario.net->rest, corners, scenario.net->rim())) {
    if (!hanging.at_edge) return ball(SvgInk::kTarget, "#fff", hanging.position.ground(), radius, view);
  }
  return "";
}

/// The way over ground from the release to the rim, and a ring with a cross where it falls through it.
std::string flight(const net::Target& target, double rim, const SvgView& view) {
  const net::Flight flight(target);
  const auto crossing = flight.crossing(rim);
  if (!crossing) return "";
  const net::FlightState& end = crossing->state;
  std::string data;
  for (int i = 0; i <= kFlightSamples; ++i) {
    const double t = target.time + (end.time - target.time) * i / kFlightSamples;
    data += joined(data.empty() ? "M" : "L", px(view(flight.at(t).position.ground())));
  }
  const Vec2 at = view(end.position.ground());
  return joined("<path fill=\"none\" stroke=\"", SvgInk::kTarget,
                "\" stroke-width=\"1.6\" stroke-dasharray=\"6 3\" d=\"", data, "\"/>\n",
                ball("#fff", SvgInk::kTarget, target.position.ground(), target.radius, view),
                "<g fill=\"none\" stroke=\"", SvgInk::kTarget,
                "\" stroke-width=\"1.8\" transform=\"translate(", px(at),
                ")\"><circle r=\"6\"/><path d=\"M-9.5 0H9.5M0-9.5V9.5\"/></g>\n<text stroke=\"#fff\" "
                "stroke-width=\"2.5\" x=\"",
                px(at.x + 10.0), "\" y=\"", px(at.y - 7.0), "\">", rounded_text(end.time, 2), " s</text>\n");
}

}  // namespace

std::string delivery_layer(const world::Scenario& scenario, const SvgView& view) {
  if (!scenario.delivery) return "";
  const net::Delivery& delivery = *scenario.delivery;
  const Vec2 at = view(delivery.center);
  std::string out =
      joined("<circle cx=\"", px(at.x), "\" cy=\"", px(at.y), "\" r=\"", px(view.scale * delivery.radius),
             "\" fill=\"", SvgInk::kDelivery, "\" fill-opacity=\"0.14\" stroke=\"", SvgInk::kDelivery,
             "\" stroke-width=\"1.4\" stroke-dasharray=\"5 3\"/>\n");
  if (delivery.heading) {
    const Vec2 tip = view(delivery.center + delivery.radius * geom::unit(*delivery.heading));
    out += joined("<path d=\"M", px(at), "L", px(tip), "\" stroke-width=\"1.4\" stroke=\"", SvgInk::kDelivery,
                  "\"/>\n");
  }
  return out;
}

std::string net_layer(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                      const SvgView& view) {
  if (!scenario.net) return "";
  const double end = plan != nullptr ? plan->makespan() : 0.0;
  std::vector<double> shown = plan != nullptr ? catches(scenario, end) : std::vector<double>{};
  shown.push_back(0.0);
  if (plan != nullptr) shown.push_back(end);
  std::string faint, clear;
  const double step = end / (kMostBetween + 1.0);
  for (int i = 1; i <= kMostBetween; ++i) {
    const double t = i * step;
    const bool near = std::any_of(shown.begin(), shown.end(),
                                  [&](double other) { return std::abs(other - t) < 0.4 * step; });
    if (step > 0.0 && !near) faint += ring(corners_at(scenario, plan, t), view);
  }
  for (const double t : shown) clear += ring(corners_at(scenario, plan, t), view);
  const auto path = [](const std::string& data, const char* fill, const char* width) {
    return data.empty() ? ""
                        : joined("<path fill-opacity=\"", fill, "\" stroke-width=\"", width, "\" d=\"", data,
                                 "\"/>\n");
  };
  std::string out = joined("<g fill=\"", SvgInk::kNet, "\" fill-rule=\"nonzero\" stroke=\"", SvgInk::kNet,
                           "\" stroke-linejoin=\"round\">\n", path(faint, "0.05", "0.6"),
                           path(clear, "0.13", "1.5"), "</g>\n");
  if (plan != nullptr) out += attachment_ways(scenario, *plan, view);
  return out;
}

std::string target_layer(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                         const SvgView& view) {
  if (!scenario.net) return "";
  std::string out;
  for (const net::Target& target : scenario.targets) out += flight(target, scenario.net->rim(), view);
  if (scenario.payload)
    out += load(corners_at(scenario, plan, 0.0), scenario, scenario.payload->radius, view);
  const bool caught = plan != nullptr && !catches(scenario, plan->makespan()).empty();
  if (plan != nullptr && (caught || scenario.payload)) {
    const double radius = scenario.payload ? scenario.payload->radius : scenario.targets.front().radius;
    out += load(corners_at(scenario, plan, plan->makespan()), scenario, radius, view);
  }
  return joined("<g font-size=\"11\" fill=\"", SvgInk::kTarget,
                "\" stroke-linejoin=\"round\" style=\"paint-order:stroke\">\n", out, "</g>\n");
}

}  // namespace seine::io
