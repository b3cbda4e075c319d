// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/known_bins.hpp"

#include "trime/core/types.hpp"

#include <algorithm>

namespace trime::mesh {

KnownBins::KnownBins(const TileGrid& grid) : grid_(&grid) {}

void KnownBins::own(LocalIndex first_tile, LocalIndex last_tile) {
  first_tile_ = first_tile;
  foreign_.clear();
  blocks_.clear();
  std::size_t bins = 0;
  for (LocalIndex tile = first_tile; tile < last_tile; ++tile) {
    blocks_.push_back({bins, grid_->bin_bits(tile), true});
    bins += static_cast<std::size_t>(grid_->bins_per_tile(tile));
  }
  owned_blocks_ = static_cast<LocalIndex>(blocks_.size());
  owned_bins_ = bins;
  begin_.resize(bins);
  end_.resize(bins);
  known_.assign(bins, 1);
}

void KnownBins::forget_foreign() {
  blocks_.resize(static_cast<std::size_t>(owned_blocks_));
  foreign_.clear();
  begin_.resize(owned_bins_);
  end_.resize(owned_bins_);
  known_.resize(owned_bins_);
}

void KnownBins::add_foreign(BinRef bin, SiteRange sites) {
  const auto found = foreign_at(bin.tile, bin.image);
  LocalIndex block = static_cast<LocalIndex>(blocks_.size());
  if (found != foreign_.end() && found->key() == std::pair(bin.tile, bin.image)) {
    block = found->block;
  } else {
    foreign_.insert(found, {bin.tile, bin.image, block});
    blocks_.push_back({begin_.size(), grid_->bin_bits(bin.tile), false});
    begin_.resize(begin_.size() + static_cast<std::size_t>(grid_->bins_per_tile(bin.tile)), 0);
    end_.resize(begin_.size(), 0);
    known_.resize(begin_.size(), 0);
  }
  const std::size_t at = blocks_[static_cast<std::size_t>(block)].first_bin + static_cast<std::size_t>(bin.bin);
  begin_[at] = sites.begin;
  end_[at] = sites.end;
  known_[at] = 1;
}

void KnownBins::release_ranges() {
  release(begin_);
  release(end_);
  release(known_);
}

KnownBins::TileBins KnownBins::owned_tile(LocalIndex k) {
  const Block& block = blocks_[static_cast<std::size_t>(k)];
  const std::size_t bins = std::size_t{1} << (2 * block.bits);
  return {std::span(begin_).subspan(block.first_bin, bins), std::span(end_).subspan(block.first_bin, bins), block.bits};
}

} // namespace trime::mesh
