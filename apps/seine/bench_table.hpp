#pragma once

#include <string>
#include <vector>

#include "apps/seine/bench_rows.hpp"

namespace seine::app {

/// The rows, group by group, as a table for people: how many are certified, what they took, what they cost.
/// Only certified plans count in the numbers, and instances that were refused as wrong in themselves are
/// counted apart. A group with a row in `reference` of the same name shows it on the next line.
std::string table(const std::vector<Row>& rows, const std::vector<Row>& reference);

}  // namespace seine::app
