// SPDX-License-Identifier: BSD-3-Clause
// The sites that one rank knows: first its own, then the ghosts, both sorted by tile and bin. Bins of other ranks'
// tiles are known or unknown; a search that meets an unknown bin says so. This file uses no MPI and knows no triangles.
#pragma once

#include "mesh/drifts.hpp"
#include "mesh/index_shift.hpp"
#include "mesh/known_bins.hpp"
#include "mesh/next_places.hpp"
#include "mesh/site.hpp"
#include "mesh/site_order.hpp"
#include "mesh/tile_grid.hpp"
#include "mesh/tile_marks.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// @brief The sites and their bins. What may be called follows from the state:
/// - empty: at first. Only suitable_bin_bits and assign_owned.
/// - grouped: after suitable_bin_bits. Only assign_owned with the same sites and tiles.
/// - sorted: after assign_owned, sort_moved and edit. All but advance, sort_moved and what asks for next places.
/// - prepared: after prepare_advance. All functions may be called. `advance` leads back to sorted: then the bins are
/// older than the places, and the drifts must be set. release_leads also leads back to sorted, and so does sort_moved,
/// with fresh bins. After other ghosts are assigned, places must be prepared again before `advance`.
/// - released: after release_moves. Only positions, boundary, tile_range, and assign_owned.
/// Calls that change the state check it; queries of single sites and bins do not.
class BinnedPoints {
public:
  /// @pre `grid` outlives this object
  explicit BinnedPoints(const TileGrid& grid);

  const TileGrid& grid() const { return bins_.grid(); }

  /// @brief Replaces the owned sites: those of tiles [first_tile, last_tile). Sorts them by tile and bin and drops
  /// all but one of interior sites at equal coordinates (a boundary site stays, the larger push count is kept).
  /// Forgets the ghosts.
  /// @param new_index if not null: for each input site its new local index, -1 if dropped
  /// @return number of dropped sites. O(n), by all threads.
  LocalIndex assign_owned(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile,
                          std::vector<LocalIndex>* new_index = nullptr);

  /// @brief As assign_owned, for sites that have moved since they were sorted: they still belong to their tiles, and to
  /// the nearest bin of that tile. No site is dropped.
  /// @param counts sites of each of the tiles, in whose order they come
  void restore_owned(std::span<const Site> sites, std::span<const std::int64_t> counts, LocalIndex first_tile,
                     LocalIndex last_tile, std::vector<LocalIndex>& new_index);

