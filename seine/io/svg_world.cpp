#include <cmath>
#include <limits>
#include <numbers>

#include "seine/io/image.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/svg_layers.hpp"

namespace seine::io {
namespace {

using geom::Vec2;

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = (word << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k <= bytes.size() ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

/// The cells that matter to a view: columns and rows, ends excluded.
struct Window {
  int left, right, bottom, top;
};

Window visible_cells(const geom::OccupancyGrid& grid, const geom::Box& world) {
  const double c = std::cos(grid.origin.heading), s = std::sin(grid.origin.heading);
  geom::Box local;
  for (const Vec2 p :
       {world.low, world.high, Vec2{world.low.x, world.high.y}, Vec2{world.high.x, world.low.y}}) {
    const Vec2 d = p - grid.origin.position();
    local.include(Vec2{c * d.x + s * d.y, c * d.y - s * d.x} / grid.resolution);
  }
  const auto cell = [](double at, int count) {
    return static_cast<int>(std::clamp(std::floor(at), 0.0, double(count)));
  };
  return {cell(local.low.x, grid.width), cell(local.high.x + 1, grid.width), cell(local.low.y, grid.height),
          cell(local.high.y + 1, grid.height)};
}

bool touches_free(const geom::OccupancyGrid& grid, int column, int row) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (!grid.blocked(column + dx, row + dy)) return true;
    }
  }
  return false;
}

std::string embedded(const geom::OccupancyGrid& grid, const Window& window,
                     const std::vector<std::uint8_t>& mask, std::uint32_t colour, const SvgView& view) {
  const int width = window.right - window.left, height = window.top - window.bottom;
  const Vec2 origin = view(grid.origin * (grid.resolution * Vec2{double(window.left), double(window.top)}));
  const double a = view.scale * grid.resolution * std::cos(grid.origin.heading);
  const double b = view.scale * grid.resolution * std::sin(grid.origin.heading);
  std::string matrix;
  for (const double value : {a, -b, b, a, origin.x, origin.y}) matrix += rounded_text(value, 6) + " ";
  return joined("<image width=\"", width, "\" height=\"", height, "\" transform=\"matrix(", matrix,
                ")\" image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" "
                "preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,",
                base64(encode_mask_png(width, height, mask, colour)), "\"/>\n");
}

std::uint32_t rgb(const char* colour) {
  return static_cast<std::uint32_t>(std::stoul(colour + 1, nullptr, 16));
}

/// The outline of a shape whose body frame stands at `pose`, as path data.
std::string outline(const world::Obstacle& obstacle, const geom::Pose2& pose, const SvgView& view) {
  std::string data;
  if (const auto* polygon = std::get_if<std::vector<Vec2>>(&obstacle.shape)) {
    for (const Vec2 vertex : *polygon) data += joined(data.empty() ? "M" : "L", px(view(pose * vertex)));
    return data + "Z";
  }
  const auto& circle = std::get<world::Circle>(obstacle.shape);
  const double r = view.scale * circle.radius;
  const Vec2 left = view(pose * circle.center) - Vec2{r, 0.0};
  const std::string half = joined("a", px(r), " ", px(r), " 0 1 0 ");
  return joined("M", px(left), half, px(2 * r), " 0", half, px(-2 * r), " 0Z");
}

/// In the middle of a low obstacle, where there is room for it.
std::string height_label(const world::Obstacle& obstacle, const SvgView& view) {
  geom::Box box;
  if (const auto* polygon = std::get_if<std::vector<Vec2>>(&obstacle.shape)) {
    box = geom::bounding_box(*polygon);
  } else {
    const auto& circle = std::get<world::Circle>(obstacle.shape);
    box.include(circle.center);
    box = box.inflated(circle.radius);
  }
  if (view.scale * box.size().x < 22.0 || view.scale * box.size().y < 10.0) return "";
  const Vec2 at = view(box.center());
  return joined("<text x=\"", px(at.x), "\" y=\"", px(at.y + 3.0), "\">", rounded_text(obstacle.height, 2),
                " m</text>\n");
}

/// Where a moving obstacle stands at time t.
geom::Pose2 pose_at(const std::vector<world::Waypoint>& motion, double t) {
  if (t <= motion.front().t) return motion.front().pose;
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (t > motion[i].t) continue;
    const geom::Pose2 &from = motion[i - 1].pose, &to = motion[i].pose;
    const double part = (t - motion[i - 1].t) / (motion[i].t - motion[i - 1].t);
    const Vec2 p = from.position() + part * (to.position() - from.position());
    return {p.x, p.y, from.heading + part * geom::wrap_angle(to.heading - from.heading)};
  }
  return motion.back().pose;
}

