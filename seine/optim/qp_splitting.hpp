#pragma once

#include <memory>

#include "seine/optim/qp.hpp"

namespace seine::optim {

/// Operator splitting (the alternating direction method of multipliers) after [Stellato20]: one linear
/// system, factorised once for a penalty ρ, solved in every iteration; see docs/qp.md for what differs.
std::unique_ptr<QpSolver> make_splitting(const QpProblem& problem, const QpOptions& options);

}  // namespace seine::optim
