// SPDX-License-Identifier: BSD-3-Clause
// Searches for the nearest segment and the lowest cone in a hierarchy of boxes. The kernels are compiled once for each
// SIMD level, and all builds give the same bits. They use plain arrays, because they must not share any inline
// function.
#pragma once

#include "core/simd_level.hpp"

#include <cstdint>

namespace trime::cones {

inline constexpr int box_width = 8; ///< boxes of a node, items of a leaf

/// The boxes below a node, each with the least number of its items. Missing boxes are infinitely far away.
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

/// The cones of a leaf. They are infinitely high in unused lanes.
struct alignas(64) ConeLeaf {
  double x[box_width], y[box_width], height[box_width];
};

struct NearestPoint {
  double x, y, squared_distance;
  std::int64_t segment; ///< the segment on which it lies: 8 times the leaf, plus the place in it
};

struct LowestCone {
  double value;
  std::int64_t cone;
};

struct SearchKernel {
  /// @brief Replaces `best` by a point of a segment that is nearer to (x, y), if there is one.
  /// @param boxes are searched within this share of the squared distance of the best point
  void (*nearest)(const BoxLevels& levels, const SegmentLeaf* leaves, double x, double y, double share,
                  NearestPoint& best);

  /// @brief Replaces `best` by the lowest cone at (x, y), if there is one below it.
  /// @param boxes are searched below this share of the value of the best cone
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
