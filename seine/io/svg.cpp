#include "seine/io/svg.hpp"

#include <algorithm>
#include <cmath>

#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/palette.hpp"
#include "seine/io/svg_layers.hpp"

namespace seine::io {
namespace {

using geom::Vec2;

constexpr double kEdge = 24.0;      // px, white around everything
constexpr double kHead = 52.0;      // px, title and the line under it
constexpr double kRow = 22.0;       // px, one row of the legend
constexpr double kCharacter = 6.3;  // px, mean width of a 12 px letter

/// What the legend explains: a small drawing, 26 × 12 px with its middle at (13, 0), and a word.
struct LegendEntry {
  std::string drawing;
  std::string word;
};

std::string box_drawing(const std::string& attributes) {
  return joined("<rect x=\"2\" y=\"-5\" width=\"22\" height=\"10\" ", attributes, "/>");
}

std::string line_drawing(const char* attributes) {
  return joined("<path d=\"M1 0H25\" fill=\"none\" stroke-width=\"1.9\" ", attributes, "/>");
}

bool drives_backward(const traj::TeamTrajectory* plan) {
  return plan != nullptr && std::any_of(plan->robots.begin(), plan->robots.end(), [](const auto& robot) {
           return std::any_of(robot.segments.begin(), robot.segments.end(),
                              [](const auto& s) { return s.gear < 0; });
         });
}

void add_net_entries(const world::Scenario& scenario, std::vector<LegendEntry>& entries) {
  if (!scenario.net) return;
  const auto ink = [](const char* colour) {
    return joined("stroke=\"", colour, "\" fill=\"", colour, "\" ");
  };
  entries.push_back(
      {box_drawing(joined(ink(SvgInk::kNet), "fill-opacity=\"0.13\" stroke-width=\"1.5\"")), "net"});
  if (!scenario.targets.empty()) {
    entries.push_back(
        {joined(line_drawing(joined("stroke-dasharray=\"5 3\" stroke=\"", SvgInk::kTarget, "\"").c_str()),
                "<circle cx=\"20\" r=\"4\" fill=\"none\" stroke=\"", SvgInk::kTarget,
                "\"/><path d=\"M20-6V6\" stroke=\"", SvgInk::kTarget, "\"/>"),
         "target, caught"});
  }
  if (scenario.payload) {
    entries.push_back({joined("<circle cx=\"13\" r=\"4\" fill=\"", SvgInk::kTarget, "\"/>"), "payload"});
  }
  if (scenario.delivery) {
    entries.push_back({joined("<circle cx=\"13\" r=\"6\" stroke-dasharray=\"3 2\" fill-opacity=\"0.14\" ",
                              ink(SvgInk::kDelivery), "/>"),
                       "delivery"});
  }
}

void add_obstacle_entries(const world::Scenario& scenario, std::vector<LegendEntry>& entries) {
  const auto any = [&](auto&& test) {
    return std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(), test);
  };
  const auto shape = [](const char* fill, const char* edge) {
    return box_drawing(joined("fill=\"", fill, "\" stroke-width=\"1.2\" stroke=\"", edge, "\""));
  };
  if (scenario.map || any([&](const auto& o) { return o.motion.empty() && !is_low(scenario, o); })) {
    entries.push_back({shape(SvgInk::kSolid, SvgInk::kEdge), "obstacle"});
  }
  if (any([&](const auto& o) { return o.motion.empty() && is_low(scenario, o); })) {
    entries.push_back({shape("url(#low)", SvgInk::kLowEdge), "low obstacle"});
  }
  if (any([](const auto& o) { return !o.motion.empty(); })) {
    entries.push_back({box_drawing(joined("fill-opacity=\"0.4\" fill=\"", SvgInk::kMoving, "\" stroke=\"",
                                          SvgInk::kMoving, "\"")),
                       "moving obstacle"});
  }
}

std::vector<LegendEntry> legend_entries(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                                        double interval) {
  const std::string car = car_colour(0), stroke = joined("stroke=\"", car, "\" ");
  std::vector<LegendEntry> entries;
  entries.push_back({joined("<g ", stroke, "stroke-width=\"1.4\">", box_drawing("fill=\"#fff\""),
                            "<path d=\"M13 0H22\"/></g>"),
                     "start"});
  if (std::any_of(scenario.robots.begin(), scenario.robots.end(),
                  [](const auto& r) { return r.goal.has_value(); })) {
    entries.push_back({joined(box_drawing(joined("fill=\"", car, "\"")),
                              "<path d=\"M13 0H22\" stroke=\"#fff\" stroke-width=\"1.2\"/>"),
                       "goal"});
  }
  if (plan != nullptr) {
    entries.push_back({line_drawing(stroke.c_str()), "forward"});
    if (drives_backward(plan)) {
      entries.push_back({line_drawing(joined(stroke, "stroke-dasharray=\"5 4\"").c_str()), "backward"});
      entries.push_back(
          {joined("<circle cx=\"13\" r=\"3\" fill=\"#fff\" stroke-width=\"1.4\" ", stroke, "/>"),
           "gear change"});
    }
    entries.push_back(
        {box_drawing(joined("fill=\"", car, "\" fill-opacity=\"0.2\" stroke-width=\"0.5\" ", stroke)),
         joined("every ", rounded_text(interval, 3), " s")});
  }
  add_obstacle_entries(scenario, entries);
  add_net_entries(scenario, entries);
  return entries;
}

/// The legend in rows below the drawn area; `height` grows by what it takes.
std::string legend(const std::vector<LegendEntry>& entries, Vec2 corner, double width, double& height) {
  std::string out = joined("<g font-size=\"12\" fill=\"", SvgInk::kText, "\">\n");
  double x = 0.0, y = kRow / 2;
  for (const LegendEntry& entry : entries) {
    const double wide = 34.0 + kCharacter * static_cast<double>(entry.word.size()) + 16.0;
    if (x > 0.0 && x + wide > width) x = 0.0, y += kRow;
    out += joined("<g transform=\"translate(", px(corner + Vec2{x, y}), ")\">", entry.drawing,
                  "<text x=\"32\" y=\"4\">", entry.word, "</text></g>\n");
    x += wide;
  }
  height += y + kRow / 2;
  return out + "</g>\n";
}

/// A round length, drawn at the right end of the row under the drawn area.
std::string scale_bar(const SvgView& view, Vec2 right) {
  const double length = round_below(view.world.size().x / 5.0), wide = view.scale * length;
  const Vec2 left = right - Vec2{wide, 0.0};
  return joined("<path d=\"M", px(left), "v-6m0 6H", px(right.x), "v-6\" fill=\"none\" stroke=\"",
                SvgInk::kText, "\" stroke-width=\"1.4\"/>\n<text x=\"", px(left.x - 8), "\" y=\"",
                px(right.y), "\" font-size=\"12\" text-anchor=\"end\" fill=\"", SvgInk::kText, "\">",
                rounded_text(length, 3), " m</text>\n");
}

std::string head(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                 const SvgOptions& options) {
  std::string facts = joined(scenario.robots.size(), scenario.robots.size() == 1 ? " car" : " cars");
  if (plan != nullptr) facts += joined(" \u00b7 makespan ", rounded_text(plan->makespan(), 2), " s");
  if (!options.note.empty()) facts += joined(" \u00b7 ", options.note);
  const std::string& title = options.title.empty() ? scenario.name : options.title;
  return joined("<text x=\"", px(kEdge), "\" y=\"", px(kEdge + 15),
                "\" font-size=\"19\" font-weight=\"600\" fill=\"", SvgInk::kText, "\">", xml_text(title),
                "</text>\n<text x=\"", px(kEdge), "\" y=\"", px(kEdge + 36), "\" font-size=\"13\" fill=\"",
                SvgInk::kFaint, "\">", xml_text(facts), "</text>\n");
}

/// All that lies inside the drawn area.
std::string scene(const world::Scenario& scenario, const traj::TeamTrajectory* plan, const SvgView& view,
                  double interval) {
  const Vec2 low = view(scenario.bounds.low), high = view(scenario.bounds.high);
  const std::string bounds = joined("x=\"", px(low.x), "\" y=\"", px(high.y), "\" width=\"",
                                    px(high.x - low.x), "\" height=\"", px(low.y - high.y), "\"");
  std::string out = joined("<rect ", bounds, " fill=\"", SvgInk::kFloor, "\"/>\n");
  out += map_layer(scenario, view);
  out += obstacle_layer(scenario, view, plan != nullptr ? plan->makespan() : 0.0, interval);
  out += delivery_layer(scenario, view);
  if (plan != nullptr) out += ghost_layer(scenario, *plan, view, interval);
  out += end_layer(scenario, view);
  out += net_layer(scenario, plan, view);
  // Ways lie over starts and goals: that is where cars change gear.
  if (plan != nullptr) out += path_layer(*plan, view);
  out += target_layer(scenario, plan, view);
  out += name_layer(scenario, view);
  out += joined("<rect ", bounds, " fill=\"none\" stroke=\"", SvgInk::kFaint, "\" stroke-width=\"1.5\"/>\n");
  // A thin frame where the bounds lie outside of what is drawn.
  const Vec2 size = view.size();
  return out + joined("<rect x=\"", px(view.corner.x), "\" y=\"", px(view.corner.y), "\" width=\"",
                      px(size.x), "\" height=\"", px(size.y), "\" fill=\"none\" stroke=\"", SvgInk::kFaint,
                      "\" stroke-width=\"0.8\"/>\n");
}

double ghost_interval(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                      const SvgOptions& options) {
  if (options.ghost_interval > 0.0) return options.ghost_interval;
  double span = plan != nullptr ? plan->makespan() : 0.0;
  if (plan == nullptr) {
    for (const world::Obstacle& o : scenario.obstacles)
      span = o.motion.empty() ? span : std::max(span, o.motion.back().t);
  }
  // Some 12 to 25 footprints a car: dense enough to see speed, sparse enough to see each.
  return span > 0.0 ? round_below(span / 10.0) : 1.0;
}

}  // namespace

