// SPDX-License-Identifier: BSD-3-Clause
#include "trime/mesh/binned_points.hpp"

#include "trime/core/error.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <numeric>

namespace trime::mesh {
namespace {

using geometry::Vec2;

} // namespace

BinnedPoints::BinnedPoints(const TileGrid& grid)
    : grid_(&grid), images_(grid.images()),
      tile_block_(static_cast<std::size_t>(grid.tile_count()) * static_cast<std::size_t>(images_), -1) {}

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

void BinnedPoints::prepare_to_stay() {
  prepare_advance();
  thread_loop((owned_ + 4095) / 4096, 1, [&](std::ptrdiff_t part, int) {
    const std::ptrdiff_t begin = part * 4096, end = std::min<std::ptrdiff_t>(owned_, begin + 4096);
    std::copy(positions_.begin() + begin, positions_.begin() + end, next_positions_.begin() + begin);
    if (has_leads_)
      std::copy(leads_.begin() + begin, leads_.begin() + end, next_leads_.begin() + begin);
  });
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
    for (int x = std::max(0, column - 1); x <= std::min(grid_->tiles_x() - 1, column + 1); ++x) {
      const LocalIndex tile = grid_->tile_at(x, y);
      most = std::max(most, tile_block_[block_slot(tile, 0)] >= 0 ? drift(tile) : largest_drift_);
    }
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

void BinnedPoints::release_leads() {
  has_leads_ = false;
  release(leads_);
  release(next_leads_);
  release(next_positions_);
}

void BinnedPoints::release_moves() {
  release_leads();
  release(pushes_);
  release(bin_begin_);
  release(bin_end_);
  release(bin_known_);
}

} // namespace trime::mesh
