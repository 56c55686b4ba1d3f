#pragma once

#include <array>
#include <span>

#include "seine/geom/pose2.hpp"
#include "seine/vehicle/arc.hpp"

namespace seine::vehicle {

/// What a metre and a gear change cost. The defaults measure plain length.
struct DrivingCosts {
  double reverse = 1.0;      ///< factor on the length driven backwards, > 0; infinite: never backwards
  double gear_change = 0.0;  ///< m, for each change between forwards and backwards
  double forward = 1.0;      ///< factor on the length driven forwards, > 0; infinite: never forwards
};

/// A curve of at most five arcs of curvature 0 or ±1/radius.
struct ReedsSheppPath {
  std::array<Arc, 5> arc{};
  int count = 0;        ///< arcs in use
  double length = 0.0;  ///< m, driven
  double cost = 0.0;    ///< m, by the DrivingCosts asked for

  std::span<const Arc> arcs() const { return {arc.data(), static_cast<std::size_t>(count)}; }
};

/// The cheapest words from one pose to the other for a turning radius (m, > 0), ascending in cost, at most
/// best.size() of them (best.size() ≤ 8); returns how many were written, ≥ 1 when there is room for one. All
/// families of [Reeds90, section 8]: CSC, C|C|C, CC|C, C|CC, CCu|CuC, C|CuCu|C, C|C(π/2)SC, CSC(π/2)|C,
/// C|C(π/2)SC(π/2)|C; and, because penalties can make them win, CSC in one gear with turns of up to 2π and,
/// where one gear costs more than twice the other, CCC in one gear: with an infinite cost of one gear the
/// first is the shortest path in the other [Dubins57]. With default costs the first is the shortest path
/// there is.
int reeds_shepp(const geom::Pose2& from, const geom::Pose2& to, double radius, const DrivingCosts& costs,
                std::span<ReedsSheppPath> best);

/// The cheapest word.
ReedsSheppPath reeds_shepp(const geom::Pose2& from, const geom::Pose2& to, double radius,
                           const DrivingCosts& costs = {});

/// Where a car that started at `from` stands after driving s metres (clamped to the length) of the path.
geom::Pose2 pose_at(const geom::Pose2& from, const ReedsSheppPath& path, double s);

}  // namespace seine::vehicle
