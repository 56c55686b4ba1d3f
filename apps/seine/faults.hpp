#pragma once

#include <string>
#include <vector>

#include "seine/sim/simulation.hpp"
#include "seine/world/scenario.hpp"

namespace seine::app {

/// Faults as they are written on the command line, KIND[:WHO]@TIME[+DURATION][=DX,DY,DZ]. Throws InputError
/// that names the text and what was expected.
sim::Faults parse_faults(const std::vector<std::string>& texts, const world::Scenario& scenario);

/// What may be written, a line each, for a help text.
extern const char* const kFaultHelp;

}  // namespace seine::app
