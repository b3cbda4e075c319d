// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module placing, which places the first sites on lattices and along the Hilbert curve.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trime::placing {

/// Numbers that determine where inner sites are placed.
struct PlacingRules {
  /// [spacings] Width of the strip along the boundary without lattice sites. Values from 0.4 to 0.55 were best: on a
  /// disc mean alpha was 1.0029 with 0.45, and 1.0034 with 0.7.
  static constexpr double lattice_strip = 0.45;
  /// [sites] A run of a row of the lattice near the boundary is halved until it has at most this number of sites, or
  /// does not touch the strip. Not measured.
  static constexpr std::int64_t shortest_half = 3;
  /// [h] Width of the strip along the boundary without sites, if sites are placed along the Hilbert curve. On a poker
  /// card with 1e4 points, 25 sites lay in diametral circles of boundary edges with this strip, and 288 without it. The
  /// strip also makes the number of sites correct.
  static constexpr double density_strip = 0.43;
  /// [sites] A cell of the density is divided while its weight is more than this. Then the position of a site is
  /// correct to half an edge.
  static constexpr double sites_in_cell = 0.25;
  /// [sites] Near the boundary, a cell of the density is divided while its weight is more than this, because the cell
  /// may lie partly in the strip.
  static constexpr double sites_in_cell_near = 0.0625;
  /// [levels] Deepest level of cells of the density. The limit bounds the work for sizes that are far too small. Not
  /// measured.
  static constexpr int deepest_cell = 32;
  /// [sites] If a cell of the deepest level has a larger weight, the size is far too small, and an error is thrown.
  static constexpr double most_in_deepest = 64;
  /// [cells] If a part of a tile needs more cells of the density than this, the size is far too small, and an error is
  /// thrown.
  static constexpr std::int64_t most_density_cells = 1 << 27;
  /// [chords] Largest number of boundary edges that are listed as near to a cell of the density. If more are near, all
  /// boundary edges are searched.
  static constexpr std::size_t most_near_chords = 48;
  /// [levels] If a size prefers blocks, the sizes in at most this number of levels of cells of the density are asked
  /// for at once: those of up to 5460 cells. Not measured.
  static constexpr int most_levels_together = 6;
};

} // namespace trime::placing
