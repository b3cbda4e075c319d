// SPDX-License-Identifier: BSD-3-Clause
// Two kinds of data about each tile between two sortings of the sites: how far its sites have moved since they were
// sorted into bins (the drift), and a mark.
#pragma once

#include "mesh/known_bins.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// An upper bound on how far any site of any rank has moved since the last sorting of the sites.
struct DriftBound {
  double distance = 0; ///< distance in domain units
  /// The distance divided by the shortest side of the site's tile and of the tiles next to it; below 1.
  double in_sides = 0;
};

/// For each known tile, an upper bound on how far any of its sites has moved since the last sorting. Tiles are numbered
/// as in KnownBins.
class Drifts {
public:
  double of(LocalIndex tile) const { return of_tile_[static_cast<std::size_t>(tile)]; }
  void set(LocalIndex tile, double distance) { of_tile_[static_cast<std::size_t>(tile)] = distance; }
  std::span<const double> of_tiles() const { return of_tile_; }
  /// Returns the bound for all tiles of all ranks. This is the only bound for tiles without known bins.
  const DriftBound& largest() const { return largest_; }
  void set_largest(const DriftBound& bound) { largest_ = bound; }

  /// Sets all bounds to 0 after the sites were sorted.
  /// @param tiles number of owned tiles
  void forget(LocalIndex tiles);
  /// Sets the number of known tiles. A new tile gets the bound for all tiles.
  void make_room(LocalIndex tiles) { of_tile_.resize(static_cast<std::size_t>(tiles), largest_.distance); }
  /// @brief Returns how much farther a search around `center` must go in the bins. Cost: O(tiles that the search
  /// meets). The result depends on the drift of nearby tiles only, so sites that move far in coarse regions do not slow
  /// down searches in dense ones.
  double margin(geometry::Vec2 center, double reach, const KnownBins& bins) const;

private:
  std::vector<double> of_tile_;
  DriftBound largest_;
};

/// @brief One mark for each known tile, numbered as in KnownBins. The owner of the tile sets the mark. Other ranks that
/// know the tile receive the mark together with the places of its sites; until then they treat it as set. The meaning
/// of the mark is up to the caller.
class TileMarks {
public:
  bool of(LocalIndex tile) const { return marks_[static_cast<std::size_t>(tile)] != 0; }
  void set(LocalIndex tile, bool mark) { marks_[static_cast<std::size_t>(tile)] = mark; }

  /// Sets all marks after the sites were sorted.
  /// @param tiles number of owned tiles
  void forget(LocalIndex tiles) { marks_.assign(static_cast<std::size_t>(tiles), 1); }
  /// Sets the number of known tiles, and the marks of the new ones.
  void make_room(LocalIndex tiles) { marks_.resize(static_cast<std::size_t>(tiles), 1); }

private:
  std::vector<std::uint8_t> marks_;
};

} // namespace trime::mesh
