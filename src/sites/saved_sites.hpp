// SPDX-License-Identifier: BSD-3-Clause
// The sites of a checkpoint, from which any number of ranks can restore a state. Plain data.
#pragma once

#include "mesh/drifts.hpp"
#include "mesh/site.hpp"
#include "mesh/tile_tree.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace trime::sites {

/// The tiles of a checkpoint, in the order of the curve; the same on all ranks.
struct SavedTiles {
  std::vector<mesh::Tile> tiles;
  std::vector<std::int64_t> counts;    ///< number of sites that were sorted into each tile
  std::vector<double> drifts;          ///< how far these sites may have moved since then, domain units
  std::vector<std::uint64_t> activity; ///< activity of each tile in the sweeps, see TileActivity
  mesh::DriftBound largest;            ///< bound on the drifts
};

/// Sites of consecutive tiles, tile by tile. They may have left the tiles into which they were sorted.
struct SavedSites {
  mesh::SiteList sites;
  std::vector<double> sizes; ///< h of each site; empty if the size is uniform
};

/// Fetches rows [first, first + count) of all sites. Local. @throws FileError
using SiteLoader = std::function<SavedSites(std::int64_t first, std::int64_t count)>;

} // namespace trime::sites
