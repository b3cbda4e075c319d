// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module mesh.
#pragma once

namespace trime::mesh {

/// The numbers of mesh: how large cells, tiles and bins are.
struct MeshRules {
  /// [points] Mean number in a cell of the container grid, and in a bin.
  static constexpr double points_per_cell = 3.3;
  /// [points] Largest number in a tile, which is a unit of work for one thread. A quarter of it, the least that uniform
  /// tiles hold, is wide enough to sleep. The shares of ranks differ by up to this number. Not measured.
  static constexpr double points_per_tile = 512;
  /// [points] A tile of a small mesh may always hold this number. Not measured.
  static constexpr double fewest_per_tile = 80;
  /// [tiles] Smallest number of tiles, about, so that ranks and threads get equal shares; fewest_per_tile limits it.
  /// Not measured.
  static constexpr double wanted_tiles = 200;
  /// [points] Largest number in a tile of a large mesh. Not measured.
  static constexpr double most_per_tile = 1000;
  /// [tiles] From this number on tiles grow with the mesh, up to most_per_tile. Not measured.
  static constexpr double many_tiles = 4000;
  /// [units] Smallest number of units along the shorter side of the container, so that they are nearly square. Not
  /// measured.
  static constexpr double units_across = 32;
  /// [levels] Units are no smaller than that, however slender the container is. Not measured.
  static constexpr int finest_unit_level = 20;
  /// [levels] Tiles of the typical density are no smaller than that. Not measured.
  static constexpr int finest_typical_level = 20;
  /// [levels] Nor is any tile: its bins need some levels more. Not measured.
  static constexpr int finest_tile_level = 26;
  /// [points] A bin with more is too full, and those of its tile are halved again. Not measured.
  static constexpr int fullest_bin = 16;
  /// [bins] Largest number of bins of a tile for each site, however its sites are clustered: it bounds the memory. Not
  /// measured.
  static constexpr int most_bins_per_site = 64;
  /// [1] A tile has 2^k x 2^k bins with k at most this: 2^24 bins, whose numbers and counts fit into 32 bits.
  /// A bound; no case measured reaches it.
  static constexpr int finest_bin_bits = 12;
};

} // namespace trime::mesh
