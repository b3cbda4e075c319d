// SPDX-License-Identifier: BSD-3-Clause
// Operations of the cells of the size field on lists of cones. They are compiled once for each SIMD level, with the
// same bits on all.
#pragma once

#include "core/simd_level.hpp"

#include <cstdint>

namespace trime::cones {

/// @brief The cones that may be the lowest somewhere in a cell, as arrays side by side: x, y, height, and the value at
/// each of some points of the cell.
///
/// Plain arrays, since the kernels are compiled for different processors and must not share any inline function.
struct ConeList {
  /// The points: 3 x 3 row by row, then the centres of the quarters.
  static constexpr int points = 13, center = 4, first_quarter = 9;
  static constexpr int arrays = points + 3;
  static constexpr std::int64_t padding = 8; ///< behind the last cone up to a multiple of it are cones without effect

  double* numbers = nullptr;
  std::int64_t stride = 0; ///< from array to array
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

/// A short list of cones that is enough in a cell.
struct ConeChoice {
  static constexpr int most = 14;                  ///< that can be chosen
  static constexpr std::int64_t most_listed = 512; ///< longer lists are not tried

  double min_x, min_y, max_x, max_y; ///< of the cell
  double slack;                      ///< how much too high the field may become
  double bend;                       ///< a quarter of the slope and of the square of the cell's side
  std::int64_t chosen[most];
};

struct ConeKernel {
  /// Sets the padding, and what belongs to the points.
  void (*evaluate)(ConeList& list, double slope, const ConePoints& points);

  /// @brief The list of a quarter of a cell, with values at its corners and its centre. Left out are cones that are
  /// covered: another, one of those that are the lowest at one of these points, is lower everywhere in the quarter.
  ///
  /// That shows at the corners alone: the points where |p - b| - |p - a| >= c are a convex set for c >= 0 (the inside
  /// of one branch of a hyperbola). For c < 0 it is asked with 0, which is more.
  /// @pre `to` has room for all
  void (*pass_on)(const ConeList& from, int quarter, ConeList& to);

  /// @brief Chooses up to `most` cones that are together higher than all by `slack` at most, and not at the corners.
  /// Returns how many, or 0 if they are not enough.
  ///
  /// A cone at b may be left out in favour of one at a if, at the corners, that one is higher by at most the slack
  /// minus bend / d, where d is the distance from b to the cell. Reason: |p - a| - |p - b| + |p - centre|^2 / (2 d) is
  /// convex, so it is largest at the corners.
  int (*choose)(const ConeList& list, int most, ConeChoice& choice);
};

ConeKernel cone_kernel_portable();
ConeKernel cone_kernel_avx2();
ConeKernel cone_kernel_avx512();

inline ConeKernel cone_kernel(SimdLevel level) {
  return of_level(level, cone_kernel_portable, cone_kernel_avx2, cone_kernel_avx512)();
}

} // namespace trime::cones
