#include "seine/io/plan_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "seine/io/file_bytes.hpp"
#include "seine/io/message.hpp"
#include "seine/io/number_text.hpp"

namespace seine::io {
namespace {

using nlohmann::json;

constexpr std::size_t kPlanBytes = std::size_t{256} << 20;
constexpr int kDeepest = 32;       // levels of brackets; a plan has nine
constexpr double kLongest = 1e6;   // s
constexpr double kLargest = 1e15;  // of a coefficient

/// A JSON value that knows where it stands.
class Place {
 public:
  Place(const json& value, const std::string& file, std::string path)
      : value_(value), file_(file), path_(std::move(path)) {}

  [[noreturn]] void fail(std::string_view message) const {
    throw complaint(file_, 0, joined(path_.empty() ? "the file" : path_, " ", message));
  }

  Place at(const char* key) const {
    const auto found = member(key);
    if (found == value_.end()) fail(joined("has no '", key, "', which is required"));
    return {*found, file_, path_.empty() ? key : joined(path_, ".", key)};
  }
  bool has(const char* key) const { return member(key) != value_.end(); }

  template <class Visit>
  void each(std::size_t least, std::size_t most, Visit&& visit) const {
    if (!value_.is_array()) fail(joined("is of type ", value_.type_name(), ", expected a list"));
    if (value_.size() < least || value_.size() > most) {
      fail(joined("has ", value_.size(), " entries, expected ",
                  least == most ? std::to_string(least) : joined(least, " to ", most)));
    }
    for (std::size_t i = 0; i < value_.size(); ++i)
      visit(Place(value_[i], file_, joined(path_, "[", i, "]")));
  }

  double number(double low, double high) const {
    if (!value_.is_number()) fail(joined("is of type ", value_.type_name(), ", expected a number"));
    const double number = value_.get<double>();
    if (!(low <= number && number <= high)) {
      fail(joined("is ", number_text(number), ", expected ", number_text(low), " to ", number_text(high)));
    }
    return number;
  }

  std::string text() const {
    if (!value_.is_string()) fail(joined("is of type ", value_.type_name(), ", expected a text"));
    return value_.get<std::string>();
  }

 private:
  json::const_iterator member(const char* key) const {
    if (!value_.is_object()) fail(joined("is of type ", value_.type_name(), ", expected an object"));
    return value_.find(key);
  }

  const json& value_;
  const std::string& file_;
  std::string path_;
};

/// Refused before the parser spends memory on it.
void expect_shallow(std::string_view text, const std::string& file) {
  int depth = 0, line = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    line += c == '\n' ? 1 : 0;
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
      continue;
    }
    quoted = c == '"';
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kDeepest) throw complaint(file, line, "is nested too deeply to be a plan");
  }
}

json parse_json(std::string_view text, const std::string& file) {
  expect_shallow(text, file);
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    throw complaint(file, 1 + static_cast<int>(std::count(text.begin(), end, '\n')), "is not valid JSON");
  } catch (const json::exception&) {
    throw complaint(file, 0, "is not valid JSON: a number is too large");
  }
}

traj::Quintic read_quintic(const Place& place) {
  traj::Quintic quintic{};
  std::size_t i = 0;
  place.each(6, 6, [&](const Place& c) { quintic[i++] = c.number(-kLargest, kLargest); });
  return quintic;
}

traj::Segment read_segment(const Place& place) {
  constexpr std::size_t kMost = 1'000'000;
  traj::Segment segment;
  const double gear = place.at("gear").number(-1, 1);
  if (gear != 1.0 && gear != -1.0) place.at("gear").fail("is no gear, expected 1 or -1");
  segment.gear = gear > 0 ? 1 : -1;
  segment.wait = place.has("wait") ? place.at("wait").number(0.0, kLongest) : 0.0;
  segment.piece_duration = place.at("piece_duration").number(1e-9, kLongest);
  place.at("curve").each(1, kMost, [&](const Place& piece) {
    std::array<traj::Quintic, 2> axes{};
    std::size_t axis = 0;
    piece.each(2, 2, [&](const Place& quintic) { axes[axis++] = read_quintic(quintic); });
    segment.curve.push_back(axes);
  });
  place.at("progress").each(1, kMost, [&](const Place& piece) {
    segment.progress.push_back(read_quintic(piece));
  });
  return segment;
}

geom::Pose2 read_stand(const Place& place) {
  std::array<double, 3> pose{};
  std::size_t i = 0;
  place.each(3, 3, [&](const Place& value) { pose[i++] = value.number(-kLargest, kLargest); });
  return {pose[0], pose[1], pose[2]};
}

world::Fingerprint read_fingerprint(const Place& place) {
  world::Fingerprint result;
  for (const world::FingerprintPart& part : world::kFingerprintParts) {
    const Place value = place.at(part.name);
    const std::string text = value.text();
    std::uint64_t& word = result.*part.value;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), word, 16);
    if (text.size() != 16 || error != std::errc() || end != text.data() + text.size())
      value.fail("is no fingerprint, expected 16 hexadecimal digits");
  }
  return result;
}

}  // namespace

PlanFile parse_plan(std::string_view text, const std::string& file) {
  const json root = parse_json(text, file);
  const Place top(root, file, "");
  if (!top.has("seine_plan")) throw complaint(file, 1, "is no plan, expected \"seine_plan\": 1");
  const Place version = top.at("seine_plan");
  if (version.number(-1e15, 1e15) != 1.0) version.fail("is a format this version cannot read, expected 1");
  PlanFile plan;
  plan.scenario = top.has("scenario") ? top.at("scenario").text() : "";
  if (top.has("made_for")) plan.made_for = read_fingerprint(top.at("made_for"));
  top.at("robots").each(1, 100'000, [&](const Place& robot) {
    plan.robots.push_back(robot.at("name").text());
    traj::RobotTrajectory& trajectory = plan.plan.robots.emplace_back();
    const Place segments = robot.at("segments");
    segments.each(0, 100'000,
                  [&](const Place& entry) { trajectory.segments.push_back(read_segment(entry)); });
    if (robot.has("stands")) trajectory.stands = read_stand(robot.at("stands"));
    if (trajectory.arrival() > kLongest)
      segments.fail(joined("last longer than ", number_text(kLongest), " s"));
  });
  return plan;
}

PlanFile load_plan(const std::filesystem::path& path, Reading* reading) {
  if (reading != nullptr) reading->add_file(path);
  return parse_plan(read_file(path, kPlanBytes), path.string());
}

std::optional<std::vector<std::string>> changed_since(const world::Scenario& scenario, const PlanFile& plan) {
  if (!plan.made_for) return std::nullopt;
  return world::differences(world::fingerprint(scenario), *plan.made_for);
}

void expect_same_team(const world::Scenario& scenario, const PlanFile& plan, const std::string& file) {
  if (plan.robots.size() != scenario.robots.size()) {
    throw complaint(file, 0,
                    joined("is a plan for ", plan.robots.size(), " robots, expected the ",
                           scenario.robots.size(), " of the scenario"));
  }
  for (std::size_t i = 0; i < plan.robots.size(); ++i) {
    if (plan.robots[i] == scenario.robots[i].name) continue;
    throw complaint(file, 0,
                    joined("robots[", i, "] is '", plan.robots[i].substr(0, 60), "', expected '",
                           scenario.robots[i].name, "' as in the scenario"));
  }
}

}  // namespace seine::io
