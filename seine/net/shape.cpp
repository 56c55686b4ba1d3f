#include "seine/net/shape.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "seine/geom/polygon.hpp"

namespace seine::net {

using geom::Vec2;

double rest_distance(const Net& net, std::size_t i, std::size_t j) {
  return geom::norm(net.rest[i] - net.rest[j]);
}

double opening(const Net& net, std::span<const Vec2> attachments) {
  assert(attachments.size() == net.size());
  const double area = geom::signed_area(attachments);
  return area > 0.0 ? std::sqrt(area / geom::signed_area(net.rest)) : 0.0;
}

double sag(double distance, double rest) {
  return distance < rest ? std::sqrt(0.375 * distance * (rest - distance)) : 0.0;
}

double empty_depth(const Net& net, std::span<const Vec2> attachments) {
  assert(attachments.size() == net.size());
  double deepest = 0.0;
  for (std::size_t i = 0; i < net.size(); ++i) {
    for (std::size_t j = i + 1; j < net.size(); ++j) {
      const double apart = geom::norm(attachments[i] - attachments[j]);
      deepest = std::max(deepest, sag(apart, rest_distance(net, i, j)));
    }
  }
  return deepest;
}

double margin_inside(std::span<const Vec2> polygon, Vec2 p) {
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 tail = polygon[i];
    const Vec2 edge = polygon[i + 1 == polygon.size() ? 0 : i + 1] - tail;
    const Vec2 to = p - tail;
    inside = inside && geom::cross(edge, to) >= 0.0;
    const double length = geom::squared_norm(edge);
    const double along = length > 0.0 ? std::clamp(geom::dot(to, edge) / length, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, geom::norm(to - along * edge));
  }
  return inside ? nearest : -nearest;
}

}  // namespace seine::net
