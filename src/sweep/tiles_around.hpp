// SPDX-License-Identifier: BSD-3-Clause
// The tiles next to the tiles of a rank, and which tiles of the rank have no tile of another rank next to them.
#pragma once

#include "mesh/binned_points.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::sweep {

/// Where an owned tile lies. Inner tiles have only tiles of this rank around them: they can be swept while the ghosts
/// are on their way.
enum class TilePlace : std::uint8_t { inner, at_border };

/// @brief Returns for each owned tile the tiles around it, including itself, by the numbers of KnownBins: first the
/// owned ones, in their order. Across a periodic border nothing is next to a tile. Valid until sites are sorted.
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
  /// The shortest side of these tiles, domain units.
  double narrowest(std::size_t t) const { return narrowest_[t]; }

private:
  std::vector<std::size_t> first_; // into tiles_, by owned tile, and its end
  std::vector<LocalIndex> tiles_;
  std::vector<TilePlace> places_;
  std::vector<double> narrowest_;
};

} // namespace trime::sweep
