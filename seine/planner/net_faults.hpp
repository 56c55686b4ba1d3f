#pragma once

#include "seine/certify/certificate.hpp"

namespace seine::planner {

/// How far a net's plan is from one that holds, by its worst violation: 1 is what repairs hardly ever mend
/// (10 cm of clearance, half of a limit).
double severity(const certify::Certificate& certificate);

}  // namespace seine::planner
