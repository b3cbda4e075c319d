// SPDX-License-Identifier: BSD-3-Clause
// Two doubles side by side (vector extension of g++ and clang++): the same bits as two scalar operations, since nothing
// is contracted. Loads are explicit: gather instructions are slow on common processors.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <cstring>

namespace trime::delaunay {

using Double2 [[gnu::vector_size(16)]] = double;
using Mask2 [[gnu::vector_size(16)]] = std::int64_t; // -1 where true

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

/// Number of positions in [begin, end) at squared distance at most r2 from center.
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

} // namespace trime::delaunay
