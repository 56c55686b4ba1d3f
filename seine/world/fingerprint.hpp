#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "seine/world/scenario.hpp"

namespace seine::world {

/// What a scenario asks, in six numbers: scenarios of the same numbers in the same order have the same,
/// however their files are written, and two that do not differ in at least one (to within 1 in 2⁶⁴). Names of
/// scenario, models and obstacles are not part of it. The same on every machine.
struct Fingerprint {
  std::uint64_t robots = 0;   ///< names, starts, start speeds, goals
  std::uint64_t models = 0;   ///< of each robot: footprint, wheelbase, limits
  std::uint64_t world = 0;    ///< bounds and obstacles
  std::uint64_t map = 0;      ///< cells, their size and place, what lies outside
  std::uint64_t margins = 0;  ///< all three
  std::uint64_t net = 0;      ///< the net, targets, payload, delivery
  friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
};

Fingerprint fingerprint(const Scenario& scenario);

/// One part of it by its name.
struct FingerprintPart {
  const char* name;
  std::uint64_t Fingerprint::*value;
};
inline constexpr FingerprintPart kFingerprintParts[] = {
    {"robots", &Fingerprint::robots}, {"models", &Fingerprint::models},   {"world", &Fingerprint::world},
    {"map", &Fingerprint::map},       {"margins", &Fingerprint::margins}, {"net", &Fingerprint::net}};

/// The names of the parts in which two differ.
std::vector<std::string> differences(const Fingerprint& a, const Fingerprint& b);

}  // namespace seine::world
