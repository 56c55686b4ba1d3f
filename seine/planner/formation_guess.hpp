#pragma once

#include <array>
#include <optional>
#include <string>

#include "seine/planner/formation_fit.hpp"
#include "seine/planner/net_question.hpp"

namespace seine::planner {

/// Guesses for the whole team: the translating formation through all rendezvous to the delivery. Attempts
/// differ in what they try, and share what they learn of the ground.
class FormationGuesser {
 public:
  static constexpr int kStraight = 3;  // attempts straight to the cars' goals
  static constexpr int kAttempts = kStraight + 5;

  FormationGuesser(const world::Scenario& scenario, const world::StaticMap& map, const NetQuestion& question,
                   const Deadline& deadline);

  /// The first attempt holds the cars as they stand at the start; later ones go round what is tall, narrower
  /// and turned where they must.
  std::optional<FormationGuess> guess(int attempt);

 private:
  std::optional<FormationGuess> straight_to_goals(int attempt);
  std::optional<search::FormationSettings> settings_for(int attempt) const;
  void offer_narrow_shapes();
  FormationGuess assemble(search::FormationPath way) const;

  const world::Scenario& scenario_;
  const NetQuestion& question_;
  std::optional<search::Formation> last_;  // in which the team ends where every robot has a goal
  search::FormationSearch search_;
  bool narrow_ = false;
  std::array<bool, kAttempts> found_{};  // whether an attempt found a way
};

}  // namespace seine::planner
