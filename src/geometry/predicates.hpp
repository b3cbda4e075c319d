// SPDX-License-Identifier: BSD-3-Clause
// Exact predicates for points of one lattice (lattice.hpp), in its container or within twice its size around it.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// @brief Returns the sign of the area of the triangle a, b, c: +1 if counter-clockwise, 0 if collinear, -1 if
/// clockwise. Exact.
///
/// The differences of lattice points are exact, and rounding is monotone: if the two rounded products differ, so do
/// the products, in the same sense. Only equal rounded products need their rounding errors (two fused products).
inline int orient2d(Vec2 a, Vec2 b, Vec2 c) {
  const double acx = a.x - c.x, acy = a.y - c.y, bcx = b.x - c.x, bcy = b.y - c.y;
  const double left = acx * bcy, right = acy * bcx;
  if (left > right)
    return 1;
  if (left < right)
    return -1;
  const double left_error = std::fma(acx, bcy, -left), right_error = std::fma(acy, bcx, -right);
  return (left_error > right_error) - (left_error < right_error);
}

/// @brief Returns +1 if d lies inside the circle through a, b, c (counter-clockwise), -1 if outside. Exact; never 0 for
/// four different points where a, b, c are not collinear.
///
/// Cocircular points are decided as if the lifted height x^2+y^2 of each point were raised by an infinitesimal. It is
/// larger for points later in lexicographic order (symbolic perturbation, Devillers and Teillaud 2011). So the answer
/// depends on the coordinates alone. A float filter (Shewchuk 1997, error bound A) decides nearly all calls; the rest
/// are evaluated in 192-bit integers on lattice steps.
int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice);

/// @brief Returns the result of in_circle if its float filter is certain, otherwise 0. It is inline and without
/// branches, so that the compiler can vectorise loops over many quadruples.
inline int in_circle_filter(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y, cx = c.x - d.x, cy = c.y - d.y;
  const double bxcy = bx * cy, cxby = cx * by, cxay = cx * ay, axcy = ax * cy, axby = ax * by, bxay = bx * ay;
  const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  const double determinant = a2 * (bxcy - cxby) + b2 * (cxay - axcy) + c2 * (axby - bxay);
  const double permanent = a2 * (std::fabs(bxcy) + std::fabs(cxby)) + b2 * (std::fabs(cxay) + std::fabs(axcy)) +
                           c2 * (std::fabs(axby) + std::fabs(bxay));
  constexpr double epsilon = 0x1p-53;
  constexpr double error_bound = (10 + 96 * epsilon) * epsilon;
  return (determinant > error_bound * permanent) - (determinant < -error_bound * permanent);
}

/// Returns the result of in_circle without the filter: for tests, and if the filter is not certain.
int in_circle_exact(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice);

/// @brief As in_circle, in a periodic container, where images of the four points give the same result. Ties are broken
/// by the order of the canonical images, so all images of four points agree. Without periods it is the function above.
int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice, const Periods& periods);

} // namespace trime::geometry
