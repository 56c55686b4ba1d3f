#include <algorithm>
#include <cmath>

#include "seine/geom/polygon.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/scenario_formats.hpp"

namespace seine::io {
namespace {

constexpr double kWorkspaceMargin = 8.0;  // m around start and goal, as the benchmark plots it
constexpr double kFarthest = 1e12;        // m
// Two of the twenty cases lie some 10^9 m from the origin, where a double resolves a micrometre and products
// of coordinates nothing at all: farther than this from it (m), the origin moves to the whole metre nearest
// to the start. The subtraction is exact.
constexpr double kFar = kCoordinate.high;
constexpr double kLongestDrive = 1e5;    // m, from start to goal
constexpr double kFarthestVertex = 1e6;  // m, from the start

/// The numbers of a TPCAP file one after the other.
class NumberList {
 public:
  NumberList(std::string_view text, const std::string& file) : rest_(text), file_(file) {}

  double next(const char* what) {
    ++count_;
    if (done_) fail(std::string("is missing, expected ") + what);
    const std::size_t comma = rest_.find(',');
    std::string_view cell = rest_.substr(0, comma);
    done_ = comma == std::string_view::npos;
    rest_ = done_ ? std::string_view{} : rest_.substr(comma + 1);
    while (!cell.empty() && is_space(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && is_space(cell.back())) cell.remove_suffix(1);
    if (done_ && cell.empty()) fail(std::string("is missing, expected ") + what);
    const std::optional<double> value = parse_number(cell);
    if (!value || std::abs(*value) > kFarthest) fail(std::string("is no sane number, expected ") + what);
    return *value;
  }

  std::size_t next_count(const char* what, std::size_t least, std::size_t most) {
    const double value = next(what);
    if (value != std::floor(value) || value < static_cast<double>(least) ||
        value > static_cast<double>(most)) {
      fail(joined("is ", number_text(value), ", expected ", what, ": ", least, " to ", most));
    }
    return static_cast<std::size_t>(value);
  }

  void expect_end() const {
    if (!done_ && rest_.find_first_not_of(", \t\r\n") != std::string_view::npos) {
      throw complaint(file_, 1, joined("goes on after value ", count_, ", expected its end"));
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw complaint(file_, 1, joined("value ", count_, " ", message));
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  std::string_view rest_;
  const std::string& file_;
  std::size_t count_ = 0;
  bool done_ = false;
};

geom::Vec2 origin_near(geom::Vec2 start) {
  return std::max(std::abs(start.x), std::abs(start.y)) > kFar
             ? geom::Vec2{std::round(start.x), std::round(start.y)}
             : geom::Vec2{};
}

geom::Pose2 read_pose(NumberList& numbers) {
  const double x = numbers.next("x of start or goal"), y = numbers.next("y of start or goal");
  return {x, y, geom::wrap_angle(numbers.next("heading of start or goal"))};
}

std::vector<geom::Vec2> read_polygon(NumberList& numbers, std::size_t vertices, geom::Vec2 origin,
                                     geom::Vec2 start) {
  std::vector<geom::Vec2> polygon;
  for (std::size_t i = 0; i < vertices; ++i) {
    const double x = numbers.next("x of a vertex"), y = numbers.next("y of a vertex");
    const geom::Vec2 vertex = geom::Vec2{x, y} - origin, off = vertex - start;
    if (std::max(std::abs(off.x), std::abs(off.y)) > kFarthestVertex)
      numbers.fail("puts a vertex too far from the start");
    polygon.push_back(vertex);
  }
  // Some cases repeat vertices to fill up their polygons.
  return geom::without_repeats(std::move(polygon));
}

void read_obstacles(NumberList& numbers, const std::string& file, geom::Vec2 origin,
                    world::Scenario& scenario) {
  const geom::Vec2 start = scenario.robots.front().start.position();
  const std::size_t count = numbers.next_count("the number of obstacles", 0, ScenarioCaps::kObstacles);
  std::vector<std::size_t> sizes;
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sizes.push_back(numbers.next_count("a number of vertices", 3, ScenarioCaps::kPolygonVertices));
    vertices += sizes.back();
    if (vertices > ScenarioCaps::kVertices) numbers.fail("makes too many vertices in all");
  }
  for (std::size_t i = 0; i < count; ++i) {
    world::Obstacle obstacle{.name = joined("obstacle ", i + 1), .shape = {}, .motion = {}};
    std::vector<geom::Vec2> polygon = read_polygon(numbers, sizes[i], origin, start);
    const std::string wrong = geom::why_not_simple(polygon);
    if (!wrong.empty()) throw complaint(file, 1, obstacle.name + " is no simple polygon: " + wrong);
    obstacle.shape = std::move(polygon);
    scenario.obstacles.push_back(std::move(obstacle));
  }
}

}  // namespace

world::Scenario read_tpcap(std::string_view text, const std::string& file, const std::string& name) {
  NumberList numbers(text, file);
  world::Scenario scenario;
  scenario.name = name;
  scenario.models = {vehicle::tpcap_car()};
  scenario.margins = {0.0, 0.0};
  world::Robot robot{.name = "car0", .start = read_pose(numbers), .goal = read_pose(numbers)};
  const geom::Vec2 origin = origin_near(robot.start.position());
  for (geom::Pose2* pose : {&robot.start, &*robot.goal}) pose->x -= origin.x, pose->y -= origin.y;
  if (geom::norm(robot.goal->position() - robot.start.position()) > kLongestDrive)
    numbers.fail("ends a goal too far from the start");
  scenario.bounds.include(robot.start.position());
  scenario.bounds.include(robot.goal->position());
  scenario.bounds = scenario.bounds.inflated(kWorkspaceMargin);
  scenario.robots.push_back(std::move(robot));
  read_obstacles(numbers, file, origin, scenario);
  numbers.expect_end();
  return scenario;
}

}  // namespace seine::io
