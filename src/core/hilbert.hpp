// SPDX-License-Identifier: BSD-3-Clause
// The Hilbert curve through a square of 2^level x 2^level cells: cells near on the curve are near in the square.
#pragma once

#include <cstdint>

namespace trime {

/// Column and row of a cell.
struct GridPosition {
  std::uint32_t x, y;
};

/// @brief Position along the Hilbert curve of the cell (x, y) of a 2^level x 2^level square. O(level / 4).
/// @pre level at most 32
std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y, int level);

/// Inverse of hilbert_key. O(level).
GridPosition hilbert_position(std::uint64_t key, int level);

} // namespace trime
