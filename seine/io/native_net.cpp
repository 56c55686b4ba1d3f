// The keys of a team with a net: `net`, `targets`, `payload`, `delivery`.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "seine/geom/polygon.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"
#include "seine/io/scenario_file.hpp"
#include "seine/io/scenario_formats.hpp"

namespace seine::io {
namespace {

using geom::Vec2;

constexpr Range kMass{1e-4, 1e4};
constexpr Range kVelocity{-1e3, 1e3};
constexpr Range kDrag{0.0, 100.0};  // 1/m; a sheet of paper has some 2
constexpr Range kTime{-1e4, 1e6};
constexpr Range kVariance{-1e6, 1e6};

// A number inside an open interval: its ends make no sense.
double number_between(const YamlMap& map, std::string_view key, Range open, double otherwise) {
  const auto value = map.find(key);
  if (!value) return otherwise;
  const double given = value->number(kCoordinate);
  if (!(open.low < given && given < open.high)) {
    value->fail(joined("is ", number_text(given), ", expected more than ", number_text(open.low),
                       " and less than ", number_text(open.high)));
  }
  return given;
}

geom::Vec3 read_vector(const YamlValue& value, Range range) {
  const std::vector<double> xyz = value.numbers(3, range);
  return {xyz[0], xyz[1], xyz[2]};
}

void expect_corners(const YamlValue& value, std::size_t corners, std::size_t robots) {
  if (corners == robots) return;
  value.fail(joined("has ", corners, " entries, expected one for each of the ", robots, " robots"));
}

// Vertex 0 lies on the polygon's own x axis.
std::vector<Vec2> regular_net(const YamlValue& value, std::size_t corners) {
  const double side = value.map({"side"}).at("side").number(kSize);
  const double step = 2.0 * std::numbers::pi / static_cast<double>(corners);
  const double radius = 0.5 * side / std::sin(0.5 * step);
  std::vector<Vec2> rest;
  for (std::size_t k = 0; k < corners; ++k)
    rest.push_back(radius * geom::unit(step * static_cast<double>(k)));
  return rest;
}

std::vector<Vec2> read_rest(const YamlValue& value, std::size_t robots) {
  std::vector<Vec2> rest;
  // A closed ring gives its first corner twice.
  for (const YamlValue& entry : value.list(0, ScenarioCaps::kNetCorners + 1)) {
    const std::vector<double> xy = entry.numbers(2, kCoordinate);
    rest.push_back({xy[0], xy[1]});
  }
  rest = geom::without_repeats(std::move(rest));
  if (rest.size() < 3 || rest.size() > ScenarioCaps::kNetCorners)
    value.fail(joined("has ", rest.size(), " entries, expected 3 to ", ScenarioCaps::kNetCorners));
  expect_corners(value, rest.size(), robots);
  const std::string wrong = geom::why_not_simple(rest);
  if (!wrong.empty()) value.fail("is not simple: " + wrong);
  if (geom::signed_area(rest) < 0.0) {
    value.fail("is clockwise, expected counter-clockwise corners in the order of the robots");
  }
  if (!geom::is_convex(rest)) value.fail("is not convex, expected a convex polygon");
  return rest;
}

net::Attachment read_attachment(const YamlValue& value) {
  const YamlMap map = value.map({"x", "y", "z"});
  return {{map.number("x", kCoordinate, 0.2), map.number("y", kCoordinate, 0.0)},
          map.number("z", kSize, 1.0)};
}

std::vector<net::Attachment> read_attachments(const std::optional<YamlValue>& value, std::size_t robots) {
  if (!value) return {robots, net::Attachment{{0.2, 0.0}, 1.0}};
  if (!value->is_list()) return {robots, read_attachment(*value)};
  std::vector<net::Attachment> attachments;
  for (const YamlValue& entry : value->list(1, ScenarioCaps::kRobots)) {
    attachments.push_back(read_attachment(entry));
    if (attachments.back().height != attachments.front().height) {
      entry.fail(joined("has z = ", number_text(attachments.back().height), ", the first has ",
                        number_text(attachments.front().height),
                        "; attachments at different heights are not supported"));
    }
  }
  expect_corners(*value, attachments.size(), robots);
  return attachments;
}

net::Net read_net(const YamlValue& value, std::size_t robots) {
  const YamlMap map = value.map({"regular", "rest", "attachment", "stretch", "clearance", "rebound"});
  const auto regular = map.find("regular"), rest = map.find("rest");
  if (regular.has_value() == rest.has_value()) value.fail("expected one of 'regular' and 'rest'");
  if (robots < 3 || robots > ScenarioCaps::kNetCorners) {
    value.fail(joined("is held by ", robots, " robots, expected 3 to ", ScenarioCaps::kNetCorners));
  }
  net::Net net;
  net.rest = regular ? regular_net(*regular, robots) : read_rest(*rest, robots);
  net.attachments = read_attachments(map.find("attachment"), robots);
  net.stretch = number_between(map, "stretch", {0.5, 1.0}, net.stretch);
  net.clearance = map.number("clearance", {0.0, 100.0}, net.clearance);
  net.rebound = number_between(map, "rebound", {0.0, 1.0}, net.rebound);
  return net;
}

using Matrix6 = std::array<std::array<double, 6>, 6>;

// Elimination with the largest pivot first. A correlation matrix has entries of one size, so one tolerance
// does.
bool positive_semidefinite(Matrix6 c) {
  constexpr double kRounding = 1e-9;
  std::array<bool, 6> done{};
  for (int step = 0; step < 6; ++step) {
    std::size_t pivot = 6;
    for (std::size_t i = 0; i < 6; ++i)
      if (!done[i] && (pivot == 6 || c[i][i] > c[pivot][pivot])) pivot = i;
    const bool exhausted = c[pivot][pivot] <= kRounding;
    for (std::size_t i = 0; i < 6; ++i) {
      if (done[i]) continue;
      for (std::size_t j = 0; j < 6; ++j)
        if (exhausted && !done[j] && std::abs(c[i][j]) > kRounding) return false;
    }
    if (exhausted) return true;
    done[pivot] = true;
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        if (!done[i] && !done[j]) c[i][j] -= c[i][pivot] * c[pivot][j] / c[pivot][pivot];
  }
  return true;
}

// Each entry over the deviations of its row and column; none when the diagonal forbids it.
std::optional<Matrix6> correlation_of(const Matrix6& covariance) {
  Matrix6 correlation{};
  for (std::size_t i = 0; i < 6; ++i) {
    if (covariance[i][i] < 0.0) return std::nullopt;
    for (std::size_t j = 0; j < 6; ++j) {
      const double scale = std::sqrt(covariance[i][i]) * std::sqrt(covariance[j][j]);
      if (scale > 0.0) correlation[i][j] = covariance[i][j] / scale;
      if (scale == 0.0 && covariance[i][j] != 0.0) return std::nullopt;
    }
  }
  return correlation;
}

Matrix6 read_covariance(const YamlValue& value) {
  Matrix6 covariance{};
  const std::vector<YamlValue> rows = value.list(6, 6);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::vector<double> row = rows[i].numbers(6, kVariance);
    std::copy(row.begin(), row.end(), covariance[i].begin());
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (covariance[i][j] == covariance[j][i]) continue;
      value.fail(joined("is not symmetric: row ", j + 1, ", column ", i + 1, " is ",
                        number_text(covariance[j][i]), ", the other way round ",
                        number_text(covariance[i][j])));
    }
  }
  const auto correlation = correlation_of(covariance);
  if (!correlation || !positive_semidefinite(*correlation)) {
    value.fail("is not positive semidefinite, expected the covariance of (position, velocity)");
  }
  return covariance;
}

