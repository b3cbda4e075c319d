// SPDX-License-Identifier: BSD-3-Clause
// The sites that one rank knows: its own, sorted by tile and bin, and after them the ghosts, sorted likewise. Bins of
// foreign tiles are known or unknown; a search that meets an unknown bin says so. Holds no MPI and no triangles.
#pragma once

#include "trime/core/types.hpp"
#include "trime/core/unset_vector.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/tile_grid.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// Values of Site::boundary for sites inside: those that move, and those that stay where a user wants them.
inline constexpr std::int32_t free_site = -1, fixed_site = -2;

/// A site with all that travels with it when it changes its owner.
struct Site {
  geometry::Vec2 position;
  std::int32_t boundary = free_site; ///< index of the boundary site that it is; inside free_site or fixed_site
  std::int32_t pushes = 0;           ///< times that it was pushed out of a boundary disc
  geometry::Vec2 lead{};             ///< the step by which an accelerated update runs ahead of its last iterate
};

/// Sites in no order yet. Elements made without a value (resize, a list of a given size) are not set, not even to the
/// defaults of Site: threads fill them in large numbers.
using SiteList = UnsetVector<Site>;

/// What a rank knows of a site of another rank: 24 bytes, as it is sent.
struct Ghost {
  geometry::Vec2 position;
  std::int32_t boundary = -1;
  std::int32_t unused = 0; ///< no byte of a message is left to chance
};

/// A bin of a tile, or of an image of a tile (see TileGrid).
struct BinRef {
  LocalIndex tile;
  std::int32_t bin;
  std::int32_t image = 0;
  friend auto operator<=>(const BinRef&, const BinRef&) = default;
};

class BinnedPoints {
public:
  /// @pre `grid` outlives this object
  explicit BinnedPoints(const TileGrid& grid);

  const TileGrid& grid() const { return *grid_; }

  /// @brief Replaces the owned sites: those of tiles [first_tile, last_tile). Sorts them by tile and bin and drops
  /// all but one of interior sites at equal coordinates (a boundary site stays, the larger push count is kept).
  /// Forgets the ghosts.
  /// @param new_index if not null: for each input site its new local index, -1 if dropped
  /// @return number of dropped sites. O(n); threads.
  LocalIndex assign_owned(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile,
                          std::vector<LocalIndex>* new_index = nullptr);

