// SPDX-License-Identifier: BSD-3-Clause
// Computes where segments and circles with coordinates on one lattice cross. The error is a fraction of a lattice step.
#pragma once

#include "trime/geometry/segment_grid.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/shape/part.hpp"

#include <array>

namespace trime::shape {

/// At most two crossing points.
struct Crossings {
  int count = 0;
  std::array<geometry::Vec2, 2> at;

  void add(geometry::Vec2 p) { at[count++] = p; }
};

/// Return the cross product and the dot product of differences of lattice points to within 2 ulp, by Kahan's method
/// with fused multiply-add.
double accurate_cross(geometry::Vec2 a, geometry::Vec2 b);
double accurate_dot(geometry::Vec2 a, geometry::Vec2 b);

/// Returns the crossing of the lines through two segments. @pre they are not parallel
geometry::Vec2 line_crossing(const geometry::Segment& s, const geometry::Segment& t);

/// @brief Returns the crossings of a segment with a circle.
///
/// If the segment comes nearer to the circle than `tolerance` without crossing it, or crosses it by less than that, the
/// result is one point of contact. If an end of the segment lies within `tolerance` of the circle, this end replaces
/// the crossing next to it.
Crossings segment_circle_crossings(const geometry::Segment& s, const Circle& circle, double tolerance);

/// Returns the crossings of two circles, or one point of contact as above.
/// @pre the circles differ by more than `tolerance`
Crossings circle_crossings(const Circle& a, const Circle& b, double tolerance);

/// Returns the distance from p to the circle, with a negative sign inside.
double signed_distance(geometry::Vec2 p, const Circle& circle);

} // namespace trime::shape
