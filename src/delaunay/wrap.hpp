// SPDX-License-Identifier: BSD-3-Clause
// Finds the stars of several sites at once by gift wrapping in float32, with proven error bounds. A star that it can
// prove to be right is exact; the other stars are left to the caller. Compiled once for each SIMD level.
#pragma once

#include "core/simd_level.hpp"

#include <cstdint>

namespace trime::delaunay {

/// @brief A group of sites, and the candidates for their neighbours, which are all known sites in a box. The caller
/// chooses the unit of length so that neighbours are about 1 apart; coordinates are relative to the centre of the box.
/// Each coordinate is the sum of a multiple of 2^-19 below 16 and a remainder that is rounded to float32. So the
/// difference of two coordinates has an error of at most 2^-42 plus the rounding of one sum.
///
/// The members are plain arrays, because the kernels are compiled for different processors and must not share any
/// inline function.
struct WrapGroup {
  static constexpr int most_lanes = 16, most_candidates = 240, most_degree = 16, padding = 8;

  // Input of the kernel.
  float half_x, half_y; ///< half of the sides of the box; all candidates lie inside
  int candidates;
  struct alignas(16) Candidate {
    float x, y, rest_x, rest_y;
  };
  Candidate candidate[most_candidates + padding];
  alignas(64) float site_x[most_lanes], site_y[most_lanes], site_rest_x[most_lanes], site_rest_y[most_lanes];
  alignas(64) float cap[most_lanes]; ///< largest allowed circumradius in each star

  // Output of the kernel.
  alignas(64)
      std::int32_t ring[most_degree][most_lanes]; ///< numbers of the candidates that are neighbours, counter-clockwise
  alignas(64) std::int32_t degree[most_lanes];    ///< number of neighbours; 0 if no ring was found
  alignas(64) std::int32_t proven[most_lanes];    ///< 0 if float32 cannot decide whether the ring is right
  alignas(64) std::int32_t covered[most_lanes];   ///< 0 if a circumcircle leaves the box or is too large
  alignas(64) float low_x[most_lanes], low_y[most_lanes], high_x[most_lanes],
      high_y[most_lanes]; ///< bounding box of all circumcircles

  // Work space: coordinates of the candidates relative to each site.
  alignas(64) float u[most_candidates + padding][2 * most_lanes];
};

/// @brief Finds the stars of the sites of a group. If all sites of the box are candidates, a star that is both proven
/// and covered is the ring of Delaunay neighbours of its site among all sites of the mesh. Such a star has no ties, all
/// circumradii are below the cap, and all circumcircles are inside the box given by low and high. The last statement
/// holds for every ring that was found.
using WrapFunction = void (*)(WrapGroup& group);

void wrap_portable(WrapGroup& group);
void wrap_avx2(WrapGroup& group);
void wrap_avx512(WrapGroup& group);

/// A kernel, and the number of sites that it processes at once.
struct WrapKernel {
  WrapFunction wrap;
  int lanes;
};
inline WrapKernel wrap_kernel(SimdLevel level) {
  return of_level<WrapKernel>(level, {wrap_portable, 4}, {wrap_avx2, 8}, {wrap_avx512, 16});
}

} // namespace trime::delaunay
