// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module placing: lattices, and quantiles of the density.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trime::placing {

/// Numbers that say where inner sites are placed.
struct PlacingRules {
  /// [spacings] Width of the strip along the boundary without lattice sites. 0.4 to 0.55 were best: on a disc mean
  /// alpha was 1.0029 with 0.45, 1.0034 with 0.7.
  static constexpr double lattice_strip = 0.45;
  /// [sites] A run of a row of the lattice near the boundary is halved until it has at most this number, or does not
  /// touch the strip. Not measured.
  static constexpr std::int64_t shortest_half = 3;
  /// [h] Width of the strip without sites for quantiles of the density. On a poker with 1e4 points, 25 sites lay in
  /// discs with it, and 288 without it. It also makes the number of sites right.
  static constexpr double density_strip = 0.43;
  /// [sites] A cell of the density is divided while it should hold more than this. Then the place of a site is known to
  /// half an edge.
  static constexpr double sites_in_cell = 0.25;
  /// [sites] Near the boundary, a cell is divided while it should hold more than this, because it may lie partly in the
  /// strip.
  static constexpr double sites_in_cell_near = 0.0625;
  /// [levels] Deepest level of cells of the density. It is a bound for sizes that are far too small. Not measured.
  static constexpr int deepest_cell = 32;
  /// [sites] If a cell of the deepest level should hold more, the size is far too small, which is an error.
  static constexpr double most_in_deepest = 64;
  /// [cells] If a part of a tile needs more cells of the density, the size is far too small, which is an error.
  static constexpr std::int64_t most_density_cells = 1 << 27;
  /// [chords] Largest number that is kept for a cell of the density and its parts. If more are near, all chords are
  /// searched.
  static constexpr std::size_t most_near_chords = 48;
};

} // namespace trime::placing
