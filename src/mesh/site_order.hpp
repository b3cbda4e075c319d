// SPDX-License-Identifier: BSD-3-Clause
// Computes the order of the owned sites: by tile, then by bin, then by coordinates.
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

/// Compares two sites of the same bin by coordinates. Of sites with equal coordinates, the first in this order is kept:
/// a boundary site or a fixed point, otherwise the site that was pushed most often.
bool precedes(const Site& a, const Site& b);

/// @brief Finds the new order of sites in two steps, group() and sort(). After that, for_each() gives the old index of
/// each site until forget() is called; afterwards only the number of sites in each tile is known.
///
/// The type `Sites` is one of the classes in mesh/site_sources.hpp.
class SiteOrder {
public:
  LocalIndex first_tile() const { return first_tile_; }
  LocalIndex last_tile() const { return last_tile_; }

  /// Groups the sites by tile.
  /// @pre each site lies in one of the tiles [first_tile, last_tile)
  template <class Sites>
  void group(const TileGrid& grid, const Sites& sites, LocalIndex first_tile, LocalIndex last_tile);
  bool is_grouped() const { return !tile_start_.empty(); }
  /// Returns the number of sites that are grouped.
  LocalIndex grouped() const { return static_cast<LocalIndex>(order_.size()); }
  /// Returns the suitable numbers of bins, as BinnedPoints::suitable_bin_bits.
  /// @pre these sites are grouped
  std::vector<std::uint8_t> suitable_bin_bits(const TileGrid& grid, std::span<const Site> sites) const;
  /// @brief Sorts the sites of each tile by bin, drops all but one of several sites at equal coordinates, and sets the
  /// ranges of the bins. Returns how many sites were dropped.
  /// @pre group() was called with these sites; bins.own() was called for these tiles
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
  /// Calls move(k, from) for each site: k is its index in the new order, `from` its old index. Uses all threads.
  template <class Move>
  void for_each(const Move& move) const;
  /// Returns the new index of each site by its old index; -1 for dropped sites.
  void list_new_indices(LocalIndex before, std::vector<LocalIndex>& new_index) const;
  /// Frees the list of old indices.
  /// @post for_each and list_new_indices must not be called
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
  std::vector<LocalIndex> kept_; // index of the first site of each tile in the new order, and the end
  // While sites are sorted, order_ contains their old indices, and tile_start_ the index in order_ at which each tile
  // begins.
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
