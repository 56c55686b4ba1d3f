#pragma once

#include <span>

#include "seine/geom/vec2.hpp"

namespace seine::baseline::letter {

/// x clamped to [0, 1] by cubics on the first and last ε, once continuously differentiable [Pei24, Eq. 18].
double clamped(double x, double epsilon, double& slope);

/// Distance of `p` to the edge from a to b, whose parameter is clamped; signed: negative on the inner (left)
/// side of its line [Pei24, Eq. 17]. Gradients of the two ends are added.
struct EdgeDistance {
  double value = 0.0;
  geom::Vec2 g_a, g_b;
};
EdgeDistance edge_distance(geom::Vec2 a, geom::Vec2 b, geom::Vec2 p, double epsilon);

/// What a target costs whose ground point has the signed distance D to the net: w_ce·D well inside
/// (centring), w_ca·D well outside (catching), between −e and e a polynomial that joins them [Pei24, Eq. 19].
struct CatchWeights {
  double centring, catching, blend;  ///< w_ce, w_ca, 1/m; e, m
};
double catch_cost(double distance, const CatchWeights& weights, double& slope);

/// D of a ring (counter-clockwise): of the nearest edge in absolute value, its sign by whether p is inside.
/// @param g_ring receives ∂D/∂ of every corner
double net_distance(std::span<const geom::Vec2> ring, geom::Vec2 p, double epsilon,
                    std::span<geom::Vec2> g_ring);

}  // namespace seine::baseline::letter
