#include "seine/certify/slice_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "seine/geom/polygon.hpp"

namespace seine::certify {
namespace {

using geom::Vec2;

/// The vector from attachment i to j on a slice.
struct Vector {
  Vec2 from, to;   // its chord
  double loss;     // m, by how much it can leave its chord
  double longest;  // m, of the chord

  Vector(const Slice& slice, std::size_t i, std::size_t j)
      : from(slice.from[j] - slice.from[i]),
        to(slice.to[j] - slice.to[i]),
        loss(slice.loss(i, j)),
        longest(std::sqrt(std::max(geom::squared_norm(from), geom::squared_norm(to)))) {}
};

/// By how much a product of e and w can be off that of their chords.
double product_loss(const Vector& e, const Vector& w) {
  return e.loss * w.longest + w.loss * e.longest + e.loss * w.loss;
}

/// By how much e × w can fall below its chord: the product of two chords does by at most a quarter of that of
/// their changes.
double cross_loss(const Vector& e, const Vector& w) {
  return 0.25 * std::max(0.0, geom::cross(e.to - e.from, w.to - w.from)) + product_loss(e, w);
}

}  // namespace

double furthest_apart(const Slice& slice, std::size_t i, std::size_t j) {
  const Vector apart(slice, i, j);
  return apart.longest + apart.loss;
}

double least_square_apart(const Slice& slice, std::size_t i, std::size_t j) {
  // The square of the chord's length falls below its own chord by at most a quarter of the change squared.
  const Vector apart(slice, i, j);
  const double at_ends = std::min(geom::squared_norm(apart.from), geom::squared_norm(apart.to));
  const double of_chord = std::max(0.0, at_ends - 0.25 * geom::squared_norm(apart.to - apart.from));
  const double least = std::max(0.0, std::sqrt(of_chord) - apart.loss);
  return least * least;
}

bool stays_inside(const Slice& slice, std::size_t i, std::size_t j, std::size_t other, double by) {
  // (e × w) − by |e| ≥ 0. The length of e is below the chord of its lengths at the ends, plus its loss …
  const Vector e(slice, i, j), w(slice, i, other);
  const double at_from = geom::norm(e.from), at_to = geom::norm(e.to);
  const double cross_from = geom::cross(e.from, w.from), cross_to = geom::cross(e.to, w.to);
  const double loss = cross_loss(e, w);
  if (by >= 0.0)
    return std::min(cross_from - by * at_from, cross_to - by * at_to) - loss - by * e.loss >= 0.0;
  // … and above the smaller one by no less than half of its change.
  const double least = std::min(at_from, at_to) - 0.5 * geom::norm(e.to - e.from) - e.loss;
  return std::min(cross_from, cross_to) - loss - by * std::max(least, 0.0) >= 0.0;
}

double largest_dot(const Slice& slice, std::size_t i, std::size_t j, std::size_t k) {
  const Vector e(slice, k, i), w(slice, k, j);
  const double of_chords = 0.25 * std::max(0.0, -geom::dot(e.to - e.from, w.to - w.from));
  return std::max(geom::dot(e.from, w.from), geom::dot(e.to, w.to)) + of_chords + product_loss(e, w);
}

double least_area(const Slice& slice) {
  // As the sum of triangles from attachment 0.
  double loss = 0.0;
  for (std::size_t i = 1; i + 1 < slice.from.size(); ++i) {
    loss += cross_loss(Vector(slice, 0, i), Vector(slice, 0, i + 1));
  }
  return std::min(geom::signed_area(slice.from), geom::signed_area(slice.to)) - 0.5 * loss;
}

}  // namespace seine::certify
