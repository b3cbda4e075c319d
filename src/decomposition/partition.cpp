// SPDX-License-Identifier: BSD-3-Clause
#include "decomposition/partition.hpp"

#include <algorithm>
#include <numeric>

namespace trime::decomposition {

Partition::Partition(std::span<const std::int64_t> tile_weights, int ranks)
    : starts_(static_cast<std::size_t>(ranks) + 1, 0) {
  const std::int64_t total = std::accumulate(tile_weights.begin(), tile_weights.end(), std::int64_t{0});
  if (total == 0) {
    *this = Partition(static_cast<LocalIndex>(tile_weights.size()), ranks);
    return;
  }
  std::fill(starts_.begin(), starts_.end(), static_cast<LocalIndex>(tile_weights.size()));
  std::int64_t before = 0;
  int rank = -1;
  for (std::size_t t = 0; t < tile_weights.size(); ++t) {
    const double middle = static_cast<double>(before) + 0.5 * static_cast<double>(tile_weights[t]);
    const int owner = std::min(ranks - 1, static_cast<int>(middle / static_cast<double>(total) * ranks));
    while (rank < owner)
      starts_[static_cast<std::size_t>(++rank)] = static_cast<LocalIndex>(t);
    before += tile_weights[t];
  }
  starts_.front() = 0;
}

Partition::Partition(LocalIndex tiles, int ranks) : starts_(static_cast<std::size_t>(ranks) + 1, 0) {
  for (int rank = 0; rank <= ranks; ++rank)
    starts_[static_cast<std::size_t>(rank)] = static_cast<LocalIndex>(static_cast<std::int64_t>(tiles) * rank / ranks);
}

int Partition::owner(LocalIndex tile) const {
  return static_cast<int>(std::upper_bound(starts_.begin() + 1, starts_.end() - 1, tile) - starts_.begin()) - 1;
}

} // namespace trime::decomposition
