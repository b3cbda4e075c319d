// SPDX-License-Identifier: BSD-3-Clause
// The tiles beside the tiles of a rank, and which of these have none of another rank beside them.
#pragma once

#include "mesh/binned_points.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::sweep {

/// Where an owned tile lies. Inner tiles have only tiles of this rank around them: they can be swept while the ghosts
/// are on their way.
enum class TilePlace : std::uint8_t { inner, at_border };

/// @brief For each owned tile the tiles around it, itself among them, by the numbers of KnownBins: the owned ones come
/// first in their order. Across a periodic border nothing is beside a tile. Holds until sites are sorted.
///
/// Two tiles that are not beside each other are as far apart as the narrowest() of either.
class TilesAround {
public:
  TilesAround() = default;
  /// @pre some bin of each tile beside an owned one is known, unless the owned one is at a periodic border
  explicit TilesAround(const mesh::BinnedPoints& points);

  std::size_t size() const { return places_.size(); }
  /// Of the t-th owned tile.
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
