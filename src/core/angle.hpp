// SPDX-License-Identifier: BSD-3-Clause
// Constants for angles and for the equilateral triangle; functions for the sine,
// the cosine and the angle of a vector. The functions use only + - * / and sqrt, so every compiler and C library gives
// the same bits. The same bits are needed because points on circular arcs become coordinates of a mesh.
#pragma once

namespace trime {

inline constexpr double pi = 0x1.921fb54442d18p+1;
inline constexpr double degrees = pi / 180;            ///< 60 * degrees is an angle of 60 degrees in radians
inline constexpr double degrees_per_radian = 180 / pi; ///< an angle in radians times this factor is in degrees
inline constexpr double sqrt_3 = 1.7320508075688772;
inline constexpr double half_sqrt_2 = 0.70710678118654757; ///< half the diagonal of a square of side 1
inline constexpr double row_height = 0.5 * sqrt_3; ///< height of an equilateral triangle of side 1: sin(60 degrees)

struct SinCos {
  double sin, cos;
};

/// @brief Returns sine and cosine, each with an error of at most 3e-16.
/// @pre |radians| <= 1e5
SinCos sin_cos(double radians);

/// @brief Returns the angle of the vector (x, y) from the positive x axis, from -pi to pi, with an error of at most
/// 4e-16; 0 for the null vector. The arguments are in the order of std::atan2, but the sign of a zero is ignored: (-1,
/// -0.0) has the angle +pi.
double angle_of(double y, double x);

} // namespace trime
