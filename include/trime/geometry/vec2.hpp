// SPDX-License-Identifier: BSD-3-Clause
// Points and vectors of the plane, the axis-parallel box, and the segment. Also holds the formula by which the whole
// program computes the distance to a segment.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::geometry {

/// A point or vector of the plane.
struct Vec2 {
  double x = 0, y = 0;

  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
};

constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
constexpr double squared_length(Vec2 a) {
  return dot(a, a);
}
inline double length(Vec2 a) {
  return std::sqrt(dot(a, a));
}
/// Returns the vector turned by +90 degrees.
constexpr Vec2 left_normal(Vec2 a) {
  return {-a.y, a.x};
}
/// Compares the coordinates lexicographically, x first. The program breaks all ties by this order.
constexpr bool lexicographically_less(Vec2 a, Vec2 b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// A closed rectangle; empty (min > max) by default.
struct Box {
  Vec2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  double width() const { return max.x - min.x; }
  double height() const { return max.y - min.y; }
  bool contains(Vec2 p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y; }
  void include(Vec2 p) {
    min = {p.x < min.x ? p.x : min.x, p.y < min.y ? p.y : min.y};
    max = {p.x > max.x ? p.x : max.x, p.y > max.y ? p.y : max.y};
  }
  /// Returns the squared distance from p to the box; 0 inside.
  double squared_distance(Vec2 p) const {
    const double dx = std::max(0.0, std::max(min.x - p.x, p.x - max.x));
    const double dy = std::max(0.0, std::max(min.y - p.y, p.y - max.y));
    return dx * dx + dy * dy;
  }
};

/// Return the smallest box around two boxes, and the box that both have in common (empty, with min > max, if there is
/// no common point).
inline Box united(const Box& a, const Box& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}
inline Box intersected(const Box& a, const Box& b) {
  return {{std::max(a.min.x, b.min.x), std::max(a.min.y, b.min.y)},
          {std::min(a.max.x, b.max.x), std::min(a.max.y, b.max.y)}};
}

/// A straight segment from a to b.
struct Segment {
  Vec2 a, b;
};

/// Returns the squared distance from p to the segment; a == b is allowed.
inline double squared_distance(Vec2 p, const Segment& segment) {
  const Vec2 d = segment.b - segment.a, q = p - segment.a;
  const double along = dot(q, d), whole = squared_length(d);
  if (along <= 0)
    return squared_length(q);
  if (along >= whole)
    return squared_length(p - segment.b);
  const double across = cross(d, q);
  return across * across / whole;
}

} // namespace trime::geometry
