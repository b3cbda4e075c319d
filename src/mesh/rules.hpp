// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module mesh.
#pragma once

namespace trime::mesh {

/// The numbers of mesh: how large cells, tiles and bins are.
struct MeshRules {
  /// [points] A cell of the container grid, and a bin, hold about so many.
  static constexpr double points_per_cell = 3.3;
  /// [points] A tile holds about as many as 16 x 16 cells, a unit of work for one thread.
  static constexpr double points_per_tile = 845;
  /// [points] A tile holds no fewer than 4 x 4 cells, where there are few points to share out.
  static constexpr double fewest_per_tile = 53;
  /// [1] A tile may hold so many times the wanted points before its side is halved: between 1 and 2, so that the mean
  /// over all container sizes is about what is wanted.
  static constexpr double fullest_tile = 1.5;
  /// [tiles] There are about so many at least, so that ranks and threads get equal shares.
  static constexpr double wanted_tiles = 256;
  /// [tiles] The same where the density varies: the densest tiles hold up to a hundred times the mean.
  static constexpr double wanted_tiles_graded = 16384;
  /// [points] Mean number of sites in the bin of a site at most: the bins of a tile, halved as often as needed, then
  /// hold 1.7 to 7 sites, mostly 3.3.
  static constexpr double most_in_bin = 7;
  /// [bins] A tile has so many bins for each site at most, however its sites are clustered: it bounds the memory.
  static constexpr int bins_per_site = 4;
  /// [1] A tile has 2^k x 2^k bins with k at most this: 2^24 bins, whose numbers and counts fit into 32 bits.
  static constexpr int finest_bin_bits = 12;
};

} // namespace trime::mesh
