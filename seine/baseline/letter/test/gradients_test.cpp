#include <gtest/gtest.h>

#include "seine/baseline/letter/registry.hpp"

namespace seine::baseline::letter {
namespace {

constexpr std::uint64_t kSeed = 20265;
constexpr int kPoints = 400;

TEST(LetterGradients, OfEveryTermAgreeWithCentralDifferences) {
  for (const math::Formula& entry : registry()) {
    // The nearest edge changes with a kink, and so does the inner side of an edge beyond its ends.
    const auto [kinks, worst] = math::check_gradients(entry, kSeed, kPoints);
    EXPECT_LE(kinks, kPoints / 50) << entry.name << ", seed " << kSeed;
    std::printf("%-24s worst %.1e, near a kink %d of %d\n", entry.name.c_str(), worst, kinks, kPoints);
  }
}

TEST(LetterGradients, TheCheckItselfSeesAPlantedError) {
  for (const math::Formula& entry : registry())
    EXPECT_GT(math::least_planted_error_seen(entry, kSeed), 1e-5) << entry.name;
}

}  // namespace
}  // namespace seine::baseline::letter
