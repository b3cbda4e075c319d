// SPDX-License-Identifier: BSD-3-Clause
#include "trime/geometry/boundary.hpp"

#include "core/angle.hpp"
#include "trime/geometry/segment.hpp"

#include <algorithm>
#include <cmath>

namespace trime::geometry {

namespace {

/// Does the ray from the centre of an arc through p meet the arc?
bool faces_arc(const Piece& arc, Vec2 p) {
  if (arc.start == arc.end)
    return true;
  const bool ccw = arc.sweep > 0;
  const Vec2 from = (ccw ? arc.start : arc.end) - arc.center, to = (ccw ? arc.end : arc.start) - arc.center;
  const Vec2 q = p - arc.center;
  if (std::fabs(arc.sweep) <= pi)
    return cross(from, q) >= 0 && cross(q, to) >= 0;
  return !(cross(to, q) > 0 && cross(q, from) > 0);
}

void include_arc(Box& box, const Piece& arc) {
  const Vec2 extremes[] = {{arc.radius, 0}, {0, arc.radius}, {-arc.radius, 0}, {0, -arc.radius}};
  for (const Vec2 extreme : extremes)
    if (faces_arc(arc, arc.center + extreme))
      box.include(arc.center + extreme);
}

} // namespace

double Piece::length() const {
  return circular ? radius * std::fabs(sweep) : geometry::length(end - start);
}

Vec2 Piece::point(double s) const {
  const double whole = length();
  if (s <= 0)
    return start;
  if (s >= whole)
    return end;
  const double t = s / whole;
  if (!circular)
    return start + t * (end - start);
  const SinCos direction = sin_cos(start_angle + t * sweep);
  return center + radius * Vec2{direction.cos, direction.sin};
}

Vec2 Piece::tangent(double s) const {
  if (!circular)
    return (1.0 / geometry::length(end - start)) * (end - start);
  const double t = std::clamp(s / length(), 0.0, 1.0);
  const SinCos direction = sin_cos(start_angle + t * sweep);
  const double sign = sweep > 0 ? 1 : -1;
  return {-sign * direction.sin, sign * direction.cos};
}

double Piece::distance(Vec2 p) const {
  if (!circular)
    return std::sqrt(squared_distance(p, {start, end}));
  if (faces_arc(*this, p))
    return std::fabs(geometry::length(p - center) - radius);
  return std::sqrt(std::fmin(squared_length(p - start), squared_length(p - end)));
}

Box Piece::covering_box() const {
  Box box;
  box.include(start);
  box.include(end);
  if (circular) {
    const double margin = 0.5 * length(); // no point of an arc is farther from an end than half its length
    box.min = box.min - Vec2{margin, margin};
    box.max = box.max + Vec2{margin, margin};
  }
  return box;
}

double Loop::length() const {
  double sum = 0;
  for (const Piece& piece : pieces)
    sum += piece.length();
  return sum;
}

double Loop::turn_degrees(std::size_t i) const {
  const Piece& before = pieces[(i + pieces.size() - 1) % pieces.size()];
  const Vec2 in = before.tangent(before.length()), out = pieces[i].tangent(0);
  return std::fabs(angle_of(cross(in, out), dot(in, out))) * degrees_per_radian;
}

int Boundary::components() const {
  int outer = 0, winding = 0;
  for (const Loop& loop : loops)
    (loop.winds() ? winding : outer) += loop.outer ? 1 : 0;
  return outer + winding / 2 + (covers_torus ? 1 : 0);
}

int Boundary::holes() const {
  return static_cast<int>(std::count_if(loops.begin(), loops.end(), [](const Loop& loop) { return !loop.outer; }));
}

int Boundary::euler_characteristic() const {
  int sum = 0;
  for (const Loop& loop : loops)
    sum += loop.winds() ? 0 : loop.outer ? 1 : -1;
  return sum;
}

double Boundary::length() const {
  double sum = 0;
  for (const Loop& loop : loops)
    sum += loop.length();
  return sum;
}

Box Boundary::bounding_box() const {
  Box box;
  for (const Loop& loop : loops)
    for (const Piece& piece : loop.pieces) {
      box.include(piece.start);
      box.include(piece.end);
      if (piece.circular)
        include_arc(box, piece);
    }
  return box;
}

} // namespace trime::geometry
