// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module placing: lattices, and quantiles of the density.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trime::placing {

/// The numbers by which inner sites are placed.
struct PlacingRules {
  /// [spacings] Width of the strip along the boundary that lattice sites leave free. 0.4 to 0.55 were best: on a disc
  /// mean alpha was 1.0029 with 0.45, 1.0034 with 0.7.
  static constexpr double lattice_strip = 0.45;
  /// [sites] A run of a row of the lattice near the boundary is halved until it has at most this number, or is clear.
  /// Not measured.
  static constexpr std::int64_t shortest_half = 3;
  /// [h] The same for quantiles of the density. With it, 25 of the sites of a poker with 1e4 points lay in discs,
  /// without it 288; it also makes the count right.
  static constexpr double density_strip = 0.43;
  /// [sites] A cell of the density is divided while it wants more than this. Then the place of a site is known to half
  /// an edge.
  static constexpr double sites_in_cell = 0.25;
  /// [sites] The same near the boundary, where a cell may lie half in the strip.
  static constexpr double sites_in_cell_near = 0.0625;
  /// [levels] Cells of the density are divided down to this one at most: a bound for sizes that are far too small. Not
  /// measured.
  static constexpr int deepest_cell = 32;
  /// [sites] If a cell of the deepest level wants more, the size is far too small, and an error says so.
  static constexpr double most_in_deepest = 64;
  /// [cells] If a part of a tile takes more cells of the density, the size is far too small, and an error says so.
  static constexpr std::int64_t most_density_cells = 1 << 27;
  /// [chords] Kept for a cell of the density and its parts; where more are near, all chords are searched.
  static constexpr std::size_t most_near_chords = 48;
};

} // namespace trime::placing
