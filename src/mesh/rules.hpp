// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module mesh, which determine the sizes of cells, tiles and bins.
#pragma once

namespace trime::mesh {

/// The numbers that determine how large cells, tiles and bins are.
struct MeshRules {
  /// [points] Mean number of points in a cell of the grid over the container, and in a bin.
  static constexpr double points_per_cell = 3.3;
  /// [points] Largest number of points in a tile, which is a unit of work for one thread. A tile with uniform density
  /// holds at least a quarter of this number, and is then wide enough for sweeps to skip tiles without movement. The
  /// numbers of points on two ranks differ by up to this number. Not measured.
  static constexpr double points_per_tile = 512;
  /// [points] Number of points that a tile may always hold, even in a small mesh. Not measured.
  static constexpr double fewest_per_tile = 80;
  /// [tiles] Approximate smallest number of tiles, so that ranks and threads get equal shares; in small meshes
  /// fewest_per_tile makes it smaller. Not measured.
  static constexpr double wanted_tiles = 200;
  /// [points] Largest number of points in a tile of a large mesh. Not measured.
  static constexpr double most_per_tile = 1000;
  /// [tiles] If the mesh needs more tiles than this, tiles are made larger, up to most_per_tile points. Not measured.
  static constexpr double many_tiles = 4000;
  /// [units] Smallest number of units along the shorter side of the container. The number is large enough that units
  /// are nearly square. Not measured.
  static constexpr double units_across = 32;
  /// [levels] Finest level of units, however slender the container is. Not measured.
  static constexpr int finest_unit_level = 20;
  /// [levels] Finest level of tiles for the typical density. Not measured.
  static constexpr int finest_typical_level = 20;
  /// [levels] Finest level of any tile; a few levels remain for its bins. Not measured.
  static constexpr int finest_tile_level = 26;
  /// [points] If a bin holds more points than this, all bins of its tile are halved again. Not measured.
  static constexpr int fullest_bin = 16;
  /// [bins] Largest number of bins of a tile for each of its sites. This limit bounds the memory if sites are
  /// clustered. Not measured.
  static constexpr int most_bins_per_site = 64;
  /// [1] A tile has 2^k x 2^k bins, and k is at most this number: the numbers and counts of 2^24 bins fit into 32 bits.
  /// No measured case reaches this bound.
  static constexpr int finest_bin_bits = 12;
};

} // namespace trime::mesh
