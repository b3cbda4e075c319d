// SPDX-License-Identifier: BSD-3-Clause
// The kernels of the size field: they find the nearest segment and the lowest
// cone in a hierarchy of boxes, and process the lists of cones in quadtree cells. The kernels are compiled once for
// each SIMD level, with bit-identical results. They use plain arrays, because code for different processors must not
// share any inline function.
#pragma once

#include "core/simd_level.hpp"

#include <cstdint>

namespace trime::cones {

inline constexpr int box_width = 8; ///< number of boxes in a node, and of items in a leaf

/// The boxes below a node, each with the smallest number of its items. Missing boxes are infinitely far away.
struct alignas(64) BoxNode {
  double min_x[box_width], min_y[box_width], max_x[box_width], max_y[box_width], number[box_width];
};

/// The levels of a hierarchy of boxes, from the nodes above the leaves up to the root. Box k of a level contains node k
/// of the level below, or leaf k.
struct BoxLevels {
  static constexpr int most = 12;
  const BoxNode* nodes[most] = {};
  int count = 0;
};

/// The segments a + t d, 0 <= t <= 1, in a leaf. In unused lanes a is NaN.
struct alignas(64) SegmentLeaf {
  double a_x[box_width], a_y[box_width], d_x[box_width], d_y[box_width], inverse_square[box_width];
};

/// The cones in a leaf. In unused lanes they are infinitely high.
struct alignas(64) ConeLeaf {
  double x[box_width], y[box_width], height[box_width];
};

struct NearestPoint {
  double x, y, squared_distance;
  std::int64_t
      segment; ///< number of the segment on which the point lies: 8 times the leaf, plus the position in the leaf
};

struct LowestCone {
  double value;
  std::int64_t cone;
};

struct SearchKernel {
  /// @brief Replaces `best` by the nearest point to (x, y) on any segment, if it is nearer than `best`.
  /// @param share boxes are searched only within this share of the squared distance of the best point
  void (*nearest)(const BoxLevels& levels, const SegmentLeaf* leaves, double x, double y, double share,
                  NearestPoint& best);

  /// @brief Replaces `best` by the lowest cone at (x, y), if it is lower than `best`.
  /// @param share boxes are searched only for cones below this share of the value of the best cone
  void (*lowest)(const BoxLevels& levels, const ConeLeaf* leaves, double slope, double x, double y, double share,
                 LowestCone& best);
};

SearchKernel search_kernel_portable();
SearchKernel search_kernel_avx2();
SearchKernel search_kernel_avx512();

inline SearchKernel search_kernel(SimdLevel level) {
  return of_level(level, search_kernel_portable, search_kernel_avx2, search_kernel_avx512)();
}

/// @brief The cones that may be lowest somewhere in a quadtree cell, as separate arrays: x, y, height, and the value of
/// each cone at some points of the cell.
///
/// The arrays are plain, because the kernels are compiled for different processors and must not share any inline
/// function.
struct ConeList {
  /// Numbers of the points: 3 x 3 points row by row, then the centres of the four quarters.
  static constexpr int points = 13, center = 4, first_quarter = 9;
  static constexpr int arrays = points + 3;
  /// The arrays are filled up to a multiple of this number with cones that have no effect.
  static constexpr std::int64_t padding = 8;

  double* numbers = nullptr;
  std::int64_t stride = 0; ///< distance from one array to the next
  std::int64_t count = 0;
  double low[points] = {};          ///< smallest value of a cone at each point
  std::int64_t lowest[points] = {}; ///< the first cone with the smallest value at each point

  double* at(int point) const { return numbers + stride * point; }
  double* x() const { return at(points); }
  double* y() const { return at(points + 1); }
  double* height() const { return at(points + 2); }
};

/// Some points of a cell, given by their numbers in ConeList.
struct ConePoints {
  int count;
  int number[8];
  double x[8], y[8];
};

/// A short list of cones that is enough to represent the field in a cell.
struct ConeChoice {
  static constexpr int most = 14;                  ///< largest number of cones that are chosen
  static constexpr std::int64_t most_listed = 512; ///< longer lists of cones are not examined

  double min_x, min_y, max_x, max_y; ///< corners of the cell
  double slack;                      ///< largest error: how much too high the field may become
  double bend;                       ///< a quarter of the slope times the squared side of the cell
  std::int64_t chosen[most];
};

struct ConeKernel {
  /// Evaluates all cones at the points, and fills up the arrays.
  void (*evaluate)(ConeList& list, double slope, const ConePoints& points);

  /// @brief Makes the list of cones for a quarter of a cell, with values at its corners and its centre. Covered cones
  /// are left out. A cone is covered if another cone, which is lowest at one of these points, is lower everywhere in
  /// the quarter.
  ///
  /// Why comparing the values at the corners is enough: for c >= 0, the points where |p - b| - |p - a| >= c form a
  /// convex set (the inside of one branch of a hyperbola). For c < 0 the test uses 0, which is stricter.
  /// @pre `to` has room for all cones of `from`
  void (*pass_on)(const ConeList& from, int quarter, ConeList& to);

  /// @brief Chooses up to `most` cones whose envelope is exact at the corners and at most `slack` too high elsewhere.
  /// Returns their number, or 0 if `most` cones are not enough.
  ///
  /// A cone at a may replace a cone at b if, at the corners, its value is higher by at most slack - bend / d, where d
  /// is the distance from b to the cell. Reason: |p - a| - |p - b| + |p - centre|^2 / (2 d) is a convex function of p,
  /// so it is largest at a corner.
  int (*choose)(const ConeList& list, int most, ConeChoice& choice);
};

ConeKernel cone_kernel_portable();
ConeKernel cone_kernel_avx2();
ConeKernel cone_kernel_avx512();

inline ConeKernel cone_kernel(SimdLevel level) {
  return of_level(level, cone_kernel_portable, cone_kernel_avx2, cone_kernel_avx512)();
}

} // namespace trime::cones
