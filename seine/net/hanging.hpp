#pragma once

#include <span>
#include <vector>

#include "seine/geom/vec2.hpp"
#include "seine/geom/vec3.hpp"
#include "seine/net/net.hpp"

namespace seine::net {

/// Where a point load comes to rest in a net that does not stretch and weighs nothing: at cloth point v and
/// place (p, z), held by the straight pieces of cloth to the corners, |(p, z) − (a_k, h)| ≤ |v − r_k| for all
/// k, and no lower place is near.
struct Hanging {
  geom::Vec3 position;    ///< (p, z), z counted from the ground
  geom::Vec2 contact;     ///< v, in the frame of the net at rest
  std::vector<int> taut;  ///< the corners whose cloth is tight, ascending
  bool at_edge = false;   ///< v lies on an edge of the net: only the rim of the cloth holds it, it rolls out
};

/// All stable equilibria, that is all local minima of z over (p, v) with v inside the net at rest, lowest
/// first. Empty when the cloth cannot reach from corner to corner anywhere. Deterministic.
/// @param rest, attachments convex, counter-clockwise, three corners or more each, in metres (or any one
/// unit)
/// @param height of the rim plane
std::vector<Hanging> equilibria(std::span<const geom::Vec2> rest, std::span<const geom::Vec2> attachments,
                                double height);

/// How far below the rim a load can hang at most, m: the depth of the lowest equilibrium, to within rounding
/// (1e-9 of the net's size squared in D²). Does not allocate where the net hangs deepest inside, as all nets
/// near a regular shape do; some microseconds up to eight corners.
double loaded_depth(const Net& net, std::span<const geom::Vec2> attachments);

/// How well the net keeps what lies in it away from its edges, m². The least of G_ik + G_jk − G_ij over all
/// ring edges (i, j) and other corners k, with G_ij = |r_i − r_j|² − |a_i − a_j|²: an edge that has more
/// slack than its ends have to the rest of the net lets the load roll out over it. Below 0 there is an
/// equilibrium at an edge; at 0 and above there is none. Piecewise quadratic in the attachments.
double holding_reserve(const Net& net, std::span<const geom::Vec2> attachments);

/// How far from the net's edges, along the cloth (m), its load comes to rest: the least over all equilibria,
/// 0 when one is at an edge or there is none.
double holding_margin(const Net& net, std::span<const geom::Vec2> attachments);

}  // namespace seine::net
