#include "seine/world/fingerprint.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "seine/world/net_families.hpp"

namespace seine::world {
namespace {

Scenario with_everything() {
  Scenario s = throw_scene(4, 3);
  s.map = geom::OccupancyGrid{10, 7, 0.1, {1.0, 2.0, 0.3}, std::vector<std::uint8_t>(70, 0)};
  s.obstacles.push_back({"ball", Circle{{}, 0.3}, 1.0, {{1.0, {2.0, 3.0, 0.1}}}});
  s.payload = net::Payload{};
  for (Robot& robot : s.robots) robot.goal = robot.start;
  return s;
}

TEST(Fingerprint, ChangesWithWhateverBindsAndOnlyThere) {
  const Scenario base = with_everything();
  const Fingerprint made = fingerprint(base);
  struct Change {
    const char* part;
    std::function<void(Scenario&)> make;
  };
  const Change changes[] = {
      {"robots", [](Scenario& s) { s.robots[1].start.x += 1e-12; }},
      {"robots", [](Scenario& s) { s.robots[1].start_speed = 0.1; }},
      {"robots", [](Scenario& s) { s.robots[2].goal->heading += 0.1; }},
      {"robots", [](Scenario& s) { s.robots[2].goal.reset(); }},
      {"robots", [](Scenario& s) { s.robots[0].name += "x"; }},
      {"models", [](Scenario& s) { s.models[0].wheelbase *= 1.01; }},
      {"models", [](Scenario& s) { s.models[0].footprint[0].x -= 0.01; }},
      {"models", [](Scenario& s) { s.models[0].limits.steering_rate = 1.0; }},
      {"world", [](Scenario& s) { s.bounds.high.x += 1.0; }},
      {"world", [](Scenario& s) { s.obstacles.pop_back(); }},
      {"world", [](Scenario& s) { s.obstacles.back().height = 2.0; }},
      {"world", [](Scenario& s) { s.obstacles.back().motion[0].t = 2.0; }},
      {"world", [](Scenario& s) { std::get<Circle>(s.obstacles.back().shape).radius = 0.31; }},
      {"map", [](Scenario& s) { s.map->occupied[69] = 1; }},
      {"map", [](Scenario& s) { s.map->occupied[3] = 1; }},
      {"map", [](Scenario& s) { s.map->resolution = 0.2; }},
      {"map", [](Scenario& s) { std::swap(s.map->width, s.map->height); }},
      {"map", [](Scenario& s) { s.outside_free = true; }},
      {"map", [](Scenario& s) { s.map.reset(); }},
      {"margins", [](Scenario& s) { s.margins.robot = 0.06; }},
      {"margins", [](Scenario& s) { s.margins.leaving = 0.0; }},
      {"net", [](Scenario& s) { s.net->clearance = 0.06; }},
      {"net", [](Scenario& s) { s.net->attachments[3].at.x += 0.01; }},
      {"net", [](Scenario& s) { s.targets[0].velocity.z += 0.01; }},
      {"net", [](Scenario& s) { s.targets[0].covariance[3][4] = 1e-9; }},
      {"net", [](Scenario& s) { s.payload->mass = 0.3; }},
      {"net", [](Scenario& s) { s.delivery->radius = 0.4; }},
  };
  std::set<std::uint64_t> seen;
  for (const Change& change : changes) {
    Scenario other = base;
    change.make(other);
    const Fingerprint its = fingerprint(other);
    EXPECT_EQ(differences(made, its), std::vector<std::string>{change.part});
    std::uint64_t all = 0;
    for (const FingerprintPart& part : kFingerprintParts) all ^= its.*part.value;
    EXPECT_TRUE(seen.insert(all).second) << change.part << ": like another change";
  }
}

TEST(Fingerprint, NamesAndSpellingsDoNotCount) {
  const Scenario base = with_everything();
  Scenario other = base;
  other.name = "other";
  other.models[0].name = "lorry";
  other.models.insert(other.models.begin(), other.models[0]);
  other.models[0].wheelbase = 3.0;  // of no robot
  for (Robot& robot : other.robots) robot.model = 1;
  other.obstacles.back().name = "sphere";
  other.robots[0].start.y = base.robots[0].start.y == 0.0 ? -0.0 : base.robots[0].start.y;
  EXPECT_EQ(fingerprint(other), fingerprint(base));
}

}  // namespace
}  // namespace seine::world
