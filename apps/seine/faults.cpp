#include "apps/seine/faults.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "apps/seine/command.hpp"
#include "seine/base/error.hpp"
#include "seine/io/number_text.hpp"

namespace seine::app {

const char* const kFaultHelp =
    R"(Faults, --fault KIND:WHO@TIME+DURATION, times in seconds, as often as wanted
  lost-fix:CAR@T[+D]              the car's localisation is gone for D (0.5)
  failed-mpc:CAR@T[+D]            its controller fails for D (0.05, one step)
  late-replan@T[+D]               new plans asked for within D (0.1) come too late
  target-jump[:K]@T[+D]=X,Y,Z     the Kth target (1) is seen X, Y, Z metres from where it is, for D (0.1)
  breakdown:CAR@T                 the car brakes and answers no more)";

namespace {

constexpr double kLostFix = 0.5, kLateReplan = 0.1, kTargetJump = 0.1;  // s

// KIND[:WHO]@TIME[+DURATION][=SHIFT]
struct Parts {
  std::string kind, who, time, duration, shift;
};

std::string cut(std::string& text, char at) {
  const std::size_t place = text.find(at);
  if (place == std::string::npos) return {};
  std::string rest = text.substr(place + 1);
  text.resize(place);
  return rest;
}

Parts parts_of(std::string text) {
  Parts parts;
  parts.shift = cut(text, '=');
  parts.time = cut(text, '@');
  parts.duration = cut(parts.time, '+');
  parts.who = cut(text, ':');
  parts.kind = text;
  return parts;
}

class Reader {
 public:
  Reader(const std::string& text, const world::Scenario& scenario)
      : text_(text), parts_(parts_of(text)), scenario_(scenario) {}

  void add_to(sim::Faults& faults) const;

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError("--fault '" + text_ + "': " + why);
  }
  double seconds(const std::string& text, const char* what) const;
  double time() const { return seconds(parts_.time, "a time after @"); }
  double duration(double usual) const {
    return parts_.duration.empty() ? usual : seconds(parts_.duration, "a duration after +");
  }
  std::size_t robot() const;
  std::size_t target() const;
  geom::Vec3 shift() const;
  void expect_nobody() const {
    if (!parts_.who.empty())
      refuse("'" + parts_.kind + "' is about nobody, expected no ':" + parts_.who + "'");
  }

  const std::string& text_;
  Parts parts_;
  const world::Scenario& scenario_;
};

double Reader::seconds(const std::string& text, const char* what) const {
  const std::optional<double> value = io::parse_number(text);
  if (!value || !std::isfinite(*value) || *value < 0.0)
    refuse(std::string("expected ") + what + ", in seconds, zero or more" +
           (text.empty() ? "" : ", not '" + text + "'"));
  return *value;
}

std::size_t Reader::robot() const {
  std::string names;
  for (std::size_t k = 0; k < scenario_.robots.size(); ++k) {
    if (scenario_.robots[k].name == parts_.who) return k;
    names += (k == 0 ? "" : k + 1 == scenario_.robots.size() ? " or " : ", ") + scenario_.robots[k].name;
  }
  refuse("there is no car '" + parts_.who + "', expected " + names);
}

std::size_t Reader::target() const {
  const std::size_t count = scenario_.targets.size();
  if (count == 0) refuse("there is no target in this task");
  const std::optional<long long> number = parts_.who.empty() ? 1 : io::parse_integer(parts_.who);
  if (!number || *number < 1 || static_cast<std::size_t>(*number) > count)
    refuse("there is no target '" + parts_.who + "', expected a number from 1 to " + std::to_string(count));
  return static_cast<std::size_t>(*number) - 1;
}

geom::Vec3 Reader::shift() const {
  std::array<double, 3> values{};
  std::string rest = parts_.shift;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string next = cut(rest, ',');
    const std::optional<double> value = io::parse_number(rest);
    if (!value || !std::isfinite(*value) || (i == 2 && !next.empty()))
      refuse("expected three lengths after =, as in =0.5,-0.2,0");
    values[i] = *value;
    rest = next;
  }
  return {values[0], values[1], values[2]};
}

void Reader::add_to(sim::Faults& faults) const {
  const std::string& kind = parts_.kind;
  if (!parts_.shift.empty() && kind != "target-jump") refuse("only a target-jump has a '='");
  if (kind == "lost-fix") {
    faults.lost_fixes.push_back({robot(), time(), duration(kLostFix)});
  } else if (kind == "failed-mpc") {
    faults.failed_controls.push_back({robot(), time(), duration(sim::kControlPeriod)});
  } else if (kind == "late-replan") {
    expect_nobody();
    faults.late_replans.push_back({time(), duration(kLateReplan)});
  } else if (kind == "target-jump") {
    faults.target_jumps.push_back({target(), time(), duration(kTargetJump), shift()});
  } else if (kind == "breakdown") {
    if (!parts_.duration.empty()) refuse("a breakdown lasts, expected no '+'");
    faults.breakdowns.push_back({robot(), time()});
  } else {
    refuse("there is no fault '" + kind + "'" +
           suggested(kind, {"lost-fix", "failed-mpc", "late-replan", "target-jump", "breakdown"}));
  }
}

}  // namespace

sim::Faults parse_faults(const std::vector<std::string>& texts, const world::Scenario& scenario) {
  sim::Faults faults;
  for (const std::string& text : texts) Reader(text, scenario).add_to(faults);
  return faults;
}

}  // namespace seine::app
