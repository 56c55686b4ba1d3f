#pragma once

#include <optional>
#include <string>

#include "seine/planner/formation_fit.hpp"
#include "seine/planner/net_question.hpp"

namespace seine::planner {

/// A guess for the whole team: the translating formation through all rendezvous to the delivery. Attempts
/// differ in what they try: as it stands at the start; going round what is tall; narrower and turned.
/// @param reason why there is none
std::optional<FormationGuess> guess_formation(const world::Scenario& scenario, const world::StaticMap& map,
                                              const NetQuestion& question, int attempt,
                                              const Deadline& deadline, std::string& reason);

}  // namespace seine::planner