std::string moving_obstacle(const world::Obstacle& obstacle, const SvgView& view, double makespan,
                            double interval) {
  const double until =
      std::min(makespan > 0.0 ? makespan : obstacle.motion.back().t, obstacle.motion.back().t);
  std::string way, ghosts;
  for (const world::Waypoint& waypoint : obstacle.motion) {
    if (waypoint.t <= until) way += joined(way.empty() ? "M" : "L", px(view(waypoint.pose.position())));
  }
  const geom::Pose2 last = pose_at(obstacle.motion, until);
  way += joined(way.empty() ? "M" : "L", px(view(last.position())));
  for (int i = 0; i < 200 && i * interval < until; ++i) {
    const double opacity = 0.10 + 0.25 * (i * interval) / std::max(until, 1e-9);
    ghosts += joined("<path fill-opacity=\"", px(opacity), "\" d=\"",
                     outline(obstacle, pose_at(obstacle.motion, i * interval), view), "\"/>\n");
  }
  return joined("<path fill=\"none\" stroke-dasharray=\"2 3\" d=\"", way, "\"/>\n", ghosts,
                "<path fill-opacity=\"0.5\" d=\"", outline(obstacle, last, view), "\"/>\n");
}

}  // namespace

std::string map_layer(const world::Scenario& scenario, const SvgView& view) {
  if (!scenario.map) return "";
  const geom::OccupancyGrid& grid = *scenario.map;
  const Window window = visible_cells(grid, view.world);
  if (window.left >= window.right || window.bottom >= window.top) return "";
  const auto cells = static_cast<std::size_t>(window.right - window.left) *
                     static_cast<std::size_t>(window.top - window.bottom);
  std::vector<std::uint8_t> solid(cells), edge(cells);
  std::size_t i = 0;
  for (int row = window.top - 1; row >= window.bottom; --row) {
    for (int column = window.left; column < window.right; ++column, ++i) {
      if (!grid.blocked(column, row)) continue;
      (touches_free(grid, column, row) ? edge : solid)[i] = 1;
    }
  }
  return embedded(grid, window, solid, rgb(SvgInk::kSolid), view) +
         embedded(grid, window, edge, rgb(SvgInk::kEdge), view);
}

bool is_low(const world::Scenario& scenario, const world::Obstacle& obstacle) {
  return obstacle.height < (scenario.net ? scenario.net->rim() : std::numeric_limits<double>::infinity());
}

std::string hatch_definition() {
  return joined(
      "<pattern id=\"low\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" "
      "patternTransform=\"rotate(45)\"><rect width=\"5\" height=\"5\" fill=\"#fffdf7\"/>"
      "<path d=\"M0 0V5\" stroke=\"",
      SvgInk::kLow, "\" stroke-width=\"4\"/></pattern>\n");
}

std::string obstacle_layer(const world::Scenario& scenario, const SvgView& view, double makespan,
                           double interval) {
  std::string tall, low, moving, heights;
  for (const world::Obstacle& obstacle : scenario.obstacles) {
    if (!obstacle.motion.empty()) {
      moving += moving_obstacle(obstacle, view, makespan, interval);
    } else if (is_low(scenario, obstacle)) {
      low += outline(obstacle, {}, view);
      heights += height_label(obstacle, view);
    } else {
      tall += outline(obstacle, {}, view);
    }
  }
  std::string out;
  const auto group = [&](const char* fill, const char* stroke, const std::string& data) {
    if (!data.empty()) {
      out += joined("<path fill=\"", fill, "\" stroke=\"", stroke,
                    "\" stroke-width=\"1.2\" stroke-linejoin=\"round\" d=\"", data, "\"/>\n");
    }
  };
  group("url(#low)", SvgInk::kLowEdge, low);
  group(SvgInk::kSolid, SvgInk::kEdge, tall);
  if (!heights.empty()) {
    out += joined("<g font-size=\"9\" text-anchor=\"middle\" fill=\"", SvgInk::kLowText, "\">\n", heights,
                  "</g>\n");
  }
  if (!moving.empty()) {
    out += joined("<g fill=\"", SvgInk::kMoving, "\" stroke=\"", SvgInk::kMoving,
                  "\" stroke-width=\"0.9\">\n", moving, "</g>\n");
  }
  return out;
}

}  // namespace seine::io
