#pragma once

#include <string>
#include <vector>

#include "apps/seine/bench_rows.hpp"

namespace seine::app {

/// The everyday tasks as two tables for people, by kind and by vehicle: how many are certified or proved
/// impossible, what planning took, how long the plans are against the shortest known, their gear changes.
/// Then every task without an answer, with its reason.
std::string everyday_table(const std::vector<Row>& rows);

}  // namespace seine::app
