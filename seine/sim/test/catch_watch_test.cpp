// The verdict on scripted motions: what is said must follow from what was shown.
#include "seine/sim/catch_watch.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "seine/sim/drops.hpp"

namespace seine::sim {
namespace {

using geom::Vec3;

// A net that hangs still in its frame and one object that goes where the script says.
class Scripted final : public NetPhysics {
 public:
  explicit Scripted(const net::Net& net) : mesh_(triangulate(net.rest)) { move({}); }

  void move(Vec3 shift) {
    corners_ = held(world::family_net(4), 0.9);
    for (Vec3& corner : corners_) corner += shift;
    nodes_ = drape(mesh_, corners_, 0.5);
  }
  void place(Vec3 position, Vec3 velocity, bool touching) {
    ball_.position = position;
    ball_.velocity = velocity;
    touching_ = touching;
  }
  const std::vector<Vec3>& corners() const { return corners_; }

  std::size_t add(const Ball&) override { return 0; }
  void advance(std::span<const Vec3>, double) override {}
  std::size_t balls() const override { return 1; }
  const Ball& ball(std::size_t) const override { return ball_; }
  bool touching(std::size_t) const override { return touching_; }
  const NetMesh& mesh() const override { return mesh_; }
  std::span<const Vec3> nodes() const override { return nodes_; }
  std::span<const Vec3> pulls() const override { return {}; }

 private:
  NetMesh mesh_;
  std::vector<Vec3> corners_, nodes_;
  Ball ball_;
  bool touching_ = false;
};

struct Shown {
  Vec3 position;
  bool touching = false;
};

// Plays `place` for `seconds` while the team goes at `drift`; velocities are what the places say.
CatchWatch play(double seconds, Vec3 drift, const std::function<Shown(double)>& place) {
  constexpr double kStep = 1e-3;
  Scripted scene(world::family_net(4));
  CatchWatch watch(0, 1.0);
  for (int i = 0; i <= static_cast<int>(seconds / kStep); ++i) {
    const double t = kStep * i;
    const Shown now = place(t), soon = place(t + 1e-6);
    scene.move(t * drift);
    scene.place(now.position, 1e6 * (soon.position - now.position), now.touching);
    watch.look(t, scene, scene.corners());
  }
  return watch;
}

// Falls from 1.5 m at 5 m/s to `bottom` and stays there.
Shown fall_to(double t, double bottom) {
  const double z = 1.5 - 5.0 * t;
  return {{0.1, 0.1, std::max(z, bottom)}, z <= bottom};
}

TEST(CatchWatch, CaughtAfterAQuarterOfASecondOfRest) {
  const auto script = [](double t) { return fall_to(t, 0.7); };
  EXPECT_EQ(play(0.09, {}, script).fate(), Fate::flying);
  EXPECT_EQ(play(0.16 + 0.23, {}, script).fate(), Fate::inside);
  const CatchWatch watch = play(0.16 + 0.27, {}, script);
  EXPECT_EQ(watch.fate(), Fate::caught);
  EXPECT_TRUE(watch.at_rest());
  EXPECT_NEAR(watch.crossing_time(), 0.1, 2e-3);
  EXPECT_NEAR(watch.catch_time(), 0.16 + 0.25, 3e-3);
  EXPECT_NEAR(watch.lowest(), 0.62, 1e-9);
}

TEST(CatchWatch, RestIsMeasuredAgainstTheTeam) {
  const Vec3 drift{2.0, -1.0, 0.0};
  const auto along = [&](double t) {
    Shown shown = fall_to(t, 0.7);
    shown.position += t * drift;
    return shown;
  };
  EXPECT_EQ(play(0.6, drift, along).fate(), Fate::caught);
  const auto left_behind = [&](double t) { return fall_to(t, 0.7); };
  EXPECT_EQ(play(0.4, drift, left_behind).fate(), Fate::inside);
}

TEST(CatchWatch, NoRestWithoutTouchOrWithTooMuchSpeed) {
  const auto hovering = [](double t) { return Shown{fall_to(t, 0.7).position, false}; };
  EXPECT_EQ(play(2.0, {}, hovering).fate(), Fate::inside);
  EXPECT_EQ(play(2.7, {}, hovering).fate(), Fate::restless);
  const auto rolling = [](double t) {
    Shown shown = fall_to(t, 0.7);
    shown.position.x = 0.2 * std::cos(2.0 * t);  // up to 0.4 m/s, never slow for a quarter of a second
    shown.position.y = 0.2 * std::sin(2.0 * t);
    return shown;
  };
  EXPECT_EQ(play(2.7, {}, rolling).fate(), Fate::restless);
}

TEST(CatchWatch, WhatIsLostAfterwardsIsLost) {
  const auto leaving = [](double t) {
    Shown shown = fall_to(t, 0.7);
    if (t > 1.0) shown.position += (t - 1.0) * Vec3{2.0, 0.0, 2.0};
    return shown;
  };
  EXPECT_EQ(play(0.9, {}, leaving).fate(), Fate::caught);
  EXPECT_EQ(play(2.0, {}, leaving).fate(), Fate::out);
}

TEST(CatchWatch, NamesTheWayOut) {
  const auto beside = [](double t) { return Shown{{2.0, 0.0, 1.5 - 5.0 * t}, false}; };
  EXPECT_EQ(play(0.2, {}, beside).fate(), Fate::miss);
  const auto over = [](double t) {
    Shown shown = fall_to(t, 0.7);
    if (t > 0.2) shown.position += (t - 0.2) * Vec3{4.0, 0.0, 4.0};
    return shown;
  };
  EXPECT_EQ(play(0.8, {}, over).fate(), Fate::out);
  const auto deep = [](double t) {
    Shown shown = fall_to(t, 0.7);
    if (t > 0.2) shown.position.z = std::max(0.08, 0.7 - 3.0 * (t - 0.2));
    return shown;
  };
  EXPECT_EQ(play(0.8, {}, deep).fate(), Fate::leak);  // the net hangs at 0.5 m and does not give way
}

TEST(CatchWatch, TouchingTheGroundInTheNetIsNoCatch) {
  net::Net low = world::family_net(4);
  Scripted scene(low);
  scene.move({0.0, 0.0, -0.48});  // its middle hangs 2 cm above the ground
  CatchWatch watch(0, 0.52);
  for (int i = 0; i <= 200; ++i) {
    const double t = 1e-3 * i;
    scene.place({0.0, 0.0, std::max(0.08, 0.6 - 5.0 * t)}, {}, t > 0.1);
    watch.look(t, scene, scene.corners());
  }
  EXPECT_EQ(watch.fate(), Fate::bottom);
}

}  // namespace
}  // namespace seine::sim
