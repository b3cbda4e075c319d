// SPDX-License-Identifier: BSD-3-Clause
// What is known of each tile between two sorts: how far its sites have come since they were sorted into bins, and a
// mark.
#pragma once

#include "mesh/known_bins.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// A bound on how far any site of any rank has moved since the sites were sorted.
struct DriftBound {
  double distance = 0; ///< domain units
  /// Distance over the shortest side of the tile into which the site was sorted and of its neighbours; below 1.
  double in_sides = 0;
};

/// For each known tile, by its number in KnownBins, a bound on how far a site that was sorted into it has moved since.
class Drifts {
public:
  double of(LocalIndex tile) const { return of_tile_[static_cast<std::size_t>(tile)]; }
  void set(LocalIndex tile, double distance) { of_tile_[static_cast<std::size_t>(tile)] = distance; }
  std::span<const double> of_tiles() const { return of_tile_; }
  /// The bound for all tiles of all ranks, which is the only bound for tiles without known bins.
  const DriftBound& largest() const { return largest_; }
  void set_largest(const DriftBound& bound) { largest_ = bound; }

  /// Sets all bounds to 0 after sites were sorted. @param tiles number of owned tiles
  void forget(LocalIndex tiles);
  /// Sets how many tiles are known. A new tile gets the bound for all tiles.
  void make_room(LocalIndex tiles) { of_tile_.resize(static_cast<std::size_t>(tiles), largest_.distance); }
  /// @brief Returns how much farther a search around `center` must go in the bins. O(tiles that the search meets). It
  /// depends on the drift of nearby tiles only, so sites that move far in coarse regions do not slow down dense ones.
  double margin(geometry::Vec2 center, double reach, const KnownBins& bins) const;

private:
  std::vector<double> of_tile_;
  DriftBound largest_;
};

/// @brief A mark of each known tile, by its number in KnownBins, that its owner sets. Other ranks that know the tile
/// receive the mark with the places of its sites; until then they treat it as set. The code that sets a mark decides
/// what it means.
class TileMarks {
public:
  bool of(LocalIndex tile) const { return marks_[static_cast<std::size_t>(tile)] != 0; }
  void set(LocalIndex tile, bool mark) { marks_[static_cast<std::size_t>(tile)] = mark; }

  /// Sets all marks after sites were sorted. @param tiles number of owned tiles
  void forget(LocalIndex tiles) { marks_.assign(static_cast<std::size_t>(tiles), 1); }
  /// Sets how many tiles are known, and marks the new ones.
  void make_room(LocalIndex tiles) { marks_.resize(static_cast<std::size_t>(tiles), 1); }

private:
  std::vector<std::uint8_t> marks_;
};

} // namespace trime::mesh