  /// @brief Replaces the ghosts: `bins` (ascending, of foreign tiles or of images of any) are known from now on and
  /// hold counts[k] sites each, concatenated in `sites` at their canonical positions; here they are moved to their
  /// images.
  void assign_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts, std::span<const Ghost> sites);

  LocalIndex owned() const { return owned_; }
  LocalIndex size() const { return static_cast<LocalIndex>(positions_.size()); }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  geometry::Vec2 position(LocalIndex i) const { return positions_[static_cast<std::size_t>(i)]; }
  /// Index of the boundary site that site i is, or -1.
  std::int32_t boundary(LocalIndex i) const { return boundary_[static_cast<std::size_t>(i)]; }
  /// @pre site i is owned
  Site site(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    return {positions_[at], boundary_[at], pushes_[at], leads_.empty() ? geometry::Vec2{} : leads_[at]};
  }
  Ghost ghost(LocalIndex i) const { return {position(i), boundary(i)}; }

  LocalIndex first_tile() const { return first_tile_; }
  LocalIndex last_tile() const { return last_tile_; }
  /// Owned sites of an owned tile.
  struct Range {
    LocalIndex begin, end;
  };
  Range tile_range(LocalIndex tile) const;
  /// Sites of a bin of an owned or partly known tile; empty if unknown.
  Range bin_range(BinRef bin) const;

  /// @brief Calls visit(begin, end) for runs of local indices that together hold every known site of all bins that
  /// meet the square of half-width `reach` around `center`, and missing(BinRef) for each such bin that is unknown.
  /// @pre in a periodic container: `center` canonical, reach below the period
  template <class Visit, class Missing>
  void for_each_near(geometry::Vec2 center, double reach, const Visit& visit, const Missing& missing) const;

  /// @brief For each of the tiles [first_tile, last_tile) the b for which 2^b x 2^b bins suit those of the sites that
  /// lie in it: the smallest for which a site shares its bin with a few others on average, with at most four bins a
  /// site. What was found out on the way serves the next assign_owned. O(n); threads.
  /// @post assign_owned with the same sites and tiles must come next; another number of them is an InternalError
  std::vector<std::uint8_t> suitable_bin_bits(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile);

  /// @brief Moves without sorting: the places (and leads) that the owned sites will take at the next `advance`, to be
  /// filled by the caller. The bins stay those of the last assign_owned; for_each_near then searches as much farther as
  /// sites may have come since (the drift of their tile).
  std::span<geometry::Vec2> next_positions() { return next_positions_; }
  std::span<geometry::Vec2> next_leads() { return next_leads_; }
  std::span<const geometry::Vec2> next_positions() const { return next_positions_; }
  std::span<const geometry::Vec2> next_leads() const { return next_leads_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }
  /// Makes room for the above; what it holds is not set.
  void prepare_advance();
  /// The next places are the present ones, until the caller changes some.
  void prepare_to_stay();
  /// Moves the owned sites to their next places; the ghosts stay.
  void advance();
  /// What would travel with an owned site to its next place. @pre it has one
  Site next_site(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    return {next_positions_[at], boundary_[at], pushes_[at], next_leads_.empty() ? geometry::Vec2{} : next_leads_[at]};
  }
  /// @brief Sorts the owned sites at their next places, but for those that are gone (by local index; empty: none), and
  /// more of them besides; as assign_owned does, with the same tiles. The next places are used up. Needs 9 bytes a site
  /// more than the sites and their next places.
  /// @param new_index for each owned site, then for each of `more`, its new local index, -1 if gone or dropped
  /// @pre all lie in the owned tiles
  void sort_moved(std::span<const std::uint8_t> gone, std::span<const Site> more, std::vector<LocalIndex>& new_index);
  /// No site that was sorted into this tile has come farther since. Of a tile of which no bin is known, the largest
  /// drift is assumed.
  void set_drift(LocalIndex tile, double distance) { drift_[static_cast<std::size_t>(tile)] = distance; }
  double drift(LocalIndex tile) const { return drift_[static_cast<std::size_t>(tile)]; }
  const std::vector<double>& drifts() const { return drift_; }
  /// The largest of all drifts, over all ranks.
  void set_largest_drift(double distance) { largest_drift_ = distance; }
  double largest_drift() const { return largest_drift_; }
  void set_pushes(LocalIndex i, std::int32_t pushes) {
    pushes_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::min(pushes, 255));
  }
  void set_boundary(LocalIndex i, std::int32_t boundary) { boundary_[static_cast<std::size_t>(i)] = boundary; }
  std::int32_t pushes(LocalIndex i) const { return pushes_[static_cast<std::size_t>(i)]; }
  /// The ghosts, to be moved by their owners.
  std::span<geometry::Vec2> ghost_positions() {
    return std::span(positions_).subspan(static_cast<std::size_t>(owned_));
  }

  /// Frees the leads, and those of arriving sites are forgotten: no rule moves the sites any more. @post site() says 0;
  /// leads() and next_leads() are empty, until assign_owned
  void release_leads();
  /// Frees what only sites that move have, and the bins. @post nothing but positions, boundary and tile_range may be
  /// asked for, until assign_owned
  void release_moves();

private:
  struct Block {           // bins of one tile that is owned or partly known
    std::size_t first_bin; // into bin_begin_ and bin_known_
    int bits;              // 2^bits x 2^bits bins
    bool complete;         // every bin known
  };
  template <class Visit, class Missing>
  void visit_row(BinRef first_bin, int bx0, int bx1, const Visit& visit, const Missing& missing) const;
  double margin(geometry::Vec2 center, double reach) const;
  void make_owned_blocks();
  std::size_t block_slot(LocalIndex tile, std::int32_t image) const {
    return static_cast<std::size_t>(tile) * static_cast<std::size_t>(images_) + static_cast<std::size_t>(image);
  }

  class ListedSites;
  class MovedSites;
  struct TileWork {
    std::vector<int> bin;
    std::vector<LocalIndex> sorted;
  };
  template <class Sites>
  LocalIndex find_order(const Sites& sites);
  template <class Sites>
  void sort_into_tiles(const Sites& sites);
  int suitable_bin_bits(std::span<const Site> sites, LocalIndex tile) const;
  template <class Sites>
  LocalIndex sort_tile(const Sites& sites, LocalIndex tile, TileWork& work);
  template <class Sites>
  void take_places(const Sites& sites);
  template <class Sites>
  void take_labels(const Sites& sites);
  void list_new_indices(LocalIndex before, std::vector<LocalIndex>& new_index) const;
  void forget_order();

  const TileGrid* grid_;
  LocalIndex owned_ = 0, first_tile_ = 0, last_tile_ = 0;
  UnsetVector<geometry::Vec2> positions_;
  UnsetVector<std::int32_t> boundary_;
  UnsetVector<std::uint8_t> pushes_;                        // owned only
  UnsetVector<geometry::Vec2> leads_;                       // owned only
  UnsetVector<geometry::Vec2> next_positions_, next_leads_; // by local index; of use only while sites move
  std::vector<double> drift_; // by tile, since the sites were sorted; O(tiles of the container)
  double largest_drift_ = 0;
  int images_;                         // of a tile
  std::vector<LocalIndex> tile_block_; // by tile and image: index into blocks_, -1 unknown; O(tiles of the container)
  std::vector<Block> blocks_;
  std::vector<LocalIndex> bin_begin_, bin_end_;
  std::vector<std::uint8_t> bin_known_;
  bool has_leads_ = true;
  LocalIndex owned_blocks_ = 0;
  std::size_t owned_bins_ = 0;
  std::vector<LocalIndex> kept_; // first owned site of each owned tile, and the end
  // While sites are sorted: where the sites of each tile begin in the order, which holds their old indices.
  std::vector<LocalIndex> tile_start_;
  UnsetVector<LocalIndex> order_;
};

