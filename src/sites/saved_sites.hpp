// SPDX-License-Identifier: BSD-3-Clause
// The sites of a checkpoint: what a state is restored from, on any number of ranks. Plain data.
#pragma once

#include "mesh/drifts.hpp"
#include "mesh/site.hpp"
#include "mesh/tile_tree.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace trime::sites {

/// By tile, along the curve; the same on all ranks.
struct SavedTiles {
  std::vector<mesh::Tile> tiles;
  std::vector<std::int64_t> counts;    ///< sites that were sorted into each
  std::vector<double> drifts;          ///< how far they may have come since, domain units
  std::vector<std::uint64_t> activity; ///< what the sweeps know of each, see TileActivity
  mesh::DriftBound largest;            ///< bound on the drifts
};

/// Sites of neighbouring tiles, tile by tile; they may have left the tiles that they were sorted into.
struct SavedSites {
  mesh::SiteList sites;
  std::vector<double> sizes; ///< h of each; empty: the size is uniform
};

/// Fetches rows [first, first + count) of all sites. Local. @throws FileError
using SiteLoader = std::function<SavedSites(std::int64_t first, std::int64_t count)>;

} // namespace trime::sites
