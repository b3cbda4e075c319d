// SPDX-License-Identifier: BSD-3-Clause
// The Hilbert curve through a square of 2^level x 2^level cells: cells near on the curve are near in the square.
#pragma once

#include <cstdint>

namespace trime {

/// Column and row of a cell.
struct GridPosition {
  std::uint32_t x, y;
};

/// @brief A cell of the curve's square at some level: where it lies, when the curve comes through, and how the curve is
/// turned in it.
struct CurveSquare {
  std::uint32_t x = 0, y = 0; ///< column and row among 2^level x 2^level
  int level = 0;
  std::uint64_t key = 0; ///< see hilbert_key
  std::uint8_t turn = 0;

  /// The k-th of its four quarters along the curve. O(1). @pre level below 32, k below 4
  CurveSquare quarter(unsigned k) const;
};

/// The cell (x, y) of 2^level x 2^level. O(level / 4). @pre level at most 32
CurveSquare curve_square(std::uint32_t x, std::uint32_t y, int level);

/// @brief Position along the Hilbert curve of the cell (x, y) of a 2^level x 2^level square. O(level / 4).
/// @pre level at most 32
std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y, int level);

} // namespace trime
