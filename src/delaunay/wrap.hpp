// SPDX-License-Identifier: BSD-3-Clause
// Gift wrapping of the stars of several sites at once, in float32 with proven error bounds: a star that it gives is
// exactly right, what it cannot prove it leaves to others. Built once for each SIMD level.
#pragma once

#include "core/simd_level.hpp"

#include <cstdint>

namespace trime::delaunay {

/// @brief A group of sites and the candidates that they share: all known sites of a box. Lengths are in units of a
/// length of the caller's, such that neighbours are about 1 apart; coordinates count from the centre of the box. Each
/// is the sum of a multiple of 2^-19 below 16 and a rest rounded to float32: differences of two are then known to 2^-42
/// and the rounding of one sum.
///
/// Plain arrays, since the kernels are compiled for different processors and must not share any inline function.
struct WrapGroup {
  static constexpr int most_lanes = 16, most_candidates = 240, most_degree = 16, padding = 8;

  // In.
  float half_x, half_y; ///< of the box: half its sides; no candidate lies outside
  int candidates;
  struct alignas(16) Candidate {
    float x, y, rest_x, rest_y;
  };
  Candidate candidate[most_candidates + padding];
  alignas(64) float site_x[most_lanes], site_y[most_lanes], site_rest_x[most_lanes], site_rest_y[most_lanes];
  alignas(64) float cap[most_lanes]; ///< circumradii must be smaller

  // Out.
  alignas(64) std::int32_t ring[most_degree][most_lanes]; ///< candidates, counter-clockwise
  alignas(64) std::int32_t degree[most_lanes];            ///< 0: no ring found
  alignas(64) std::int32_t proven[most_lanes];            ///< 0: float32 does not decide about the ring
  alignas(64) std::int32_t covered[most_lanes];           ///< 0: a disc leaves the box, or is too large
  alignas(64) float low_x[most_lanes], low_y[most_lanes], high_x[most_lanes], high_y[most_lanes]; ///< hold all discs

  // Work space: the candidates as each site sees them.
  alignas(64) float u[most_candidates + padding][2 * most_lanes];
};

/// @brief Finds the stars of the sites of a group. If all sites of the box were candidates, a star that is proven and
/// covered is the ring of Delaunay neighbours of its site among all sites. It has no ties, all circumradii are below
/// the cap, and all discs are inside the box given by low and high. The statement about the discs is true in any case.
using WrapFunction = void (*)(WrapGroup& group);

void wrap_portable(WrapGroup& group);
void wrap_avx2(WrapGroup& group);
void wrap_avx512(WrapGroup& group);

/// A kernel and the sites that it takes at once.
struct WrapKernel {
  WrapFunction wrap;
  int lanes;
};
inline WrapKernel wrap_kernel(SimdLevel level) {
  return of_level<WrapKernel>(level, {wrap_portable, 4}, {wrap_avx2, 8}, {wrap_avx512, 16});
}

} // namespace trime::delaunay
