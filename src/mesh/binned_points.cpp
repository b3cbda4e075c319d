// SPDX-License-Identifier: BSD-3-Clause
#include "trime/mesh/binned_points.hpp"

#include "trime/core/error.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <numeric>

namespace trime::mesh {
namespace {

using geometry::Vec2;

constexpr double most_in_bin = 7; // mean number of sites in the bin of a site: levels then give 1.7 to 7, mostly 3.3
constexpr int bins_per_site = 4;  // at most, however the sites of a tile are clustered

} // namespace

BinnedPoints::BinnedPoints(const TileGrid& grid)
    : grid_(&grid), images_(grid.images()),
      tile_block_(static_cast<std::size_t>(grid.tile_count()) * static_cast<std::size_t>(images_), -1) {}

LocalIndex BinnedPoints::assign_owned(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile,
                                      std::vector<LocalIndex>* new_index) {
  const LocalIndex tiles = last_tile - first_tile;
  first_tile_ = first_tile;
  last_tile_ = last_tile;
  make_owned_blocks();
  if (largest_drift_ > 0 || drift_.empty()) {
    drift_.assign(static_cast<std::size_t>(grid_->tile_count()), 0);
    largest_drift_ = 0;
  }
  sort_into_tiles(sites);
  kept_.assign(static_cast<std::size_t>(tiles) + 1, 0);
  thread_loop(tiles, 1, [&](std::ptrdiff_t t, int) {
    kept_[static_cast<std::size_t>(t) + 1] = sort_tile(sites, static_cast<LocalIndex>(t));
  });
  for (std::size_t t = 1; t < kept_.size(); ++t)
    kept_[t] += kept_[t - 1];
  owned_ = tiles > 0 ? kept_.back() : 0;

  positions_.resize(static_cast<std::size_t>(owned_));
  boundary_.resize(positions_.size());
  pushes_.resize(positions_.size());
  leads_.resize(positions_.size());
  if (new_index)
    new_index->assign(sites.size(), -1);
  thread_loop(tiles, 1, [&](std::ptrdiff_t tile, int) {
    const std::size_t t = static_cast<std::size_t>(tile);
    const LocalIndex shift = kept_[t] - tile_start_[t]; // dropped sites close up
    const std::size_t first_bin = blocks_[t].first_bin, bins = std::size_t{1} << (2 * blocks_[t].bits);
    for (std::size_t b = first_bin; b < first_bin + bins; ++b) {
      bin_begin_[b] += shift;
      bin_end_[b] += shift;
    }
    for (LocalIndex k = kept_[t]; k < kept_[t + 1]; ++k) {
      const LocalIndex from = order_[static_cast<std::size_t>(k - shift)];
      const Site& s = sites[static_cast<std::size_t>(from)];
      positions_[static_cast<std::size_t>(k)] = s.position;
      boundary_[static_cast<std::size_t>(k)] = s.boundary;
      pushes_[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::min(s.pushes, 255));
      leads_[static_cast<std::size_t>(k)] = s.lead;
      if (new_index)
        (*new_index)[static_cast<std::size_t>(from)] = k;
    }
  });
  return static_cast<LocalIndex>(sites.size()) - owned_;
}

void BinnedPoints::make_owned_blocks() {
  std::fill(tile_block_.begin(), tile_block_.end(), -1);
  blocks_.clear();
  std::size_t bins = 0;
  for (LocalIndex tile = first_tile_; tile < last_tile_; ++tile) {
    tile_block_[block_slot(tile, 0)] = static_cast<LocalIndex>(blocks_.size());
    blocks_.push_back({bins, grid_->bin_bits(tile), true});
    bins += static_cast<std::size_t>(grid_->bins_per_tile(tile));
  }
  owned_blocks_ = static_cast<LocalIndex>(blocks_.size());
  owned_bins_ = bins;
  bin_begin_.resize(bins);
  bin_end_.resize(bins);
  bin_known_.assign(bins, 1);
}

/// Fills order_ with the site indices grouped by tile (tile_start_) and key_ with the bin of each site.
void BinnedPoints::sort_into_tiles(std::span<const Site> sites) {
  const LocalIndex tiles = last_tile_ - first_tile_;
  const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(sites.size());
  const int parts = std::max(1, thread_count());
  key_.resize(sites.size());
  order_.resize(sites.size());
  tile_of_.resize(sites.size());
  sorted_.resize(sites.size());
  // counts[part][tile]: each part is a contiguous piece of the input, so the order is stable for any thread count.
  std::vector<LocalIndex> counts(static_cast<std::size_t>(parts) * tiles, 0);
  const auto part_begin = [&](int part) { return n * part / parts; };
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    LocalIndex* count = counts.data() + part * tiles;
    for (std::ptrdiff_t i = part_begin(static_cast<int>(part)); i < part_begin(static_cast<int>(part) + 1); ++i) {
      const TileGrid::Place place = grid_->place(sites[static_cast<std::size_t>(i)].position);
      TRIME_ASSERT(place.tile >= first_tile_ && place.tile < last_tile_, "site of tile {} given to the owner of {}..{}",
                   place.tile, first_tile_, last_tile_);
      key_[static_cast<std::size_t>(i)] = place.bin;
      tile_of_[static_cast<std::size_t>(i)] = place.tile - first_tile_;
      ++count[place.tile - first_tile_];
    }
  });
  tile_start_.assign(static_cast<std::size_t>(tiles) + 1, 0);
  LocalIndex running = 0;
  for (LocalIndex t = 0; t < tiles; ++t) {
    tile_start_[static_cast<std::size_t>(t)] = running;
    for (int part = 0; part < parts; ++part) {
      LocalIndex& count = counts[static_cast<std::size_t>(part) * tiles + t];
      const LocalIndex here = count;
      count = running;
      running += here;
    }
  }
  tile_start_[static_cast<std::size_t>(tiles)] = running;
  thread_loop(parts, 1, [&](std::ptrdiff_t part, int) {
    LocalIndex* next = counts.data() + part * tiles;
    for (std::ptrdiff_t i = part_begin(static_cast<int>(part)); i < part_begin(static_cast<int>(part) + 1); ++i)
      order_[static_cast<std::size_t>(next[tile_of_[static_cast<std::size_t>(i)]]++)] = static_cast<LocalIndex>(i);
  });
}

