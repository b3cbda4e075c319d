// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/site_order.hpp"

#include "mesh/rules.hpp"
#include "mesh/site_sources.hpp"
#include "trime/core/error.hpp"
#include "trime/core/types.hpp"

#include <algorithm>
#include <array>

namespace trime::mesh {
namespace {

using geometry::Vec2;

// [points] Mean number of sites in the bin of a site at most: the bins of a tile, halved as often as needed, then
// hold 1.7 to 7 sites, mostly 3.3.
constexpr double most_in_bin = 7;
constexpr int bins_per_site = 4; // [bins] Largest number of bins of a tile for each site, unless a bin is too full

template <class Sites>
bool precedes(const Sites& sites, LocalIndex i, LocalIndex j) {
  const Vec2 a = sites.position(i), b = sites.position(j);
  if (!(a == b))
    return geometry::lexicographically_less(a, b);
  const std::int32_t boundary_a = sites.boundary(i), boundary_b = sites.boundary(j);
  if ((boundary_a == free_site) != (boundary_b == free_site))
    return boundary_b == free_site;
  if (boundary_a != boundary_b)
    return boundary_a > boundary_b;
  const std::int32_t pushes_a = sites.pushes(i), pushes_b = sites.pushes(j);
  return pushes_a != pushes_b ? pushes_a > pushes_b : geometry::lexicographically_less(sites.lead(i), sites.lead(j));
}

} // namespace

bool precedes(const Site& a, const Site& b) {
  const std::array<Site, 2> both{a, b};
  return precedes(ListedSites(both), 0, 1);
}

template <class Sites>
void SiteOrder::group(const TileGrid& grid, const Sites& sites, LocalIndex first_tile, LocalIndex last_tile) {
  first_tile_ = first_tile;
  last_tile_ = last_tile;
  const LocalIndex tiles = last_tile - first_tile;
  const std::ptrdiff_t n = sites.size();
  const int parts = std::max(1, thread_count());
  // counts[part][tile]: each part is a contiguous piece of the input, so the order is stable for any thread count.
  std::vector<LocalIndex> counts(static_cast<std::size_t>(parts) * at(tiles), 0);
  const auto for_each_of_part = [&](std::ptrdiff_t part, const auto& visit) {
    LocalIndex* of_tile = counts.data() + part * tiles;
    for (std::ptrdiff_t item = n * part / parts; item < n * (part + 1) / parts; ++item)
      if (const LocalIndex i = static_cast<LocalIndex>(item); sites.stays(i)) {
        const LocalIndex tile = grid.tile_at(sites.home(i));
        TRIME_ASSERT(tile >= first_tile_ && tile < last_tile_,
                     "a site of tile {} was given to the owner of the tiles {}..{}", tile, first_tile_, last_tile_);
        visit(i, of_tile[tile - first_tile_]);
      }
  };
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    for_each_of_part(part, [](LocalIndex, LocalIndex& count) { ++count; });
  });
  tile_start_.assign(at(tiles) + 1, 0);
  LocalIndex running = 0;
  for (LocalIndex t = 0; t < tiles; ++t) {
    tile_start_[at(t)] = running;
    for (int part = 0; part < parts; ++part) {
      LocalIndex& count = counts[static_cast<std::size_t>(part) * at(tiles) + at(t)];
      const LocalIndex here = count;
      count = running;
      running += here;
    }
  }
  tile_start_[at(tiles)] = running;
  order_.resize(at(running));
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    for_each_of_part(part, [&](LocalIndex i, LocalIndex& next) { order_[at(next++)] = i; });
  });
}

std::vector<std::uint8_t> SiteOrder::suitable_bin_bits(const TileGrid& grid, std::span<const Site> sites) const {
  std::vector<std::uint8_t> bits(at(last_tile_ - first_tile_));
  thread_loop(std::ssize(bits), 1, [&](std::ptrdiff_t tile, int) {
    const auto t = static_cast<std::size_t>(tile);
    bits[t] = static_cast<std::uint8_t>(suitable_bin_bits(grid, sites, t));
  });
  return bits;
}

