// SPDX-License-Identifier: BSD-3-Clause
// The order of the owned sites: by tile, then by bin, then by place.
#pragma once

#include "core/thread_loop.hpp"
#include "mesh/index_shift.hpp"
#include "mesh/known_bins.hpp"
#include "mesh/site.hpp"
#include "mesh/tile_grid.hpp"
#include "trime/core/types.hpp"

#include <cstdint>
#include <iterator>
#include <span>
#include <vector>

namespace trime::mesh {

/// Orders the sites of a bin by place. Of sites at one place the first is kept: the boundary site or the fixed point,
/// otherwise the one that was pushed most often.
bool precedes(const Site& a, const Site& b);

/// @brief Finds the new order of sites in two steps, group() and sort(). Then for_each() shows where each site comes
/// from, until forget() is called; after that only the number of sites of each tile is known.
///
/// `Sites` is one of the classes of mesh/site_sources.hpp.
class SiteOrder {
public:
  LocalIndex first_tile() const { return first_tile_; }
  LocalIndex last_tile() const { return last_tile_; }

  /// Groups the sites by tile. @pre each lies in one of the tiles [first_tile, last_tile)
  template <class Sites>
  void group(const TileGrid& grid, const Sites& sites, LocalIndex first_tile, LocalIndex last_tile);
  bool is_grouped() const { return !tile_start_.empty(); }
  /// Returns the number of sites that are grouped.
  LocalIndex grouped() const { return static_cast<LocalIndex>(order_.size()); }
  /// See BinnedPoints::suitable_bin_bits. @pre these sites are grouped
  std::vector<std::uint8_t> suitable_bin_bits(const TileGrid& grid, std::span<const Site> sites) const;
  /// @brief Sorts the sites of each tile by bin, drops all but one at equal places, and sets the ranges of the bins.
  /// Returns how many were dropped. @pre the same sites are grouped; bins.own() was called for these tiles
  template <class Sites>
  LocalIndex sort(const Sites& sites, KnownBins& bins);

  /// @brief Updates the ranges of tiles and bins after sites were removed and inserted, without sorting.
  /// @param come the bin of each inserted site, in the order of the shift
  void edit(const IndexShift& shift, std::span<const BinRef> come, KnownBins& bins);

  /// Returns the number of sorted sites, without the dropped ones.
  LocalIndex size() const { return kept_.back(); }
  SiteRange of_tile(LocalIndex tile) const {
    const auto t = static_cast<std::size_t>(tile - first_tile_);
    return {kept_[t], kept_[t + 1]};
  }
  /// Calls move(k, from) for the k-th site in the new order, which is the site `from` in the old one. Uses all threads.
  template <class Move>
  void for_each(const Move& move) const;
  /// Returns the index in the new order of each site before sorting, -1 if it was dropped.
  void list_new_indices(LocalIndex before, std::vector<LocalIndex>& new_index) const;
  /// Frees the list of old indices. @post of for_each and list_new_indices nothing may be asked
  void forget();

private:
  struct TileWork {
    std::vector<int> bin;
    std::vector<LocalIndex> sorted;
  };
  std::vector<std::int64_t> count_in_bins(const TileGrid& grid, std::span<const Site> sites, std::size_t t,
                                          int bits) const;
  int suitable_bin_bits(const TileGrid& grid, std::span<const Site> sites, std::size_t t) const;
  template <class Sites>
  LocalIndex sort_tile(const Sites& sites, const TileGrid& grid, LocalIndex t, KnownBins::TileBins bins,
                       TileWork& work);
  template <class Sites>
  void drop_duplicates(const Sites& sites, LocalIndex first, KnownBins::TileBins bins, TileWork& work);

  LocalIndex first_tile_ = 0, last_tile_ = 0;
  std::vector<LocalIndex> kept_; // first site of each tile in the new order, and the end
  // While sites are sorted, order_ holds their old indices, and tile_start_ where each tile begins in it.
  std::vector<LocalIndex> tile_start_;
  UnsetVector<LocalIndex> order_;
};

template <class Move>
void SiteOrder::for_each(const Move& move) const {
  thread_loop(std::ssize(kept_) - 1, 1, [&](std::ptrdiff_t tile, int) {
    const auto t = static_cast<std::size_t>(tile);
    const LocalIndex shift = kept_[t] - tile_start_[t];
    for (LocalIndex k = kept_[t]; k < kept_[t + 1]; ++k)
      move(static_cast<std::size_t>(k), order_[static_cast<std::size_t>(k - shift)]);
  });
}

} // namespace trime::mesh
