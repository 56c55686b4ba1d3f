#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "seine/base/error.hpp"
#include "seine/world/scenario.hpp"
#include "seine/world/static_map.hpp"

namespace seine::world {

/// One thing that makes a scenario unanswerable.
struct Complaint {
  std::string text;         ///< one sentence with names and numbers
  int robot = -1;           ///< whose place it is about, where it is about one
  bool goal = false;        ///< its goal, or its start
  bool impossible = false;  ///< nothing is wrong in itself, but the task has no answer
  bool judged = false;      ///< no plan can be asked for with such a limit, but one can be judged by it

  Complaint(std::string sentence) : text(std::move(sentence)) {}  // NOLINT: a sentence is a complaint
  Complaint(const char* sentence) : text(sentence) {}             // NOLINT
};
using Complaints = std::vector<Complaint>;

/// Thrown for a scenario that is wrong in itself.
class Unsound : public InputError {
 public:
  /// "<name>: <first complaint> (and 2 more)".
  Unsound(const std::string& scenario, Complaints complaints);
  const Complaints& complaints() const { return *complaints_; }

 private:
  std::shared_ptr<const Complaints> complaints_;  // an exception is copied without throwing
};

/// Everything that makes a scenario unanswerable before any planning, one sentence each with names and
/// numbers; empty when nothing does. Limits, margins and footprints that make no sense; starts and goals
/// nearer than the margin to an obstacle, the bounds or each other (to within 1 µm: without a margin,
/// touching is allowed); moving obstacles over a start at t = 0 or at rest over a goal; and what check_net
/// finds. Poses of a car are not judged when its own numbers are already wrong.
Complaints examine(const Scenario& scenario, const StaticMap& map);
/// The sentences of examine alone.
std::vector<std::string> check(const Scenario& scenario, const StaticMap& map);

/// Throws Unsound when examine has any complaint but those that only say that there is no answer. Returns the
/// first of these, empty where there is none.
std::string expect_sound(const Scenario& scenario, const StaticMap& map);

/// The part of examine that looks at numbers alone, not at places: models, margins, motions, net, targets.
/// Quick; what a caller may do wrong who builds a scenario in code.
Complaints check_numbers(const Scenario& scenario);
/// Throws Unsound when check_numbers has any complaint.
void expect_numbers(const Scenario& scenario);
/// The same, but for limits by which a plan can still be judged (`Complaint::judged`): finite margins,
/// clearances, speed and stretch limits beyond what makes sense ask for nothing or for too much, and that is
/// an answer.
void expect_judgeable(const Scenario& scenario);

}  // namespace seine::world
