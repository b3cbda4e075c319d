// SPDX-License-Identifier: BSD-3-Clause
// Exact geometric predicates for points of one coordinate lattice (lattice.hpp). The points lie in the lattice's
// container, or at most twice its size away.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// @brief Returns the sign of the area of the triangle a, b, c: +1 if counter-clockwise, 0 if collinear, -1 if
/// clockwise. Exact.
///
/// The differences of lattice points are exact, and rounding is monotone: if the two rounded products differ, the exact
/// products differ in the same direction. Only if the rounded products are equal, their rounding errors are compared
/// (two fused multiply-adds).
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

/// @brief Returns +1 if d lies inside the circle through a, b, c (counter-clockwise), -1 if outside. Exact; never 0 if
/// the four points are different and a, b, c are not collinear.
///
/// Cocircular points are decided by symbolic perturbation (Devillers and Teillaud 2011): the lifted height x^2+y^2 of
/// each point is raised by an infinitesimal amount, which is larger for points later in lexicographic order. So the
/// answer depends on the coordinates alone. A floating-point filter (Shewchuk 1997, error bound A) decides nearly all
/// calls; the others are evaluated in 192-bit integers on lattice steps.
int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice);

/// @brief Returns the result of in_circle if the floating-point filter is certain, otherwise 0. The function is inline
/// and without branches, so that the compiler can vectorise loops over many calls.
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

/// Computes in_circle in exact integers without the filter. Used by tests, and if the filter is not certain.
int in_circle_exact(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice);

/// Returns whether d lies strictly inside the circle through a, b, c (counter-clockwise); false for cocircular points.
/// Exact.
bool is_inside_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice);

/// @brief Computes in_circle in a periodic container, where periodic images of the four points must give the same
/// result. Ties are broken by the order of the canonical images, so all images of four points agree. If the container
/// is not periodic, it is the function above.
int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice, const Periods& periods);

/// @brief Returns -1 if p lies strictly inside the circle with diameter a-b, 0 on it, +1 outside: the sign of
/// (a-p).(b-p). Exact for points of one lattice, by the argument of orient2d.
inline int diametral_side(Vec2 a, Vec2 b, Vec2 p) {
  const double apx = a.x - p.x, apy = a.y - p.y, bpx = b.x - p.x, bpy = b.y - p.y;
  const double left = apx * bpx, right = -(apy * bpy);
  if (left > right)
    return 1;
  if (left < right)
    return -1;
  const double left_error = std::fma(apx, bpx, -left), right_error = std::fma(-apy, bpy, -right);
  return (left_error > right_error) - (left_error < right_error);
}

/// Returns the side of a line with direction d to which symbolic perturbation moves a point; 0 only if d is zero.
inline int side_of_move(Vec2 d) {
  return d.x != 0 ? (d.x > 0 ? 1 : -1) : (d.y < 0) - (d.y > 0);
}

/// Returns the side of the line a-b on which the symbolically perturbed point q lies; 0 only if a == b.
inline int perturbed_side(const Segment& s, Vec2 q) {
  const int sign = orient2d(s.a, s.b, q);
  return sign != 0 ? sign : side_of_move(s.b - s.a);
}

/// Returns whether the segment crosses the straight way from p to q, both perturbed. By the even-odd rule, each crossed
/// segment of closed polygons leads from inside to outside or back.
inline bool crosses_way(const Segment& s, Vec2 p, Vec2 q) {
  if (p == q || perturbed_side(s, p) == perturbed_side(s, q))
    return false;
  const auto side = [&](Vec2 end) { // side of the perturbed way; the end is moved back instead of the way
    const int sign = orient2d(p, q, end);
    return sign != 0 ? sign : -side_of_move(q - p);
  };
  return side(s.a) != side(s.b);
}

} // namespace trime::geometry
