// SPDX-License-Identifier: BSD-3-Clause
// Where segments and circles of one lattice cross, to within a fraction of a lattice step.
#pragma once

#include "trime/geometry/segment_grid.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/shape/part.hpp"

#include <array>

namespace trime::shape {

/// At most two points.
struct Crossings {
  int count = 0;
  std::array<geometry::Vec2, 2> at;

  void add(geometry::Vec2 p) { at[count++] = p; }
};

/// Cross and dot product of differences of lattice points, to within 2 ulp (Kahan's use of the fused product).
double accurate_cross(geometry::Vec2 a, geometry::Vec2 b);
double accurate_dot(geometry::Vec2 a, geometry::Vec2 b);

/// Crossing of the lines through two segments. @pre not parallel
geometry::Vec2 line_crossing(const geometry::Segment& s, const geometry::Segment& t);

/// @brief Crossings of a segment with a circle.
///
/// Curves that come nearer than `tolerance` without crossing, or cross by less, have one point of contact. An end of
/// the segment within `tolerance` of the circle stands for the crossing next to it, which is then left out.
Crossings segment_circle_crossings(const geometry::Segment& s, const Circle& circle, double tolerance);

/// Crossings, or the point of contact (see above), of two circles that differ by more than `tolerance`.
Crossings circle_crossings(const Circle& a, const Circle& b, double tolerance);

/// Distance from the circle, negative inside.
double signed_distance(geometry::Vec2 p, const Circle& circle);

} // namespace trime::shape
