#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "seine/base/rng.hpp"
#include "seine/net/net.hpp"

namespace seine::net {

inline std::vector<geom::Vec2> regular_polygon(std::size_t corners, double radius, double turn = 0.0) {
  std::vector<geom::Vec2> polygon;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle =
        turn + 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(corners);
    polygon.push_back(radius * geom::unit(angle));
  }
  return polygon;
}

/// Convex and counter-clockwise: points of an ellipse at irregular angles.
inline std::vector<geom::Vec2> random_convex(Rng& rng, std::size_t corners) {
  const double flat = rng.uniform(0.6, 1.0);
  std::vector<geom::Vec2> polygon;
  for (std::size_t k = 0; k < corners; ++k) {
    const double place = static_cast<double>(k) + rng.uniform(0.0, 0.7);
    const double angle = 2.0 * std::numbers::pi * place / static_cast<double>(corners);
    polygon.push_back({std::cos(angle), flat * std::sin(angle)});
  }
  return polygon;
}

inline Net net_of(std::vector<geom::Vec2> rest, double rim = 1.0) {
  Net net;
  net.attachments.assign(rest.size(), {{0.2, 0.0}, rim});
  net.rest = std::move(rest);
  return net;
}

/// `rest` squeezed by two factors along a random direction, turned, moved and jittered: attachments that no
/// pair of corners is stretched by.
inline std::vector<geom::Vec2> random_hold(Rng& rng, const std::vector<geom::Vec2>& rest) {
  for (;;) {
    const geom::Vec2 axis = geom::unit(rng.uniform(0.0, std::numbers::pi));
    const geom::Vec2 turn = geom::unit(rng.uniform(-std::numbers::pi, std::numbers::pi));
    const double along = rng.uniform(0.5, 0.97);
    const double across = rng.uniform(0.5, 0.97);
    const geom::Vec2 shift{rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)};
    std::vector<geom::Vec2> hold;
    for (const geom::Vec2 r : rest) {
      const double u = along * geom::dot(r, axis) + rng.uniform(-0.05, 0.05);
      const double w = across * geom::cross(axis, r) + rng.uniform(-0.05, 0.05);
      const geom::Vec2 p = u * axis + w * geom::left_normal(axis);
      hold.push_back(shift + geom::Vec2{turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y});
    }
    bool stretched = false;
    for (std::size_t i = 0; i < rest.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        stretched = stretched || geom::norm(hold[i] - hold[j]) > 0.99 * geom::norm(rest[i] - rest[j]);
    if (!stretched) return hold;
  }
}

}  // namespace seine::net
