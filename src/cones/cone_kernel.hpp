// SPDX-License-Identifier: BSD-3-Clause
// The kernels of the size field: searches for the nearest segment and the lowest cone in a hierarchy of boxes, and
// operations of the cells on lists of cones. They are built once for each SIMD level, with the same bits on all. They
// use plain arrays, since the kernels must not share any inline function.
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

/// @brief The cones that may be lowest somewhere in a cell, as separate arrays: x, y, height, and the value at each of
/// some points of the cell.
///
/// The arrays are plain, because the kernels are compiled for different processors and must not share any inline
/// function.
struct ConeList {
  /// Numbers of the points: 3 x 3 points row by row, then the centres of the quarters.
  static constexpr int points = 13, center = 4, first_quarter = 9;
  static constexpr int arrays = points + 3;
  /// Cones without effect follow the last one, up to a multiple of this number.
  static constexpr std::int64_t padding = 8;

  double* numbers = nullptr;
  std::int64_t stride = 0; ///< distance from array to array
  std::int64_t count = 0;
  double low[points] = {};          ///< least value at a point
  std::int64_t lowest[points] = {}; ///< the first cone with that value

  double* at(int point) const { return numbers + stride * point; }
  double* x() const { return at(points); }
  double* y() const { return at(points + 1); }
  double* height() const { return at(points + 2); }
};

/// Some points of a cell, by their numbers.
struct ConePoints {
  int count;
  int number[8];
  double x[8], y[8];
};

/// A short list of cones that suffices in a cell.
struct ConeChoice {
  static constexpr int most = 14;                  ///< largest number of chosen cones
  static constexpr std::int64_t most_listed = 512; ///< longer lists are not tried

  double min_x, min_y, max_x, max_y; ///< box of the cell
  double slack;                      ///< largest error of the field, which becomes too high
  double bend;                       ///< a quarter of the slope times the squared side of the cell
  std::int64_t chosen[most];
};

struct ConeKernel {
  /// Sets the padding, and the values at the points.
  void (*evaluate)(ConeList& list, double slope, const ConePoints& points);

  /// @brief Makes the list of a quarter of a cell, with values at its corners and its centre. It leaves out covered
  /// cones. A cone is covered if a cone that is lowest at one of these points is lower everywhere in the quarter.
  ///
  /// It suffices to compare at the corners, because the points where |p - b| - |p - a| >= c form a convex set for c >=
  /// 0 (the inside of one branch of a hyperbola). For c < 0 the test uses 0, which is stricter.
  /// @pre `to` has room for all cones
  void (*pass_on)(const ConeList& from, int quarter, ConeList& to);

  /// @brief Chooses up to `most` cones whose envelope is exact at the corners and elsewhere at most `slack` too high.
  /// Returns their number, or 0 if that many do not suffice.
  ///
  /// A cone at a may replace a cone at b if, at the corners, it is higher by at most slack - bend / d, where d is the
  /// distance from b to the cell. Reason: |p - a| - |p - b| + |p - centre|^2 / (2 d) is convex, so it is largest at the
  /// corners.
  int (*choose)(const ConeList& list, int most, ConeChoice& choice);
};

ConeKernel cone_kernel_portable();
ConeKernel cone_kernel_avx2();
ConeKernel cone_kernel_avx512();

inline ConeKernel cone_kernel(SimdLevel level) {
  return of_level(level, cone_kernel_portable, cone_kernel_avx2, cone_kernel_avx512)();
}

} // namespace trime::cones
