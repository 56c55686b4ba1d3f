#pragma once

#include <cmath>

namespace seine::geom {

/// A point or a vector in the plane, metres unless said otherwise.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  Vec2& operator+=(Vec2 b) {
    x += b.x, y += b.y;
    return *this;
  }
  Vec2& operator-=(Vec2 b) {
    x -= b.x, y -= b.y;
    return *this;
  }
  Vec2& operator*=(double s) {
    x *= s, y *= s;
    return *this;
  }
  friend bool operator==(Vec2, Vec2) = default;
};

inline Vec2 operator+(Vec2 a, Vec2 b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vec2 operator-(Vec2 a, Vec2 b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vec2 operator-(Vec2 a) {
  return {-a.x, -a.y};
}
inline Vec2 operator*(double s, Vec2 a) {
  return {s * a.x, s * a.y};
}
inline Vec2 operator*(Vec2 a, double s) {
  return {s * a.x, s * a.y};
}
inline Vec2 operator/(Vec2 a, double s) {
  return {a.x / s, a.y / s};
}
inline double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// z of the cross product: positive when b is to the left of a.
inline double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
inline double squared_norm(Vec2 a) {
  return dot(a, a);
}
inline double norm(Vec2 a) {
  return std::sqrt(dot(a, a));
}
/// a turned by +90°.
inline Vec2 left_normal(Vec2 a) {
  return {-a.y, a.x};
}
inline Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace seine::geom
