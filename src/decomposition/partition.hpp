// SPDX-License-Identifier: BSD-3-Clause
// Decides which rank owns which tiles: each rank owns one contiguous range of tile numbers, in the order of the Hilbert
// curve.
#pragma once

#include "trime/core/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::decomposition {

/// The ranges of all ranks, stored on each rank as ranks + 1 integers. A range may be empty.
class Partition {
public:
  /// @brief Makes ranges of about equal weight. Tile t goes to rank floor(ranks * m / total), where m is the weight
  /// before the middle of t. Because m increases with t, the ranges are contiguous. If all weights are zero, all ranks
  /// get about the same number of tiles.
  Partition(std::span<const std::int64_t> tile_weights, int ranks);
  /// Makes ranges with about the same number of tiles.
  Partition(LocalIndex tiles, int ranks);

  LocalIndex first_tile(int rank) const { return starts_[static_cast<std::size_t>(rank)]; }
  LocalIndex last_tile(int rank) const { return starts_[static_cast<std::size_t>(rank) + 1]; }
  /// Returns the owner of a tile. Cost: O(log ranks).
  int owner(LocalIndex tile) const;
  std::size_t memory_bytes() const { return starts_.capacity() * sizeof(LocalIndex); }
  int ranks() const { return static_cast<int>(starts_.size()) - 1; }

private:
  std::vector<LocalIndex> starts_;
};

} // namespace trime::decomposition
