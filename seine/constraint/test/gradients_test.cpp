#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "seine/constraint/inter_vehicle.hpp"
#include "seine/constraint/registry.hpp"
#include "seine/geom/convex.hpp"
#include "seine/geom/pose2.hpp"

namespace seine::constraint {
namespace {

constexpr std::uint64_t kSeed = 20261;
constexpr int kPoints = 400;

TEST(Gradients, OfEveryRegisteredConstraintAgreeWithCentralDifferences) {
  for (const math::Formula& entry : registry()) {
    // Distances have kinks where the closest feature changes; they are rare, everything else must agree.
    const auto [kinks, worst] = math::check_gradients(entry, kSeed, kPoints);
    EXPECT_LE(kinks, kPoints / 50) << entry.name << ", seed " << kSeed;
    std::printf("%-24s worst %.1e, near a kink %d of %d\n", entry.name.c_str(), worst, kinks, kPoints);
  }
}

TEST(Gradients, TheCheckItselfSeesAPlantedError) {
  for (const math::Formula& entry : registry())
    EXPECT_GT(math::least_planted_error_seen(entry, kSeed), 1e-5) << entry.name;
}

TEST(InterVehicle, IsTheExactDistanceOfRectangles) {
  Rng rng(kSeed);
  for (int i = 0; i < 5000; ++i) {
    const auto rectangle = [](double rear, double front, double half) {
      return std::vector<geom::Vec2>{{rear, -half}, {front, -half}, {front, half}, {rear, half}};
    };
    const geom::Pose2 a{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5), rng.uniform(-3, 3)};
    const geom::Pose2 b{rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5), rng.uniform(-3, 3)};
    PairGradient unused;
    const double value = inter_vehicle({a.position(), a.direction(), 0.2, 0.5, 0.3},
                                       {b.position(), b.direction(), -0.1, 0.7, 0.2}, unused);
    const geom::Convex shape_a = geom::placed({rectangle(-0.3, 0.7, 0.3), 0.0}, a),
                       shape_b = geom::placed({rectangle(-0.8, 0.6, 0.2), 0.0}, b);
    EXPECT_NEAR(value, geom::separation(shape_a, shape_b).distance, 1e-9)
        << "seed " << kSeed << ", case " << i;
  }
}

TEST(Gradients, NoConstraintIsForgotten) {
  std::set<std::string> registered;
  for (const math::Formula& entry : registry()) registered.insert(entry.name);
  const auto room = std::filesystem::path(__FILE__).parent_path().parent_path();
  for (const auto& file : std::filesystem::directory_iterator(room)) {
    const std::string name = file.path().stem().string();
    if (file.path().extension() == ".hpp" && !name.ends_with("registry")) {
      EXPECT_TRUE(registered.contains(name)) << name;
    }
  }
}

}  // namespace
}  // namespace seine::constraint
