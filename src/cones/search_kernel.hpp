// SPDX-License-Identifier: BSD-3-Clause
// Searches for the nearest segment and the lowest cone in a hierarchy of boxes. Built once for each SIMD level, with
// the same bits on all. Plain arrays, since the kernels must not share any inline function.
#pragma once

#include "core/simd_level.hpp"

#include <cstdint>

namespace trime::cones {

inline constexpr int box_width = 8; ///< boxes of a node, items of a leaf

/// The boxes below a node, each with the least number of its items; those that are missing are infinitely far away.
struct alignas(64) BoxNode {
  double min_x[box_width], min_y[box_width], max_x[box_width], max_y[box_width], number[box_width];
};

/// From the nodes over leaves to the root; box k of a level leads to node k of the level below, or to leaf k.
struct BoxLevels {
  static constexpr int most = 12;
  const BoxNode* nodes[most] = {};
  int count = 0;
};

/// The segments a + t d, 0 <= t <= 1, of a leaf; a is NaN in unused lanes.
struct alignas(64) SegmentLeaf {
  double a_x[box_width], a_y[box_width], d_x[box_width], d_y[box_width], inverse_square[box_width];
};

/// The cones of a leaf; infinitely high in unused lanes.
struct alignas(64) ConeLeaf {
  double x[box_width], y[box_width], height[box_width];
};

struct NearestPoint {
  double x, y, squared_distance;
  std::int64_t segment; ///< on which it lies; the leaf, times 8, and the place in it
};

struct LowestCone {
  double value;
  std::int64_t cone;
};

struct SearchKernel {
  /// @brief Replaces `best` by a point of a segment that is nearer to (x, y), if there is one.
  /// @param share of the squared distance of the best point within which boxes are looked at
  void (*nearest)(const BoxLevels& levels, const SegmentLeaf* leaves, double x, double y, double share,
                  NearestPoint& best);

  /// @brief Replaces `best` by the lowest cone at (x, y), if there is one below it.
  /// @param share of the value of the best cone below which boxes are looked at
  void (*lowest)(const BoxLevels& levels, const ConeLeaf* leaves, double slope, double x, double y, double share,
                 LowestCone& best);
};

SearchKernel search_kernel_portable();
SearchKernel search_kernel_avx2();
SearchKernel search_kernel_avx512();

inline SearchKernel search_kernel(SimdLevel level) {
  return of_level(level, search_kernel_portable, search_kernel_avx2, search_kernel_avx512)();
}

} // namespace trime::cones
