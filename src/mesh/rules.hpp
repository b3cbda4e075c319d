// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module mesh.
#pragma once

namespace trime::mesh {

/// The numbers of mesh: how large cells, tiles and bins are.
struct MeshRules {
  /// [points] Mean number in a cell of the container grid, and in a bin.
  static constexpr double points_per_cell = 3.3;
  /// [points] Largest number in a tile, which is a unit of work for one thread. Uniform tiles hold at least a quarter
  /// of it, and are then wide enough for the sweeps to skip quiet ones. The shares of ranks differ by up to this
  /// number. Not measured.
  static constexpr double points_per_tile = 512;
  /// [points] Number that a tile may always hold, also in a small mesh. Not measured.
  static constexpr double fewest_per_tile = 80;
  /// [tiles] About the smallest number of tiles, so that ranks and threads get equal shares; fewest_per_tile limits it.
  /// Not measured.
  static constexpr double wanted_tiles = 200;
  /// [points] Largest number in a tile of a large mesh. Not measured.
  static constexpr double most_per_tile = 1000;
  /// [tiles] Beyond this number of tiles, tiles grow with the mesh up to most_per_tile. Not measured.
  static constexpr double many_tiles = 4000;
  /// [units] Smallest number of units along the shorter side of the container, so that they are nearly square. Not
  /// measured.
  static constexpr double units_across = 32;
  /// [levels] Finest level of units, however slender the container is. Not measured.
  static constexpr int finest_unit_level = 20;
  /// [levels] Finest level of tiles of the typical density. Not measured.
  static constexpr int finest_typical_level = 20;
  /// [levels] Finest level of any tile, because its bins need a few more levels. Not measured.
  static constexpr int finest_tile_level = 26;
  /// [points] If a bin holds more, all bins of its tile are halved again. Not measured.
  static constexpr int fullest_bin = 16;
  /// [bins] Largest number of bins of a tile for each of its sites. It bounds the memory where sites are clustered. Not
  /// measured.
  static constexpr int most_bins_per_site = 64;
  /// [1] A tile has 2^k x 2^k bins, with k at most this: the numbers and counts of 2^24 bins fit into 32 bits. No
  /// measured case reaches this bound.
  static constexpr int finest_bin_bits = 12;
};

} // namespace trime::mesh
