// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the cells that answer for the lower envelope of cones.
#pragma once

#include <cstddef>

namespace trime::cones {

/// The numbers of cones. Cells only make look-ups faster: none of these numbers changes an answer.
struct ConeRules {
  /// [cones] Number of cones in a block of cells, about. Cells are split from blocks.
  static constexpr double cones_per_block = 4;
  /// [blocks] Largest number along a side: it bounds the memory.
  static constexpr double most_blocks_along = 128;
  /// [cones] A cell with so few is not split. Cells and this together: a look-up took 60 ns instead of 330.
  static constexpr std::size_t enough = 12;
  /// [cones] Largest number in the list of a leaf; for the smallest cells with more, the tree is searched. Not
  /// measured.
  static constexpr std::size_t most_in_leaf = 24;
  /// [size] A cell is not split if its side is less than this number times the envelope: there are few look-ups in one
  /// cell.
  static constexpr double smallest_cell = 2;
  /// [1] Cells reach so far around the apexes, as a share of the longer side of their box: beyond, the tree is asked.
  static constexpr double margin = 0.1;
};

} // namespace trime::cones
