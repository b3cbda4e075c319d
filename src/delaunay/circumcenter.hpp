// SPDX-License-Identifier: BSD-3-Clause
// Circumcentres with proven error bounds.
#pragma once

#include <cmath>

namespace trime::delaunay {

constexpr double epsilon = 0x1p-53;

/// Circumcentre of the origin, a and b.
struct Vertex {
  double x, y, error, r2;
  bool sound;
};

/// c = (|a|^2 b - |b|^2 a) turned, over 2 a x b. Rounding errors are 4 eps S in the two sums of products of the
/// numerators and 2 eps D in the determinant, where S and D are the sums of magnitudes. So each coordinate of c is
/// exact to (4 eps S / 2 + |c| (2 eps D)) / det plus a few eps |c|. Everything is rounded up generously. It is not
/// sound if the determinant is as small as its error.
inline Vertex circumcenter(double ax, double ay, double bx, double by) {
  const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
  const double axby = ax * by, aybx = ay * bx, determinant = axby - aybx;
  const double determinant_size = std::fabs(axby) + std::fabs(aybx);
  const double half_inverse = 0.5 / determinant;
  const double x = (a2 * by - b2 * ay) * half_inverse, y = (b2 * ax - a2 * bx) * half_inverse;
  const double size = std::fabs(x) + std::fabs(y);
  const double products = a2 * (std::fabs(bx) + std::fabs(by)) + b2 * (std::fabs(ax) + std::fabs(ay));
  const double center_error = epsilon * (std::fabs(half_inverse) * 5 * (products + determinant_size * size) + 8 * size);
  return {x, y, 2 * center_error + 8 * epsilon * size,
          (x * x + y * y) * (1 + 1e-12) + 4 * center_error * (size + center_error),
          determinant > 64 * epsilon * determinant_size};
}

} // namespace trime::delaunay
