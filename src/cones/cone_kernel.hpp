// SPDX-License-Identifier: BSD-3-Clause
// The operations on lists of cones with which the cells of the size field are built. They are compiled once for each
// SIMD level, and all builds give the same bits.
#pragma once

#include "core/simd_level.hpp"

#include <cstdint>

namespace trime::cones {

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
