// SPDX-License-Identifier: BSD-3-Clause
// Computes circumcentres with proven error bounds.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace trime::delaunay {

using Double2 [[gnu::vector_size(16)]] = double;
using Mask2 [[gnu::vector_size(16)]] = std::int64_t; // -1 in lanes where a comparison is true

inline Double2 load2(const double* from) {
  Double2 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline Double2 both(double v) {
  return Double2{v, v};
}
inline Double2 max2(Double2 a, Double2 b) {
  return a > b ? a : b;
}
inline bool any(Mask2 m) {
  return (m[0] | m[1]) != 0;
}

/// Counts the positions in [begin, end) at squared distance at most r2 from center.
inline std::ptrdiff_t count_within(const geometry::Vec2* begin, const geometry::Vec2* end, geometry::Vec2 center,
                                   double r2) {
  const Double2 c{center.x, center.y}, limit = both(r2);
  Mask2 found{0, 0};
  const geometry::Vec2* p = begin;
  for (; p + 2 <= end; p += 2) {
    const Double2 d0 = load2(&p[0].x) - c, d1 = load2(&p[1].x) - c;
    const Double2 s0 = d0 * d0, s1 = d1 * d1;
    const Double2 d2 = __builtin_shufflevector(s0, s1, 0, 2) + __builtin_shufflevector(s0, s1, 1, 3);
    found += d2 <= limit;
  }
  std::ptrdiff_t count = -(found[0] + found[1]);
  if (p < end)
    count += geometry::squared_length(*p - center) <= r2;
  return count;
}

constexpr double epsilon = 0x1p-53;

/// The circumcentre of the origin, a and b, with an error bound.
struct Vertex {
  double x, y, error, r2;
  bool sound;
};

/// Returns the circumcentre c = (|a|^2 b - |b|^2 a) turned by 90 degrees, over 2 a x b. Let S and D be the sums of the
/// magnitudes of the products in the numerators and in the determinant. Rounding errors are at most 4 eps S in the
/// numerators and 2 eps D in the determinant. So the error of each coordinate of c is at most (4 eps S / 2 + |c| (2 eps
/// D)) / det plus a few eps |c|. All bounds are rounded up generously. The bounds do not hold if the determinant is as
/// small as its error; then `sound` is false.
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