/// Counts the sites in each bin of the t-th tile, if it has 2^bits x 2^bits bins.
std::vector<std::int64_t> SiteOrder::count_in_bins(const TileGrid& grid, std::span<const Site> sites, std::size_t t,
                                                   int bits) const {
  std::vector<std::int64_t> count(std::size_t{1} << (2 * bits), 0);
  for (LocalIndex k = tile_start_[t]; k < tile_start_[t + 1]; ++k)
    ++count[static_cast<std::size_t>(
        grid.bin_at(sites[at(order_[at(k)])].position, first_tile_ + static_cast<LocalIndex>(t), bits))];
  return count;
}

/// For the t-th tile.
int SiteOrder::suitable_bin_bits(const TileGrid& grid, std::span<const Site> sites, std::size_t t) const {
  const std::int64_t n = tile_start_[t + 1] - tile_start_[t];
  int bits = 0;
  const LocalIndex tile = first_tile_ + static_cast<LocalIndex>(t);
  while (bits < grid.most_bin_bits(tile) && std::int64_t{4} << (2 * bits) <= bins_per_site * n)
    ++bits;
  std::vector<std::int64_t> count = count_in_bins(grid, sites, t, bits);
  while (bits < grid.most_bin_bits(tile) && std::int64_t{4} << (2 * bits) <= MeshRules::most_bins_per_site * n &&
         *std::max_element(count.begin(), count.end()) > MeshRules::fullest_bin)
    count = count_in_bins(grid, sites, t, ++bits);
  int suitable = bits; // the smallest that will do, coming from the largest
  for (; bits >= 0; --bits) {
    std::int64_t pairs = 0;
    for (const std::int64_t c : count)
      pairs += c * c;
    if (static_cast<double>(pairs) > most_in_bin * static_cast<double>(n) ||
        *std::max_element(count.begin(), count.end()) > MeshRules::fullest_bin)
      break;
    suitable = bits;
    if (bits > 0) { // four bins become one
      std::vector<std::int64_t> coarse(count.size() / 4, 0);
      for (std::size_t b = 0; b < count.size(); ++b)
        coarse[((b >> (bits + 1)) << (bits - 1)) | ((b & ((std::size_t{1} << bits) - 1)) >> 1)] += count[b];
      count = std::move(coarse);
    }
  }
  return suitable;
}

template <class Sites>
LocalIndex SiteOrder::sort(const Sites& sites, KnownBins& bins) {
  const LocalIndex tiles = last_tile_ - first_tile_;
  kept_.assign(at(tiles) + 1, 0);
  PerThread<TileWork> of_thread;
  thread_loop(tiles, 1, [&](std::ptrdiff_t tile, int thread) {
    const auto t = static_cast<LocalIndex>(tile);
    kept_[at(t) + 1] = sort_tile(sites, bins.grid(), t, bins.owned_tile(t), of_thread[thread]);
  });
  for (std::size_t t = 1; t < kept_.size(); ++t)
    kept_[t] += kept_[t - 1];
  thread_loop(tiles, 64, [&](std::ptrdiff_t tile, int) {
    const auto t = static_cast<LocalIndex>(tile);
    const LocalIndex shift = kept_[at(t)] - tile_start_[at(t)]; // dropped sites close up
    if (shift == 0)
      return;
    const KnownBins::TileBins of_tile = bins.owned_tile(t);
    for (std::size_t b = 0; b < of_tile.begin.size(); ++b) {
      of_tile.begin[b] += shift;
      of_tile.end[b] += shift;
    }
  });
  return static_cast<LocalIndex>(order_.size()) - kept_.back();
}