/// Sorts one tile's piece of order_ by bin (counting, then by coordinates inside a bin), drops duplicates, sets the
/// bins; returns the number of sites kept.
LocalIndex BinnedPoints::sort_tile(std::span<const Site> sites, LocalIndex tile) {
  const Block& block = blocks_[static_cast<std::size_t>(tile)];
  const std::size_t bins = std::size_t{1} << (2 * block.bits), first_bin = block.first_bin;
  const LocalIndex begin = tile_start_[static_cast<std::size_t>(tile)];
  const LocalIndex end = tile_start_[static_cast<std::size_t>(tile) + 1];
  LocalIndex* bin_end = bin_end_.data() + first_bin;
  const auto site = [&](LocalIndex i) -> const Site& { return sites[static_cast<std::size_t>(i)]; };
  const auto before = [&](LocalIndex i, LocalIndex j) {
    const Site &a = site(i), &b = site(j);
    if (!(a.position == b.position))
      return geometry::lexicographically_less(a.position, b.position);
    // Of equal sites the first is kept: the boundary site or the fixed one, else the one pushed most often.
    if ((a.boundary == free_site) != (b.boundary == free_site))
      return b.boundary == free_site;
    if (a.boundary != b.boundary)
      return a.boundary > b.boundary;
    return a.pushes != b.pushes ? a.pushes > b.pushes : geometry::lexicographically_less(a.lead, b.lead);
  };
  std::fill(bin_end, bin_end + bins, 0);
  for (LocalIndex k = begin; k < end; ++k)
    ++bin_end[key_[static_cast<std::size_t>(order_[static_cast<std::size_t>(k)])]];
  LocalIndex next = begin;
  for (std::size_t b = 0; b < bins; ++b) { // bin_end is the running end of each bin while it fills
    const LocalIndex count = bin_end[b];
    bin_begin_[first_bin + b] = bin_end[b] = next;
    next += count;
  }
  for (LocalIndex k = begin; k < end; ++k) {
    const LocalIndex i = order_[static_cast<std::size_t>(k)];
    sorted_[static_cast<std::size_t>(bin_end[key_[static_cast<std::size_t>(i)]]++)] = i;
  }
  next = begin;
  for (std::size_t b = 0; b < bins; ++b) {
    const auto first = sorted_.begin() + bin_begin_[first_bin + b], last = sorted_.begin() + bin_end[b];
    std::sort(first, last, before);
    bin_begin_[first_bin + b] = next;
    for (auto it = first; it != last; ++it)
      if (it == first || !(site(*it).position == site(*(it - 1)).position))
        order_[static_cast<std::size_t>(next++)] = *it;
    bin_end[b] = next;
  }
  return next - begin;
}