  /// @brief Replaces the ghosts: `bins` (ascending, of foreign tiles or of images of any) are known from now on and
  /// hold counts[k] sites each, concatenated in `sites` at their canonical positions; here they are moved to their
  /// images.
  void assign_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts, std::span<const Ghost> sites);
  /// Adds ghosts behind those that there are, which keep their local indices. @pre none of these bins is known
  void add_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts, std::span<const Ghost> sites);

  LocalIndex owned() const { return owned_; }
  LocalIndex size() const { return static_cast<LocalIndex>(positions_.size()); }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  geometry::Vec2 position(LocalIndex i) const { return positions_[at(i)]; }
  /// Index of the boundary site that site i is, or -1.
  std::int32_t boundary(LocalIndex i) const { return boundary_[at(i)]; }
  std::span<const std::int32_t> boundaries() const { return boundary_; }
  /// @pre site i is owned
  Site site(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    return {positions_[at], boundary_[at], pushes_[at], leads_.empty() ? geometry::Vec2{} : leads_[at]};
  }

  LocalIndex first_tile() const { return order_.first_tile(); }
  LocalIndex last_tile() const { return order_.last_tile(); }
  /// Owned sites of an owned tile.
  SiteRange tile_range(LocalIndex tile) const { return order_.of_tile(tile); }
  /// Returns the number of a tile that has a known bin, or -1: see KnownBins. Drifts are indexed by it.
  LocalIndex known_tile(LocalIndex tile) const { return bins_.known_tile(tile); }
  LocalIndex known_tiles() const { return bins_.known_tiles(); }
  /// Sites of a bin of an owned or partly known tile; empty if unknown.
  SiteRange bin_range(BinRef bin) const { return bins_.range(bin); }
  /// See KnownBins::for_each_foreign: the ghosts.
  template <class Visit>
  void for_each_foreign_bin(const Visit& visit) const {
    bins_.for_each_foreign(visit);
  }

  /// @brief Calls visit(begin, end) for runs of local indices that together hold every known site of all bins that
  /// meet the square of half-width `reach` around `center`, and missing(BinRef) for each such bin that is unknown.
  /// @pre in a periodic container: `center` canonical, reach below the period
  template <class Visit, class Missing>
  void for_each_near(geometry::Vec2 center, double reach, const Visit& visit, const Missing& missing) const {
    if (drifts_.largest().distance > 0)
      reach += drifts_.margin(center, reach, bins_);
    bins_.for_each_near(center, reach, visit, missing);
  }

  /// @brief Returns for each of the tiles [first_tile, last_tile) the b for which 2^b x 2^b bins suit its sites. It is
  /// the smallest b for which a site shares its bin with a few others on average, with at most four bins per site. The
  /// next assign_owned uses intermediate results. O(n), by all threads.
  /// @post assign_owned with the same sites and tiles must come next; another number of them is an InternalError
  std::vector<std::uint8_t> suitable_bin_bits(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile);

  /// @brief Moves without sorting: where the owned sites go at the next `advance`. The bins stay those of the last
  /// assign_owned; for_each_near then searches as much farther as sites may have come since (the drift of their tile).
  NextPlaces& next() { return next_; }
  const NextPlaces& next() const { return next_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }
  /// Makes room for the next places; what they hold is not set.
  void prepare_advance();
  /// Moves the owned sites to their next places; the ghosts stay.
  void advance();
  /// @brief Sorts the owned sites at their next places as assign_owned does, with the same tiles. Leaves out sites that
  /// are gone (by local index; empty: no sites), and adds new ones. The next places are used up. Needs 9 bytes a site
  /// more than the sites and their next places.
  /// @param new_index for each owned site, then for each of `more`, its new local index, -1 if gone or dropped
  /// @pre all lie in the owned tiles
  void sort_moved(std::span<const std::uint8_t> gone, std::span<const Site> more, std::vector<LocalIndex>& new_index);
  /// @brief Takes out some of the owned sites and puts others between the rest, which stay where they are: places, bins
  /// and labels are those that sort_moved finds, and nothing is sorted but the sites that come. Forgets the ghosts.
  /// O(edits log edits), and a pass at the speed of memory over the sites and bins behind the first edit.
  /// @param gone ascending, each once @param come in the owned tiles
  /// @param new_index for each of `come` its local index, -1 if it is dropped, since another lies at its place
  /// @pre sites were sorted and have not moved since; leads are released
  IndexShift edit(std::vector<LocalIndex> gone, std::span<const Site> come, std::vector<LocalIndex>& new_index);
  /// How far sites have come since they were sorted; searches go so much farther.
  const Drifts& drifts() const { return drifts_; }
  Drifts& drifts() { return drifts_; }
  const TileMarks& marks() const { return marks_; }
  TileMarks& marks() { return marks_; }
  void set_pushes(LocalIndex i, std::int32_t pushes) {
    pushes_[at(i)] = static_cast<std::uint8_t>(std::min(pushes, 255));
  }
  void set_boundary(LocalIndex i, std::int32_t boundary) { boundary_[at(i)] = boundary; }
  std::int32_t pushes(LocalIndex i) const { return pushes_[at(i)]; }
  /// The ghosts, to be moved by their owners.
  std::span<geometry::Vec2> ghost_positions() {
    return std::span(positions_).subspan(static_cast<std::size_t>(owned_));
  }

  /// Frees the leads, and ignores those of arriving sites: no rule moves the sites from now on. @post site() says 0;
  /// leads() and next().leads() are empty, until assign_owned
  void release_leads();
  bool has_leads() const { return has_leads_; }
  /// Frees what only sites that move have, and the bins. @post nothing but positions, boundary and tile_range may be
  /// asked for, until assign_owned
  void release_moves();

private:
  enum class State { empty, grouped, sorted, prepared, released };
  template <class Sites>
  LocalIndex sort(const Sites& sites);
  /// A site that comes.
  struct Newcomer {
    BinRef bin;
    LocalIndex number, place; // in the list of them; the owned site before which it comes
  };
  std::vector<Newcomer> place_newcomers(std::span<const Site> come, std::vector<LocalIndex>& gone) const;
  template <class Sites>
  LocalIndex assign(const Sites& sites, LocalIndex first_tile, LocalIndex last_tile,
                    std::vector<LocalIndex>* new_index);

  State state_ = State::empty;
  KnownBins bins_;
  Drifts drifts_;
  TileMarks marks_;
  SiteOrder order_;
  LocalIndex owned_ = 0;
  UnsetVector<geometry::Vec2> positions_;
  UnsetVector<std::int32_t> boundary_;
  UnsetVector<std::uint8_t> pushes_;  // owned only
  UnsetVector<geometry::Vec2> leads_; // owned only
  NextPlaces next_;                   // of use only while sites move
  bool has_leads_ = true;
};

/// Prepares an advance in which every owned site stays, until the caller changes its next place. Uses all threads.
void prepare_to_stay(BinnedPoints& points);

/// Returns the data that would be sent with an owned site to its next place. @pre it has one
inline Site next_site(const BinnedPoints& points, LocalIndex i) {
  const NextPlaces& next = points.next();
  return {next.positions()[at(i)], points.boundary(i), points.pushes(i),
          next.leads().empty() ? geometry::Vec2{} : next.leads()[at(i)]};
}

} // namespace trime::mesh
