#pragma once

#include <optional>
#include <vector>

#include "seine/search/formation_ground.hpp"
#include "seine/search/formation_steps.hpp"
#include "seine/vehicle/arc.hpp"

namespace seine::search {

/// The last part of a formation's way: a few arcs that end exactly where the goal wants it.
struct FormationShot {
  std::vector<vehicle::Arc> arcs;
  double cost = 0.0;  ///< s, in the lattice's prices
};

/// Looks for such ways: the cheapest of the single arcs and Reeds-Shepp words to the goal that is clear.
/// Where the goal leaves the heading free, many are tried; a way ends as soon as it is in the goal's region.
class FormationShots {
 public:
  /// What these point to must outlive this. @param forward, backward gears it may drive in
  FormationShots(const FormationGoal& goal, const TeamLimits& limits, FormationGround& ground, bool forward,
                 bool backward);

  /// From `stand`, reached by `before` (none at the start); nothing where no candidate is clear.
  /// @param least m, of the way
  std::optional<FormationShot> from(const Stand& stand, const Formation& held, const vehicle::Arc* before,
                                    double least = 0.0);

 private:
  void offer(FormationShot shot, const vehicle::Arc* before);
  void offer_single_arcs(const Stand& stand, const Formation& held, const vehicle::Arc* before);
  void offer_words(const Stand& stand, const Formation& held, double heading, const vehicle::Arc* before);
  void offer_detours(const Stand& stand, const Formation& held, double least);
  std::vector<double> headings_from(const Stand& stand, geom::Vec2 middle) const;
  bool may_drive(const FormationShot& shot) const;
  bool inside(const Stand& stand, const Formation& held);
  bool end_early(const Stand& stand, const Formation& held, FormationShot& shot);
  bool clear(const Stand& stand, const Formation& held, const FormationShot& shot);

  const FormationGoal& goal_;
  const TeamLimits& limits_;
  FormationGround& ground_;
  bool forward_, backward_;
  std::vector<FormationShot> shots_;  // candidates
};

}  // namespace seine::search
