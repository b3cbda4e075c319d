// SPDX-License-Identifier: BSD-3-Clause
// Stores the sites that one rank knows: first its own sites, then the ghosts, both sorted by tile and bin. A bin of
// another rank's tile is known or unknown, and a search reports each unknown bin that it needs. This file uses neither
// MPI nor triangles.
#pragma once

#include "mesh/drifts.hpp"
#include "mesh/index_shift.hpp"
#include "mesh/known_bins.hpp"
#include "mesh/site.hpp"
#include "mesh/site_order.hpp"
#include "mesh/tile_grid.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// @brief The sites of a rank and their bins. The state decides which functions may be called:
/// - empty: the state after construction. Only suitable_bin_bits and assign_owned may be called.
/// - grouped: the state after suitable_bin_bits. Only assign_owned with the same sites and tiles may be called.
/// - sorted: the state after assign_owned, sort_moved and edit. All functions may be called except advance, sort_moved
///   and functions that need next places.
/// - prepared: the state after prepare_advance. All functions may be called. `advance` leads back to sorted, but keeps
///   the old bins, so the caller must set the drifts. release_leads also leads back to sorted; so does sort_moved, with
///   new bins. After other ghosts are assigned, places must be prepared again before `advance`.
/// - released: the state after release_moves. Only positions, boundary, tile_range and assign_owned may be called.
/// Functions that change the state assert it; queries of single sites and bins do not.
class BinnedPoints {
public:
  /// @pre `grid` outlives this object
  explicit BinnedPoints(const TileGrid& grid);

  const TileGrid& grid() const { return bins_.grid(); }

  /// @brief Replaces the owned sites by `sites`, which lie in the tiles [first_tile, last_tile). Sorts them by tile and
  /// bin. Of several sites with equal coordinates it keeps one: a boundary site if there is one, otherwise the site
  /// that was pushed most often. Removes all ghosts.
  /// @param new_index if not null, receives the new local index of each site in `sites`; -1 for a dropped site
  /// @return the number of dropped sites. Cost: O(n), by all threads
  LocalIndex assign_owned(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile,
                          std::vector<LocalIndex>* new_index = nullptr);

  /// @brief Replaces the owned sites by sites that have moved since they were sorted into tiles. Each site stays in its
  /// tile, in that bin of the tile which is nearest to it. No site is dropped.
  /// @param counts number of sites of each tile; `sites` is ordered by tile
  void restore_owned(std::span<const Site> sites, std::span<const std::int64_t> counts, LocalIndex first_tile,
                     LocalIndex last_tile, std::vector<LocalIndex>& new_index);

