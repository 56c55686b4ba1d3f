// What a careless caller of simulate meets: an exception that says what is wrong, never an abort.
#include <gtest/gtest.h>

#include <limits>

#include "seine/base/error.hpp"
#include "seine/sim/test/drives.hpp"
#include "seine/sim/test/teams.hpp"

namespace seine::sim {
namespace {

std::string complaint(const Drive& drive, const Controller& controller, const SimulationOptions& options) {
  try {
    simulate(drive.scenario, drive.plan, controller, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Preconditions, ArePlainlyRefused) {
  const Drive good = drive_of(3);
  const Controller tracker = plain_tracker(good.scenario);
  const auto refuses = [&](const Drive& drive, const Controller& controller, const SimulationOptions& options,
                           const char* why) {
    EXPECT_NE(complaint(drive, controller, options).find(why), std::string::npos)
        << why << ": " << complaint(drive, controller, options);
  };
  Drive drive = good;
  drive.plan.robots.clear();
  refuses(drive, tracker, {}, "for 0 cars, expected the 3");
  drive = good;
  drive.plan.robots.pop_back();
  refuses(drive, tracker, {}, "for 2 cars");
  drive = good;
  drive.plan.robots[1].segments.clear();
  refuses(drive, tracker, {}, "no way for");
  drive = good;
  drive.plan.robots[1].segments[0].progress.clear();
  refuses(drive, tracker, {}, "no way for");
  drive = good;
  drive.scenario.robots[0].model = 7;
  refuses(drive, tracker, {}, "model number 7");
  drive = good;
  drive.scenario.models[0].wheelbase = 0.0;
  refuses(drive, tracker, {}, "wheelbase");
  refuses(good, nullptr, {}, "no controller");
  SimulationOptions options;
  options.replan_period = std::numeric_limits<double>::quiet_NaN();
  refuses(good, tracker, options, "period");
  options = {};
  options.faults.breakdowns = {{9, 1.0}};
  refuses(good, tracker, options, "breakdown");
  options = {};
  options.faults.target_jumps = {{0, 1.0, 0.1, {}}};
  refuses(good, tracker, options, "jump");
}

}  // namespace
}  // namespace seine::sim
