// SPDX-License-Identifier: BSD-3-Clause
// Stores which sites lie in which bin. A rank knows all bins of the tiles that it
// owns, and some bins of other ranks' tiles.
#pragma once

#include "mesh/site.hpp"
#include "mesh/tile_grid.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace trime::mesh {

/// The range of local indices from `begin` to `end` - 1.
struct SiteRange {
  LocalIndex begin, end;
};

/// @brief Stores the range of local indices of each known bin, but not the sites themselves. Each tile with a known bin
/// has a number: first the owned tiles in their order, then the others in the order in which they became known. Memory:
/// O(known bins).
class KnownBins {
public:
  /// @pre `grid` outlives this object
  explicit KnownBins(const TileGrid& grid);

  const TileGrid& grid() const { return *grid_; }

  /// Makes the bins of the tiles [first_tile, last_tile) known, and forgets all other bins. The caller sets their
  /// ranges.
  void own(LocalIndex first_tile, LocalIndex last_tile);
  /// Forgets all bins except those of the owned tiles.
  void forget_foreign();
  /// Makes a bin of a foreign tile, or of a periodic image of any tile, known, with its sites.
  void add_foreign(BinRef bin, SiteRange sites);
  /// Frees the ranges. The ranges must not be used until own() is called again.
  void release_ranges();

  /// The first and the last index of each bin of one owned tile, row by row.
  struct TileBins {
    std::span<LocalIndex> begin, end;
    int bits; ///< the tile has 2^bits x 2^bits bins
  };
  /// Returns the bins of one tile.
  /// @param k number of the tile, counted from the first owned tile
  TileBins owned_tile(LocalIndex k);

  /// Returns the sites of a bin; an empty range if the bin is unknown.
  SiteRange range(BinRef bin) const {
    const LocalIndex block = block_of(bin.tile, bin.image);
    if (block < 0)
      return {0, 0};
    const std::size_t at = blocks_[static_cast<std::size_t>(block)].first_bin + static_cast<std::size_t>(bin.bin);
    return {begin_[at], end_[at]};
  }
  /// Calls visit(BinRef, SiteRange) for all known bins of foreign tiles and of periodic images, in ascending order.
  template <class Visit>
  void for_each_foreign(const Visit& visit) const;
  /// Returns the number of a tile that has a known bin; -1 for other tiles.
  LocalIndex known_tile(LocalIndex tile) const { return block_of(tile, 0); }
  LocalIndex owned_tiles() const { return owned_blocks_; }
  /// Returns the number of known tiles, which are numbered from 0.
  LocalIndex known_tiles() const { return static_cast<LocalIndex>(blocks_.size()); }

  /// Does the same as BinnedPoints::for_each_near, for sites that have not moved since they were sorted into bins.
  template <class Visit, class Missing>
  void for_each_near(geometry::Vec2 center, double reach, const Visit& visit, const Missing& missing) const;

private:
  struct Block {           // the bins of one tile, which is owned or partly known
    std::size_t first_bin; // index into begin_, end_ and known_
    int bits;              // the tile has 2^bits x 2^bits bins
    bool complete;         // whether every bin of the tile is known
  };
  template <class Visit>
  void visit_complete(const Block& block, const Tile& tile, const FixedRect& part, const Visit& visit) const;
  template <class Visit, class Missing>
  void visit_row(BinRef first_bin, int bx0, int bx1, const Visit& visit, const Missing& missing) const;
  /// A tile that is not owned, or a periodic image of any tile.
  struct Foreign {
    LocalIndex tile;
    std::int32_t image;
    LocalIndex block;
    auto key() const { return std::pair(tile, image); }
  };
  /// Returns the index into blocks_; -1 if the tile is unknown. Cost: O(1) for owned tiles, otherwise O(log(known
  /// tiles)).
  LocalIndex block_of(LocalIndex tile, std::int32_t image) const {
    if (image == 0 && tile >= first_tile_ && tile - first_tile_ < owned_blocks_)
      return tile - first_tile_;
    const auto found = foreign_at(tile, image);
    return found != foreign_.end() && found->key() == std::pair(tile, image) ? found->block : -1;
  }
  std::vector<Foreign>::const_iterator foreign_at(LocalIndex tile, std::int32_t image) const {
    return std::lower_bound(foreign_.begin(), foreign_.end(), std::pair(tile, image),
                            [](const Foreign& a, const auto& key) { return a.key() < key; });
  }