  /// @brief Replaces the ghosts. The given bins (ascending; of foreign tiles, or periodic images of any tile) become
  /// known. Bin k holds counts[k] sites. `sites` has the sites of all bins at their places in the container; this
  /// function shifts them to their periodic images.
  void assign_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts, std::span<const Ghost> sites);
  /// Appends ghosts to the present ones, which keep their local indices.
  /// @pre none of these bins is known yet
  void add_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts, std::span<const Ghost> sites);

  LocalIndex owned() const { return owned_; }
  LocalIndex size() const { return static_cast<LocalIndex>(positions_.size()); }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  geometry::Vec2 position(LocalIndex i) const { return positions_[at(i)]; }
  /// Returns the index of site i among the boundary sites; a negative number if it lies inside, see Site::boundary.
  std::int32_t boundary(LocalIndex i) const { return boundary_[at(i)]; }
  std::span<const std::int32_t> boundaries() const { return boundary_; }
  /// Returns all data of a site.
  /// @pre site i is owned
  Site site(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    return {positions_[at], boundary_[at], pushes_[at], leads_.empty() ? geometry::Vec2{} : leads_[at]};
  }

  LocalIndex first_tile() const { return order_.first_tile(); }
  LocalIndex last_tile() const { return order_.last_tile(); }
  /// Returns the sites of an owned tile.
  SiteRange tile_range(LocalIndex tile) const { return order_.of_tile(tile); }
  /// Returns the number, in KnownBins, of a tile that has a known bin; -1 for other tiles. The drifts (moves since the
  /// last sorting) are stored under this number.
  LocalIndex known_tile(LocalIndex tile) const { return bins_.known_tile(tile); }
  LocalIndex known_tiles() const { return bins_.known_tiles(); }
  /// Returns the sites of a bin; empty if the bin is unknown.
  SiteRange bin_range(BinRef bin) const { return bins_.range(bin); }
  /// Visits the bins of the ghosts, as KnownBins::for_each_foreign.
  template <class Visit>
  void for_each_foreign_bin(const Visit& visit) const {
    bins_.for_each_foreign(visit);
  }

  /// @brief Finds all sites near a point. Calls visit(begin, end) for runs of local indices, which together contain
  /// every known site in all bins that meet the square of half-width `reach` around `center`. Calls missing(BinRef) for
  /// each such bin that is unknown.
  /// @pre in a periodic container, `center` is canonical and `reach` is below the period
  template <class Visit, class Missing>
  void for_each_near(geometry::Vec2 center, double reach, const Visit& visit, const Missing& missing) const {
    if (drifts_.largest().distance > 0)
      reach += drifts_.margin(center, reach, bins_);
    bins_.for_each_near(center, reach, visit, missing);
  }

  /// @brief Returns for each of the tiles [first_tile, last_tile) the number b for which 2^b x 2^b bins suit its sites.
  /// The function chooses the smallest b for which a site shares its bin with only a few others on average, with at
  /// most four bins per site. The next assign_owned reuses intermediate results. Cost: O(n), by all threads.
  /// @post assign_owned with the same sites and tiles must be called next; another number of sites is an InternalError
  std::vector<std::uint8_t> suitable_bin_bits(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile);

  /// @brief The places to which the owned sites move at the next `advance`. `advance` does not sort the sites: the bins
  /// stay those of the last assign_owned, and for_each_near searches farther by the distance that sites may have moved
  /// since then (the drift of their tile).
  NextPlaces& next() { return next_; }
  const NextPlaces& next() const { return next_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }
  /// Allocates memory for the next places, but does not set them.
  void prepare_advance();
  /// Moves the owned sites to their next places. The ghosts stay.
  void advance();
  /// @brief Sorts the owned sites at their next places in the same way as assign_owned, with the same tiles. Leaves out
  /// the sites that are gone, and adds the sites `more`. Afterwards there are no next places. Needs 9 bytes per site in
  /// addition to the sites and their next places.
  /// @param new_index receives the new local index of each owned site, then of each site of `more`; -1 for sites that
  /// are gone or dropped
  /// @param gone 1 for each owned site that is left out, by local index; empty if no site is left out
  /// @pre all sites lie in the owned tiles
  void sort_moved(std::span<const std::uint8_t> gone, std::span<const Site> more, std::vector<LocalIndex>& new_index);
  /// @brief Removes some of the owned sites and inserts others. Places, bins and order become those that sort_moved
  /// would give, but only the new sites are sorted. Removes all ghosts. Cost: O(edits log edits), and one copy of all
  /// sites and bins after the first edit.
  /// @param gone local indices of the removed sites, ascending, each once
  /// @param come new sites, which lie in the owned tiles
  /// @param new_index receives the local index of each site of `come`; -1 for a site that was dropped because another
  /// site lies at its place
  /// @pre sites have not moved since they were sorted
  IndexShift edit(std::vector<LocalIndex> gone, std::span<const Site> come, std::vector<LocalIndex>& new_index);
  /// Upper bounds on how far sites have moved since they were sorted; searches go farther by these distances.
  const Drifts& drifts() const { return drifts_; }
  Drifts& drifts() { return drifts_; }
  const TileMarks& marks() const { return marks_; }
  TileMarks& marks() { return marks_; }
  void set_pushes(LocalIndex i, std::int32_t pushes) {
    pushes_[at(i)] = static_cast<std::uint8_t>(std::min(pushes, 255));
  }
  void set_boundary(LocalIndex i, std::int32_t boundary) { boundary_[at(i)] = boundary; }
  std::int32_t pushes(LocalIndex i) const { return pushes_[at(i)]; }
  /// Returns the places of the ghosts. The halo sets them after their owners have moved the sites.
  std::span<geometry::Vec2> ghost_positions() {
    return std::span(positions_).subspan(static_cast<std::size_t>(owned_));
  }

  /// Frees the leads, and ignores leads of arriving sites, because no update rule moves sites from now on.
  /// @post until assign_owned, leads() and next().leads() are empty, and site() has the lead 0
  void release_leads();
  bool has_leads() const { return has_leads_; }
  /// Frees the bins, and all data that are needed only while sites move.
  /// @post the state is `released`
  void release_moves();

private:
  enum class State { empty, grouped, sorted, prepared, released };
  template <class Sites>
  LocalIndex sort(const Sites& sites);
  /// A site that edit() inserts.
  struct Newcomer {
    BinRef bin;
    LocalIndex number, place; // number: index in the list of new sites; place: owned site before which it is inserted
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
  NextPlaces next_;                   // used only while sites move
  bool has_leads_ = true;
};

/// Prepares an advance in which every owned site stays in place, unless the caller changes its next place. Uses all
/// threads.
void prepare_to_stay(BinnedPoints& points);

/// Returns whether two of the known sites, at least one of them owned, have the same place. Cost: O(n).
bool has_coincident_sites(const BinnedPoints& points);

/// Returns an owned site at its next place, with all its other data.
/// @pre next places are set
inline Site next_site(const BinnedPoints& points, LocalIndex i) {
  const NextPlaces& next = points.next();
  return {next.positions()[at(i)], points.boundary(i), points.pushes(i),
          next.leads().empty() ? geometry::Vec2{} : next.leads()[at(i)]};
}

} // namespace trime::mesh
