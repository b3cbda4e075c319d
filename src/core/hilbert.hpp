// SPDX-License-Identifier: BSD-3-Clause
// The Hilbert curve through a square of 2^level x 2^level cells. Cells that are close to each other along the curve are
// close in the square.
#pragma once

#include <cstdint>

namespace trime {

/// Column and row of a cell.
struct GridPosition {
  std::uint32_t x, y;
};

/// @brief A cell of the square at some level, with its position along the Hilbert curve and the orientation of the
/// curve inside it.
struct CurveSquare {
  std::uint32_t x = 0, y = 0; ///< column and row among 2^level x 2^level cells
  int level = 0;
  std::uint64_t key = 0; ///< position along the curve, see hilbert_key
  std::uint8_t turn = 0;

  /// Returns the k-th of the cell's four quarters along the curve. Cost: O(1).
  /// @pre level below 32, k below 4
  CurveSquare quarter(unsigned k) const;
};

/// Returns the cell (x, y) of 2^level x 2^level cells. Cost: O(level / 4).
/// @pre level <= 32
CurveSquare curve_square(std::uint32_t x, std::uint32_t y, int level);

/// @brief Returns the position of the cell (x, y) along the Hilbert curve through 2^level x 2^level cells. Cost:
/// O(level / 4).
/// @pre level <= 32
std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y, int level);

} // namespace trime