template <class Visit, class Missing>
void BinnedPoints::for_each_near(geometry::Vec2 center, double reach, const Visit& visit,
                                 const Missing& missing) const {
  const TileGrid& grid = *grid_;
  if (largest_drift_ > 0)
    reach += margin(center, reach);
  const std::int64_t x0 = grid.unrolled_x(center.x - reach), x1 = grid.unrolled_x(center.x + reach);
  const std::int64_t y0 = grid.unrolled_y(center.y - reach), y1 = grid.unrolled_y(center.y + reach);
  const int tx0 = grid.tile_of(x0), tx1 = grid.tile_of(x1), ty0 = grid.tile_of(y0), ty1 = grid.tile_of(y1);
  if (tx0 == tx1 && ty0 == ty1) { // most squares lie in one tile
    const TileGrid::TileImage at = grid.tile_image_at(tx0, ty0);
    const LocalIndex block = tile_block_[block_slot(at.tile, at.image)];
    if (block >= 0 && blocks_[static_cast<std::size_t>(block)].complete) {
      const Block& b = blocks_[static_cast<std::size_t>(block)];
      const LocalIndex* begin = bin_begin_.data() + b.first_bin + grid.bin_of(x0, b.bits);
      const LocalIndex* end = bin_end_.data() + b.first_bin + grid.bin_of(x1, b.bits);
      const int last_row = grid.bin_of(y1, b.bits) << b.bits;
      for (int row = grid.bin_of(y0, b.bits) << b.bits; row <= last_row; row += 1 << b.bits)
        visit(begin[row], end[row]); // the bins of a row are contiguous in memory
      return;
    }
  }
  for (int ty = ty0; ty <= ty1; ++ty)
    for (int tx = tx0; tx <= tx1; ++tx) {
      const TileGrid::TileImage at = grid.tile_image_at(tx, ty);
      const int bits = grid.bin_bits(at.tile), last = (1 << bits) - 1;
      const int bx0 = tx == tx0 ? grid.bin_of(x0, bits) : 0, bx1 = tx == tx1 ? grid.bin_of(x1, bits) : last;
      const int by0 = ty == ty0 ? grid.bin_of(y0, bits) : 0, by1 = ty == ty1 ? grid.bin_of(y1, bits) : last;
      for (int by = by0; by <= by1; ++by)
        visit_row({at.tile, by << bits, at.image}, bx0, bx1, visit, missing);
    }
}

/// Bins first_bin.bin + bx0 .. first_bin.bin + bx1 of one row of one tile.
template <class Visit, class Missing>
void BinnedPoints::visit_row(BinRef first_bin, int bx0, int bx1, const Visit& visit, const Missing& missing) const {
  const LocalIndex block = tile_block_[block_slot(first_bin.tile, first_bin.image)];
  if (block < 0) {
    for (int bx = bx0; bx <= bx1; ++bx)
      missing(BinRef{first_bin.tile, first_bin.bin | bx, first_bin.image});
    return;
  }
  const Block& b = blocks_[static_cast<std::size_t>(block)];
  const std::size_t first = b.first_bin + static_cast<std::size_t>(first_bin.bin);
  if (b.complete) {
    visit(bin_begin_[first + bx0], bin_end_[first + bx1]);
    return;
  }
  for (int bx = bx0; bx <= bx1; ++bx) {
    if (bin_known_[first + bx])
      visit(bin_begin_[first + bx], bin_end_[first + bx]);
    else
      missing(BinRef{first_bin.tile, first_bin.bin | bx, first_bin.image});
  }
}

} // namespace trime::mesh
