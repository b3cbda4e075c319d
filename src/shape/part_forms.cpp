// SPDX-License-Identifier: BSD-3-Clause
#include "trime/shape/part_forms.hpp"

#include "core/angle.hpp"

namespace trime::shape {
using geometry::cross;
using geometry::dot;
using geometry::Piece;
using geometry::Vec2;

std::array<Vec2, 4> quadrant_vertices(const Circle& circle) {
  const Vec2 c = circle.center;
  const double r = circle.radius;
  return {{{c.x + r, c.y}, {c.x, c.y + r}, {c.x - r, c.y}, {c.x, c.y - r}}};
}

Piece make_arc(const Circle& circle, Vec2 a, Vec2 b) {
  const Vec2 from = a - circle.center, to = b - circle.center;
  Piece piece;
  piece.start = a;
  piece.end = b;
  piece.circular = true;
  piece.center = circle.center;
  piece.radius = circle.radius;
  piece.start_angle = angle_of(from.y, from.x);
  piece.sweep = angle_of(cross(from, to), dot(from, to));
  if (piece.sweep <= 0)
    piece.sweep += 2 * pi;
  return piece;
}

} // namespace trime::shape
