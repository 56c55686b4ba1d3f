#include "seine/baseline/letter/smooth_distance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "seine/geom/convex.hpp"

namespace seine::baseline::letter {
namespace {

using geom::Vec2;

constexpr std::size_t kMostCorners = 64;

Vec2 turned(Vec2 direction, Vec2 body) {
  return {direction.x * body.x - direction.y * body.y, direction.y * body.x + direction.x * body.y};
}

Vec2 to_body(Vec2 direction, Vec2 world) {
  return {geom::dot(direction, world), geom::cross(direction, world)};
}

// ∂/∂d of n·(R(d) c).
Vec2 turning(Vec2 n, Vec2 c) {
  return {geom::dot(c, n), geom::cross(c, n)};
}

/// One face against the other polygon.
struct Face {
  double gap;   ///< smoothed
  Vec2 normal;  ///< world
  Vec2 corner;  ///< of the other polygon, body frame: the mean by weight
};

// −log Σ exp(−α x) / α over the other polygon's corners.
Face smooth_gap(const Shape& own, const Stand& at, const Shape& other, const Stand& there, std::size_t index,
                double alpha) {
  const Vec2 normal = turned(at.direction, own.normals[index]);
  // In the other's body frame a corner costs two products.
  const Vec2 along = to_body(there.direction, normal);
  const double base = geom::dot(normal, there.position - at.position) - own.offsets[index];
  double gaps[kMostCorners];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t o = 0; o < other.corners.size(); ++o) {
    gaps[o] = base + geom::dot(along, other.corners[o]);
    least = std::min(least, gaps[o]);
  }
  double sum = 0.0;
  Vec2 corner;
  for (std::size_t o = 0; o < other.corners.size(); ++o) {
    const double share = std::exp(alpha * (least - gaps[o]));
    sum += share;
    corner += share * other.corners[o];
  }
  return {least - std::log(sum) / alpha, normal, corner / sum};
}

double hard_gap(const Shape& own, const Stand& at, const Shape& other, const Stand& there,
                std::size_t index) {
  const Vec2 normal = turned(at.direction, own.normals[index]);
  const Vec2 along = to_body(there.direction, normal);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 corner : other.corners) least = std::min(least, geom::dot(along, corner));
  return geom::dot(normal, there.position - at.position) - own.offsets[index] + least;
}

/// ∂/∂ of one footprint.
struct OneGradient {
  Vec2 position, direction;
};

// gap = n·(p' + R' c − p) − offset with n = R n̂: the offset does not turn.
void add_gradient(const Face& face, double share, Vec2 own_normal, const Stand& at, const Stand& there,
                  OneGradient& own, OneGradient& other) {
  const Vec2 n = share * face.normal;
  const Vec2 arm = there.position + turned(there.direction, face.corner) - at.position;
  own.position -= n;
  own.direction += turning(share * arm, own_normal);
  other.position += n;
  other.direction += turning(n, face.corner);
}

}  // namespace

Shape::Shape(std::span<const Vec2> footprint) : corners(footprint.begin(), footprint.end()) {
  assert(corners.size() >= 3 && corners.size() <= kMostCorners);
  const geom::Box box = geom::bounding_box(corners);
  middle = 0.5 * (box.low + box.high);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 edge = corners[(i + 1) % corners.size()] - corners[i];
    normals.push_back(-geom::left_normal(edge) / geom::norm(edge));
    offsets.push_back(geom::dot(normals.back(), corners[i]));
    radius = std::max(radius, geom::norm(corners[i] - middle));
  }
  double widest = 0.0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec2 next = normals[(i + 1) % normals.size()];
    widest =
        std::max(widest, std::abs(std::atan2(geom::cross(normals[i], next), geom::dot(normals[i], next))));
  }
  facing = std::cos(0.5 * widest);
}

double smooth_distance(const Shape& shape_a, const Stand& a, const Shape& shape_b, const Stand& b,
                       double alpha, StandGradient& gradient) {
  const std::size_t of_a = shape_a.normals.size(), count = of_a + shape_b.normals.size();
  const auto face_of = [&](std::size_t i) {
    return i < of_a ? smooth_gap(shape_a, a, shape_b, b, i, alpha)
                    : smooth_gap(shape_b, b, shape_a, a, i - of_a, alpha);
  };
  double gaps[2 * kMostCorners];
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    gaps[i] = face_of(i).gap;
    largest = std::max(largest, gaps[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += std::exp(alpha * (gaps[i] - largest));
  OneGradient g_a, g_b;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = std::exp(alpha * (gaps[i] - largest)) / sum;
    if (share < 1e-12) continue;  // changes nothing, and costs as much as a face that matters
    if (i < of_a)
      add_gradient(face_of(i), share, shape_a.normals[i], a, b, g_a, g_b);
    else
      add_gradient(face_of(i), share, shape_b.normals[i - of_a], b, a, g_b, g_a);
  }
  gradient = {g_a.position, g_a.direction, g_b.position, g_b.direction};
  return largest + std::log(sum) / alpha;
}

double smoothing_error(const Shape& a, const Shape& b, double alpha) {
  return std::log(static_cast<double>(a.normals.size() + b.normals.size())) / alpha;
}

bool may_be_near(const Shape& shape_a, const Stand& a, const Shape& shape_b, const Stand& b, double wanted) {
  const Vec2 apart =
      b.position + turned(b.direction, shape_b.middle) - a.position - turned(a.direction, shape_a.middle);
  const double facing = std::max(shape_a.facing, shape_b.facing);
  const double near = shape_a.radius + shape_b.radius + wanted;
  return geom::squared_norm(apart) * facing * facing < near * near;
}

double hard_distance(const Shape& shape_a, const Stand& a, const Shape& shape_b, const Stand& b) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shape_a.normals.size(); ++i)
    largest = std::max(largest, hard_gap(shape_a, a, shape_b, b, i));
  for (std::size_t i = 0; i < shape_b.normals.size(); ++i)
    largest = std::max(largest, hard_gap(shape_b, b, shape_a, a, i));
  return largest;
}

}  // namespace seine::baseline::letter
