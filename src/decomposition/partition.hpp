// SPDX-License-Identifier: BSD-3-Clause
// Who owns which tiles: one contiguous range of tile numbers (Hilbert order) per rank.
#pragma once

#include "trime/core/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::decomposition {

/// Replicated: ranks + 1 integers. Ranks may own nothing.
class Partition {
public:
  /// @brief Ranges of about equal weight. Tile t goes to rank floor(ranks * m / total), m being the weight before the
  /// middle of t: monotone, so the ranges are contiguous. If all weights are zero the tiles are shared out evenly.
  Partition(std::span<const std::int64_t> tile_weights, int ranks);
  /// Tiles of equal weight.
  Partition(LocalIndex tiles, int ranks);

  LocalIndex first_tile(int rank) const { return starts_[static_cast<std::size_t>(rank)]; }
  LocalIndex last_tile(int rank) const { return starts_[static_cast<std::size_t>(rank) + 1]; }
  /// O(log ranks).
  int owner(LocalIndex tile) const;
  std::size_t memory_bytes() const { return starts_.capacity() * sizeof(LocalIndex); }
  int ranks() const { return static_cast<int>(starts_.size()) - 1; }

private:
  std::vector<LocalIndex> starts_;
};

} // namespace trime::decomposition
