#include "seine/world/everyday.hpp"

#include <gtest/gtest.h>

#include <string>

#include "seine/base/effort.hpp"
#include "seine/vehicle/catalogue.hpp"
#include "seine/world/check.hpp"
#include "seine/world/static_map.hpp"

namespace seine::world {
namespace {

TEST(Everyday, EveryTaskIsAValidQuestion) {
  for (const Everyday kind : all_everyday())
    for (const vehicle::CatalogueEntry& entry : vehicle::catalogue())
      for (std::uint64_t seed = 0; seed < std::uint64_t{effort(24, 3)}; ++seed) {
        const Scenario scenario = everyday(kind, entry.model, seed);
        for (const std::string& complaint : check(scenario, StaticMap(scenario)))
          ADD_FAILURE() << scenario.name << ": " << complaint;
      }
}

TEST(Everyday, TheSeedDecidesEverything) {
  const vehicle::Model& model = vehicle::catalogue().front().model;
  for (const Everyday kind : all_everyday()) {
    int different = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Scenario a = everyday(kind, model, seed), b = everyday(kind, model, seed);
      EXPECT_EQ(a.robots[0].start, b.robots[0].start) << a.name;
      EXPECT_EQ(a.robots[0].goal, b.robots[0].goal) << a.name;
      const Scenario c = everyday(kind, model, seed + 100);
      const bool same = a.robots[0].goal == c.robots[0].goal && a.robots[0].start == c.robots[0].start &&
                        a.robots[0].start_speed == c.robots[0].start_speed &&
                        a.bounds.high == c.bounds.high && a.obstacles.size() == c.obstacles.size();
      different += !same;
    }
    EXPECT_GE(different, 2) << name_of(kind);
  }
}

TEST(Everyday, NamesLeadBack) {
  for (const Everyday kind : all_everyday()) EXPECT_EQ(everyday_named(name_of(kind)), kind);
  EXPECT_FALSE(everyday_named("everything"));
}

}  // namespace
}  // namespace seine::world