  const TileGrid* grid_;
  LocalIndex first_tile_ = 0;
  std::vector<Foreign> foreign_; // ascending
  std::vector<Block> blocks_;    // the owned tiles come first
  std::vector<LocalIndex> begin_, end_;
  std::vector<std::uint8_t> known_;
  LocalIndex owned_blocks_ = 0;
  std::size_t owned_bins_ = 0;
};

template <class Visit>
void KnownBins::for_each_foreign(const Visit& visit) const {
  for (const Foreign& foreign : foreign_) {
    const Block& block = blocks_[static_cast<std::size_t>(foreign.block)];
    for (std::int32_t bin = 0; bin < std::int32_t{1} << (2 * block.bits); ++bin)
      if (const std::size_t k = block.first_bin + static_cast<std::size_t>(bin); known_[k])
        visit(BinRef{foreign.tile, bin, foreign.image}, SiteRange{begin_[k], end_[k]});
  }
}

template <class Visit, class Missing>
void KnownBins::for_each_near(geometry::Vec2 center, double reach, const Visit& visit, const Missing& missing) const {
  const FixedRect rect = grid_->rect_around(center, reach);
  if (grid_->limits().contains(rect)) { // usually true: most squares lie in one tile
    const LocalIndex number = grid_->tile_at(rect.x0, rect.y0);
    const Tile& tile = grid_->tile(number);
    if (rect_of(tile).contains(rect)) {
      const LocalIndex block = block_of(number, 0);
      if (block >= 0 && blocks_[static_cast<std::size_t>(block)].complete)
        return visit_complete(blocks_[static_cast<std::size_t>(block)], tile, rect, visit);
    }
  }
  grid_->for_each_in(rect, [&](LocalIndex number, int image, const FixedRect& part) {
    const Tile& tile = grid_->tile(number);
    const LocalIndex block = block_of(number, image);
    if (block >= 0 && blocks_[static_cast<std::size_t>(block)].complete)
      return visit_complete(blocks_[static_cast<std::size_t>(block)], tile, part, visit);
    const int bx0 = tile.first_column(part.x0), bx1 = tile.last_column(part.x1);
    for (int by = tile.first_row(part.y0); by <= tile.last_row(part.y1); ++by)
      visit_row({number, by << tile.bits, image}, bx0, bx1, visit, missing);
  });
}

template <class Visit>
void KnownBins::visit_complete(const Block& block, const Tile& tile, const FixedRect& part, const Visit& visit) const {
  const LocalIndex* begin = begin_.data() + block.first_bin + tile.first_column(part.x0);
  const LocalIndex* end = end_.data() + block.first_bin + tile.last_column(part.x1);
  const int last_row = tile.last_row(part.y1) << tile.bits;
  for (int row = tile.first_row(part.y0) << tile.bits; row <= last_row; row += 1 << tile.bits)
    visit(begin[row], end[row]); // the bins of a row are contiguous in memory
}

/// Visits the bins first_bin.bin + bx0 .. first_bin.bin + bx1, which form a row of a partly known tile.
template <class Visit, class Missing>
void KnownBins::visit_row(BinRef first_bin, int bx0, int bx1, const Visit& visit, const Missing& missing) const {
  const LocalIndex block = block_of(first_bin.tile, first_bin.image);
  if (block < 0) {
    for (int bx = bx0; bx <= bx1; ++bx)
      missing(BinRef{first_bin.tile, first_bin.bin | bx, first_bin.image});
    return;
  }
  const std::size_t first =
      blocks_[static_cast<std::size_t>(block)].first_bin + static_cast<std::size_t>(first_bin.bin);
  for (int bx = bx0; bx <= bx1; ++bx) {
    if (known_[first + bx])
      visit(begin_[first + bx], end_[first + bx]);
    else
      missing(BinRef{first_bin.tile, first_bin.bin | bx, first_bin.image});
  }
}

} // namespace trime::mesh