/// Sorts the t-th tile's piece of order_ by bin (counting, then by coordinates inside a bin); returns the number of
/// sites kept.
template <class Sites>
LocalIndex SiteOrder::sort_tile(const Sites& sites, const TileGrid& grid, LocalIndex t, KnownBins::TileBins bins,
                                TileWork& work) {
  const LocalIndex begin = tile_start_[at(t)], end = tile_start_[at(t) + 1];
  LocalIndex* const bin_end = bins.end.data();
  std::fill(bins.end.begin(), bins.end.end(), 0);
  work.bin.resize(at(end - begin));
  work.sorted.resize(at(end - begin));
  for (LocalIndex k = begin; k < end; ++k) {
    const int bin = grid.bin_at(sites.home(order_[at(k)]), first_tile_ + t, bins.bits);
    work.bin[at(k - begin)] = bin;
    ++bin_end[bin];
  }
  LocalIndex next = begin;
  for (std::size_t b = 0; b < bins.end.size(); ++b) { // bin_end is the running end of each bin while it fills
    const LocalIndex count = bin_end[b];
    bins.begin[b] = bin_end[b] = next;
    next += count;
  }
  for (LocalIndex k = begin; k < end; ++k)
    work.sorted[at(bin_end[work.bin[at(k - begin)]]++ - begin)] = order_[at(k)];
  drop_duplicates(sites, begin, bins, work);
  return (bins.end.empty() ? begin : bins.end.back()) - begin;
}

/// From work.sorted back to order_, from `first` on, each bin sorted and without duplicates; sets the ranges of the
/// bins.
template <class Sites>
void SiteOrder::drop_duplicates(const Sites& sites, LocalIndex first, KnownBins::TileBins bins, TileWork& work) {
  const auto before = [&](LocalIndex i, LocalIndex j) { return precedes(sites, i, j); };
  LocalIndex next = first;
  for (std::size_t b = 0; b < bins.begin.size(); ++b) {
    const auto low = work.sorted.begin() + (bins.begin[b] - first), high = work.sorted.begin() + (bins.end[b] - first);
    std::sort(low, high, before);
    bins.begin[b] = next;
    for (auto it = low; it != high; ++it)
      if (!Sites::drops_equal || it == low || !(sites.position(*it) == sites.position(*(it - 1))))
        order_[at(next++)] = *it;
    bins.end[b] = next;
  }
}

void SiteOrder::edit(const IndexShift& shift, std::span<const BinRef> come, KnownBins& bins) {
  auto next_gone = shift.gone().begin();
  auto next_come = come.begin();
  LocalIndex moved = 0, tile_end = kept_.front(); // as it was
  for (std::size_t t = 0; t + 1 < kept_.size(); ++t) {
    kept_[t] = tile_end + moved;
    tile_end = kept_[t + 1];
    const LocalIndex tile = first_tile_ + static_cast<LocalIndex>(t);
    const bool comes = next_come != come.end() && next_come->tile == tile;
    const bool goes = next_gone != shift.gone().end() && *next_gone < tile_end;
    if (!comes && !goes && moved == 0)
      continue;
    const KnownBins::TileBins of_tile = bins.owned_tile(static_cast<LocalIndex>(t));
    for (std::size_t b = 0; b < of_tile.begin.size(); ++b) {
      const LocalIndex bin_end = of_tile.end[b];
      of_tile.begin[b] += moved;
      for (; goes && next_gone != shift.gone().end() && *next_gone < bin_end; ++next_gone)
        --moved;
      for (; comes && next_come != come.end() && *next_come == BinRef{tile, static_cast<std::int32_t>(b)}; ++next_come)
        ++moved;
      of_tile.end[b] = bin_end + moved;
    }
  }
  kept_.back() = tile_end + moved;
}

void SiteOrder::list_new_indices(LocalIndex before, std::vector<LocalIndex>& new_index) const {
  new_index.assign(at(before), -1);
  for_each([&](std::size_t k, LocalIndex from) { new_index[at(from)] = static_cast<LocalIndex>(k); });
}

void SiteOrder::forget() {
  release(order_);
  release(tile_start_);
}

template void SiteOrder::group(const TileGrid&, const ListedSites&, LocalIndex, LocalIndex);
template void SiteOrder::group(const TileGrid&, const MovedSites&, LocalIndex, LocalIndex);
template void SiteOrder::group(const TileGrid&, const HomedSites&, LocalIndex, LocalIndex);
template LocalIndex SiteOrder::sort(const ListedSites&, KnownBins&);
template LocalIndex SiteOrder::sort(const MovedSites&, KnownBins&);
template LocalIndex SiteOrder::sort(const HomedSites&, KnownBins&);

} // namespace trime::mesh