net::Target read_target(const YamlValue& value) {
  const YamlMap map = value.map({"time", "position", "velocity", "radius", "mass", "drag", "covariance"});
  net::Target target;
  target.time = map.number("time", kTime, target.time);
  target.position = read_vector(map.at("position"), kCoordinate);
  target.velocity = read_vector(map.at("velocity"), kVelocity);
  target.radius = map.number("radius", kSize, target.radius);
  target.mass = map.number("mass", kMass, target.mass);
  target.drag = map.number("drag", kDrag, target.drag);
  if (const auto covariance = map.find("covariance")) target.covariance = read_covariance(*covariance);
  return target;
}

net::Payload read_payload(const YamlValue& value) {
  const YamlMap map = value.map({"radius", "mass"});
  net::Payload payload;
  payload.radius = map.number("radius", kSize, payload.radius);
  payload.mass = map.number("mass", kMass, payload.mass);
  return payload;
}

net::Delivery read_delivery(const YamlValue& value) {
  const YamlMap map = value.map({"center", "radius", "heading"});
  net::Delivery delivery;
  const std::vector<double> center = map.at("center").numbers(2, kCoordinate);
  delivery.center = {center[0], center[1]};
  delivery.radius = map.number("radius", kSize, delivery.radius);
  if (const auto heading = map.find("heading")) delivery.heading = heading->heading();
  return delivery;
}

}  // namespace

void read_net_keys(const YamlMap& top, world::Scenario& scenario) {
  const auto net = top.find("net"), targets = top.find("targets");
  const auto payload = top.find("payload"), delivery = top.find("delivery");
  for (const auto& value : {targets, payload, delivery}) {
    if (value && !net) value->fail("is given without a 'net', expected the net that the team holds");
  }
  if (!net) return;
  if (targets && payload) payload->fail("is given together with 'targets', expected one of them");
  scenario.net = read_net(*net, scenario.robots.size());
  if (targets) {
    for (const YamlValue& entry : targets->list(1, ScenarioCaps::kTargets)) {
      scenario.targets.push_back(read_target(entry));
    }
  }
  if (payload) scenario.payload = read_payload(*payload);
  if (delivery) scenario.delivery = read_delivery(*delivery);
}

}  // namespace seine::io