void BinnedPoints::assign_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts,
                                 std::span<const Ghost> sites) {
  const std::int64_t announced = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  TRIME_ASSERT(announced == static_cast<std::int64_t>(sites.size()), "{} ghosts announced, {} received", announced,
               sites.size());
  for (std::size_t b = static_cast<std::size_t>(owned_blocks_); b < blocks_.size(); ++b)
    blocks_[b].complete = false;
  blocks_.resize(static_cast<std::size_t>(owned_blocks_));
  for (LocalIndex& block : tile_block_)
    block = block >= owned_blocks_ ? -1 : block;
  bin_begin_.resize(owned_bins_);
  bin_end_.resize(bin_begin_.size());
  bin_known_.resize(bin_begin_.size());
  positions_.resize(static_cast<std::size_t>(owned_));
  boundary_.resize(positions_.size());
  positions_.reserve(positions_.size() + sites.size());
  boundary_.reserve(positions_.capacity());
  LocalIndex next = owned_;
  for (std::size_t k = 0; k < bins.size(); ++k) {
    const geometry::Vec2 shift = grid_->shift(bins[k].image);
    for (LocalIndex s = next - owned_; s < next - owned_ + counts[k]; ++s) {
      const Ghost& ghost = sites[static_cast<std::size_t>(s)];
      positions_.push_back(ghost.position + shift);
      boundary_.push_back(ghost.boundary);
    }
    LocalIndex& block = tile_block_[block_slot(bins[k].tile, bins[k].image)];
    if (block < 0) {
      block = static_cast<LocalIndex>(blocks_.size());
      blocks_.push_back({bin_begin_.size(), grid_->bin_bits(bins[k].tile), false});
      bin_begin_.resize(bin_begin_.size() + static_cast<std::size_t>(grid_->bins_per_tile(bins[k].tile)), 0);
      bin_end_.resize(bin_begin_.size(), 0);
      bin_known_.resize(bin_begin_.size(), 0);
    }
    const std::size_t bin = blocks_[static_cast<std::size_t>(block)].first_bin + static_cast<std::size_t>(bins[k].bin);
    bin_begin_[bin] = next;
    next += counts[k];
    bin_end_[bin] = next;
    bin_known_[bin] = 1;
  }
}

void BinnedPoints::prepare_advance() {
  next_positions_.resize(positions_.size());
  next_leads_.resize(leads_.size());
}

void BinnedPoints::advance() {
  std::copy(positions_.begin() + owned_, positions_.end(), next_positions_.begin() + owned_);
  positions_.swap(next_positions_);
  leads_.swap(next_leads_);
}

/// How much farther a search has to go for sites that have left their bins: those near `center` were sorted into its
/// tile or one next to it, unless the search or the drift reaches across a whole tile.
double BinnedPoints::margin(Vec2 center, double reach) const {
  const geometry::Box box = grid_->tile_box(0);
  if (reach + largest_drift_ > std::min(box.width(), box.height()))
    return largest_drift_;
  const int column = grid_->tile_of(grid_->fixed_x(center.x)), row = grid_->tile_of(grid_->fixed_y(center.y));
  double most = 0;
  for (int y = std::max(0, row - 1); y <= std::min(grid_->tiles_y() - 1, row + 1); ++y)
    for (int x = std::max(0, column - 1); x <= std::min(grid_->tiles_x() - 1, column + 1); ++x)
      most = std::max(most, drift(grid_->tile_at(x, y)));
  return most;
}

BinnedPoints::Range BinnedPoints::tile_range(LocalIndex tile) const {
  const std::size_t t = static_cast<std::size_t>(tile - first_tile_);
  return {kept_[t], kept_[t + 1]};
}

BinnedPoints::Range BinnedPoints::bin_range(BinRef bin) const {
  const LocalIndex block = tile_block_[block_slot(bin.tile, bin.image)];
  if (block < 0)
    return {0, 0};
  const std::size_t at = blocks_[static_cast<std::size_t>(block)].first_bin + static_cast<std::size_t>(bin.bin);
  return {bin_begin_[at], bin_end_[at]};
}

int BinnedPoints::suitable_bin_bits(LocalIndex tile) const {
  const auto [begin, end] = tile_range(tile);
  const std::int64_t n = end - begin;
  int bits = 0;
  while (bits < grid_->most_bin_bits() && std::int64_t{4} << (2 * bits) <= bins_per_site * n)
    ++bits;
  std::vector<std::int64_t> count(std::size_t{1} << (2 * bits), 0);
  for (LocalIndex i = begin; i < end; ++i) {
    const Vec2 p = position(i);
    ++count[static_cast<std::size_t>((grid_->bin_of(grid_->fixed_y(p.y), bits) << bits) |
                                     grid_->bin_of(grid_->fixed_x(p.x), bits))];
  }
  int suitable = bits; // the smallest that will do, coming from the largest
  for (; bits >= 0; --bits) {
    std::int64_t pairs = 0;
    for (const std::int64_t c : count)
      pairs += c * c;
    if (static_cast<double>(pairs) > most_in_bin * static_cast<double>(n))
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

void BinnedPoints::release_work_space() {
  for (std::vector<LocalIndex>* list : {&tile_start_, &order_, &sorted_, &tile_of_, &key_})
    std::vector<LocalIndex>().swap(*list);
  for (std::vector<Vec2>* list : {&next_positions_, &next_leads_})
    std::vector<Vec2>().swap(*list);
}

void BinnedPoints::release_moves() {
  std::vector<std::uint8_t>().swap(pushes_);
  std::vector<Vec2>().swap(leads_);
}

} // namespace trime::mesh
