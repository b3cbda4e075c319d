// SPDX-License-Identifier: BSD-3-Clause
// Constants of angles and of the equilateral triangle, and functions for sine, cosine and the angle of a vector. The
// functions use + - * / and sqrt alone, so every compiler and C library gives the same bits, and points on circular
// arcs may become coordinates of a mesh.
#pragma once

namespace trime {

inline constexpr double pi = 0x1.921fb54442d18p+1;
inline constexpr double degrees = pi / 180;            ///< 60 * degrees is in radians
inline constexpr double degrees_per_radian = 180 / pi; ///< radians * degrees_per_radian is in degrees
inline constexpr double sqrt_3 = 1.7320508075688772;
inline constexpr double half_sqrt_2 = 0.70710678118654757; ///< half the diagonal of a square of side 1
inline constexpr double row_height = 0.5 * sqrt_3; ///< height of an equilateral triangle of side 1: sin(60 degrees)

struct SinCos {
  double sin, cos;
};

/// @brief Returns sine and cosine, each to within 3e-16. @pre |radians| <= 1e5
SinCos sin_cos(double radians);

/// @brief Returns the angle of the vector (x, y) from the positive x axis, -pi..pi, to within 4e-16, or 0 for the null
/// vector. Arguments have the order of std::atan2, but the sign of a zero is ignored: (-1, -0.0) has +pi.
double angle_of(double y, double x);

} // namespace trime