std::string svg_text(const world::Scenario& scenario, const traj::TeamTrajectory* plan,
                     const SvgOptions& options) {
  if (plan != nullptr && plan->robots.size() != scenario.robots.size()) {
    throw Error(joined("a plan for ", plan->robots.size(), " robots does not fit a scenario with ",
                       scenario.robots.size()));
  }
  const SvgView view = choose_view(scenario, plan, options, {kEdge, kEdge + kHead});
  const double interval = ghost_interval(scenario, plan, options);
  const Vec2 area = view.size(), below{kEdge, kEdge + kHead + area.y + 12.0};
  const double width = std::max(area.x, 360.0),
               bar = view.scale * round_below(view.world.size().x / 5.0) + 60.0;
  double height = below.y;
  const std::string key = legend(legend_entries(scenario, plan, interval), below, width - bar, height);
  const std::string size = joined(px(width + 2 * kEdge), " ", px(height + kEdge));
  std::string out = joined(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"",
      px(width + 2 * kEdge), "\" height=\"", px(height + kEdge), "\" viewBox=\"0 0 ", size,
      "\" font-family=\"Inter, 'Helvetica Neue', Helvetica, Arial, sans-serif\">\n");
  out += joined("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<defs>\n",
                footprint_definitions(scenario, view), hatch_definition(), "<clipPath id=\"area\"><rect x=\"",
                px(kEdge - 1), "\" y=\"", px(kEdge + kHead - 1), "\" width=\"", px(area.x + 2),
                "\" height=\"", px(area.y + 2), "\"/></clipPath>\n</defs>\n");
  out += joined(head(scenario, plan, options), "<g clip-path=\"url(#area)\">\n",
                scene(scenario, plan, view, interval), "</g>\n", key,
                scale_bar(view, {kEdge + width, below.y + kRow / 2 + 4}), "</svg>\n");
  return out;
}

void write_svg(const world::Scenario& scenario, const traj::TeamTrajectory& plan,
               const std::filesystem::path& path, const SvgOptions& options) {
  write_file(path, svg_text(scenario, &plan, options));
}

void write_svg(const world::Scenario& scenario, const std::filesystem::path& path,
               const SvgOptions& options) {
  write_file(path, svg_text(scenario, nullptr, options));
}

}  // namespace seine::io
