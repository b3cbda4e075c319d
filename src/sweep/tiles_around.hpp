// SPDX-License-Identifier: BSD-3-Clause
// Finds the tiles next to each tile of a rank, and which tiles have no tile of another rank next to them.
#pragma once

#include "mesh/binned_points.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::sweep {

/// Where an owned tile lies. Inner tiles have only tiles of this rank around them, so they can be swept while the
/// ghosts are on their way.
enum class TilePlace : std::uint8_t { inner, at_border };

/// @brief Holds for each owned tile the tiles around it, including itself, by the numbers of KnownBins. Tiles across a
/// periodic border do not count. Valid until sites are sorted.
///
/// Two tiles that are not next to each other are at least as far apart as the narrowest() of either.
class TilesAround {
public:
  TilesAround() = default;
  /// @pre some bin of each tile next to an owned one is known, unless the owned one is at a periodic border
  explicit TilesAround(const mesh::BinnedPoints& points);

  std::size_t size() const { return places_.size(); }
  /// Returns the tiles around the t-th owned tile.
  std::span<const LocalIndex> of(std::size_t t) const {
    return std::span(tiles_).subspan(first_[t], first_[t + 1] - first_[t]);
  }
  TilePlace place(std::size_t t) const { return places_[t]; }
  /// Returns the shortest side of these tiles in domain units.
  double narrowest(std::size_t t) const { return narrowest_[t]; }

private:
  std::vector<std::size_t> first_; // by owned tile, where its tiles begin in tiles_; then the end
  std::vector<LocalIndex> tiles_;
  std::vector<TilePlace> places_;
  std::vector<double> narrowest_;
};

} // namespace trime::sweep
