#pragma once

#include <memory>

#include "seine/optim/qp.hpp"

namespace seine::optim {

/// Whether Seine was built with OSQP.
bool osqp_is_there();
/// The OSQP library (its major version 1) behind the same interface. Throws Error without it.
std::unique_ptr<QpSolver> make_osqp(const QpProblem& problem, const QpOptions& options);

}  // namespace seine::optim
