#include <gtest/gtest.h>

#include "seine/baseline/letter/registry.hpp"
#include "seine/math/finite_difference.hpp"

namespace seine::baseline::letter {
namespace {

constexpr std::uint64_t kSeed = 20265;
constexpr int kPoints = 400;

TEST(LetterGradients, OfEveryTermAgreeWithCentralDifferences) {
  for (const Entry& entry : registry()) {
    Rng rng(kSeed);
    int kinks = 0;
    double worst = 0.0;
    for (int i = 0; i < kPoints; ++i) {
      std::vector<double> x(static_cast<std::size_t>(entry.inputs)), g(x.size()), unused(x.size());
      entry.draw(rng, x);
      entry.value(x, g);
      const auto check =
          math::check_gradient([&](std::span<const double> y) { return entry.value(y, unused); }, x, g);
      // The nearest edge changes with a kink, and so does the inner side of an edge beyond its ends.
      if (check.worst > 1e-6)
        ++kinks;
      else
        worst = std::max(worst, check.worst);
    }
    EXPECT_LE(kinks, kPoints / 50) << entry.name << ", seed " << kSeed;
    std::printf("%-24s worst %.1e, near a kink %d of %d\n", entry.name.c_str(), worst, kinks, kPoints);
  }
}

TEST(LetterGradients, TheCheckItselfSeesAPlantedError) {
  for (const Entry& entry : registry())
    for (std::size_t wrong = 0; wrong < static_cast<std::size_t>(entry.inputs); ++wrong) {
      Rng rng(kSeed);
      std::vector<double> x(static_cast<std::size_t>(entry.inputs)), g(x.size()), unused(x.size());
      entry.draw(rng, x);
      entry.value(x, g);
      g[wrong] += 1e-3 * (1.0 + std::abs(g[wrong]));
      const auto f = [&](std::span<const double> y) { return entry.value(y, unused); };
      EXPECT_GT(math::check_gradient(f, x, g).worst, 1e-5) << entry.name;
    }
}

}  // namespace
}  // namespace seine::baseline::letter
