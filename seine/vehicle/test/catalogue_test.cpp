#include "seine/vehicle/catalogue.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace seine::vehicle {
namespace {

TEST(Catalogue, VehiclesAreOnesThatCanBeBuilt) {
  std::set<std::string> names;
  double last = 0.0;
  for (const CatalogueEntry& entry : catalogue()) {
    const Model& model = entry.model;
    SCOPED_TRACE(model.name);
    EXPECT_TRUE(names.insert(model.name).second) << "names are distinct";
    EXPECT_EQ(catalogued(model.name), &model);
    EXPECT_NE(std::string(entry.source), "");
    EXPECT_GE(model.length(), 0.9 * last) << "smallest first";
    last = model.length();
    // Both axles are under the body, and the wheels turn less than a right angle.
    EXPECT_LT(model.wheelbase, model.length());
    EXPECT_LT(model.width(), model.length());
    EXPECT_GT(model.limits.steering, 0.0);
    EXPECT_LT(model.limits.steering, 1.5);
    EXPECT_LE(model.limits.reverse_speed, model.limits.speed);
  }
  EXPECT_GE(catalogue().size(), 10u);
}

TEST(Catalogue, FiguresAreThoseOfTheSources) {
  // Turning radius of the Hunter's manual, and outside dimensions of Autoware's vehicle_info.
  EXPECT_NEAR(1.0 / catalogued("hunter")->max_curvature(), 1.6, 1e-9);
  EXPECT_NEAR(catalogued("autoware")->length(), 2.79 + 1.0 + 1.1, 1e-9);
  EXPECT_NEAR(catalogued("autoware")->width(), 1.64 + 2 * 0.128, 1e-9);
  EXPECT_NEAR(catalogued("csdo")->max_curvature(), 1.0 / 3.0, 1e-9);
  EXPECT_EQ(catalogued("hovercraft"), nullptr);
}

}  // namespace
}  // namespace seine::vehicle
