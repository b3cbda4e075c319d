// SPDX-License-Identifier: BSD-3-Clause
// The sites that one rank knows: first its own, then the ghosts, both sorted by tile and bin. Bins of other ranks'
// tiles are known or unknown, and a search reports each unknown bin that it meets. This file uses no MPI and knows no
// triangles.
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

/// @brief The sites and their bins. The state decides which functions may be called:
/// - empty: at first. Only suitable_bin_bits and assign_owned may be called.
/// - grouped: after suitable_bin_bits. Only assign_owned with the same sites and tiles may be called.
/// - sorted: after assign_owned, sort_moved and edit. Everything may be called except advance, sort_moved and functions
/// that need next places.
/// - prepared: after prepare_advance. All functions may be called. `advance` leads back to sorted, but with the old
/// bins, so the caller must set the drifts. release_leads also leads back to sorted, and so does sort_moved, with fresh
/// bins. After other ghosts are assigned, places must be prepared again before `advance`.
/// - released: after release_moves. Only positions, boundary, tile_range and assign_owned may be called. Functions that
/// change the state assert it; queries of single sites and bins do not.
class BinnedPoints {
public:
  /// @pre `grid` outlives this object
  explicit BinnedPoints(const TileGrid& grid);

  const TileGrid& grid() const { return bins_.grid(); }

  /// @brief Replaces the owned sites: those of tiles [first_tile, last_tile). Sorts them by tile and bin. Of sites at
  /// equal coordinates it keeps one: a boundary site if there is one, otherwise the one that was pushed most often.
  /// Forgets the ghosts.
  /// @param new_index if not null, receives the new local index of each input site, -1 if it was dropped
  /// @return the number of dropped sites. O(n), by all threads.
  LocalIndex assign_owned(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile,
                          std::vector<LocalIndex>* new_index = nullptr);

  /// @brief As assign_owned, for sites that have moved since they were sorted: each stays in its tile, in the bin of
  /// that tile which is nearest to it. No site is dropped.
  /// @param counts number of sites of each tile; the sites come tile by tile
  void restore_owned(std::span<const Site> sites, std::span<const std::int64_t> counts, LocalIndex first_tile,
                     LocalIndex last_tile, std::vector<LocalIndex>& new_index);

  /// @brief Replaces the ghosts: `bins` (ascending; of foreign tiles, or of images of any tile) become known. Bin k
  /// holds counts[k] sites. `sites` has the sites of all bins at their places in the container; this function moves
  /// them to their images.
  void assign_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts, std::span<const Ghost> sites);
  /// Adds ghosts behind the present ones, which keep their local indices. @pre none of these bins is known
  void add_ghosts(std::span<const BinRef> bins, std::span<const std::int32_t> counts, std::span<const Ghost> sites);

  LocalIndex owned() const { return owned_; }
  LocalIndex size() const { return static_cast<LocalIndex>(positions_.size()); }
  std::span<const geometry::Vec2> positions() const { return positions_; }
  geometry::Vec2 position(LocalIndex i) const { return positions_[at(i)]; }
  /// Returns the index among the boundary sites, or a negative number if site i lies inside, see Site::boundary.
  std::int32_t boundary(LocalIndex i) const { return boundary_[at(i)]; }
  std::span<const std::int32_t> boundaries() const { return boundary_; }
  /// @pre site i is owned
  Site site(LocalIndex i) const {
    const std::size_t at = static_cast<std::size_t>(i);
    return {positions_[at], boundary_[at], pushes_[at], leads_.empty() ? geometry::Vec2{} : leads_[at]};
  }

  LocalIndex first_tile() const { return order_.first_tile(); }
  LocalIndex last_tile() const { return order_.last_tile(); }
  /// Returns the sites of an owned tile.
  SiteRange tile_range(LocalIndex tile) const { return order_.of_tile(tile); }
  /// Returns the number of a tile that has a known bin, or -1: see KnownBins. Drifts are indexed by it.
  LocalIndex known_tile(LocalIndex tile) const { return bins_.known_tile(tile); }
  LocalIndex known_tiles() const { return bins_.known_tiles(); }
  /// Returns the sites of a bin; empty if the bin is unknown.
  SiteRange bin_range(BinRef bin) const { return bins_.range(bin); }
  /// Visits the bins of the ghosts, see KnownBins::for_each_foreign.
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
  /// @post assign_owned with the same sites and tiles must come next; another number of sites is an InternalError
  std::vector<std::uint8_t> suitable_bin_bits(std::span<const Site> sites, LocalIndex first_tile, LocalIndex last_tile);

  /// @brief The places to which the owned sites move at the next `advance`. That does not sort the sites: the bins stay
  /// those of the last assign_owned, and for_each_near searches farther by the distance that sites may have moved since
  /// (the drift of their tile).
  NextPlaces& next() { return next_; }
  const NextPlaces& next() const { return next_; }
  std::span<const geometry::Vec2> leads() const { return leads_; }
  /// Makes room for the next places, but does not set them.
  void prepare_advance();
  /// Moves the owned sites to their next places; the ghosts stay.
  void advance();
  /// @brief Sorts the owned sites at their next places as assign_owned does, with the same tiles. Leaves out the sites
  /// that are gone, and adds `more`. Afterwards there are no next places. Needs 9 bytes per site in addition to the
  /// sites and their next places.
  /// @param new_index receives the new local index of each owned site, then of each of `more`; -1 if it is gone or
  /// dropped
  /// @param gone 1 for each owned site that is left out, by local index; empty if none is @pre all sites lie in the
  /// owned tiles
  void sort_moved(std::span<const std::uint8_t> gone, std::span<const Site> more, std::vector<LocalIndex>& new_index);
  /// @brief Removes some of the owned sites and inserts others. Places, bins and order become those that sort_moved
  /// would give, but only the new sites are sorted. Forgets the ghosts. O(edits log edits), and one copy of the sites
  /// and bins behind the first edit.
  /// @param gone local indices, ascending, each once @param come new sites in the owned tiles
  /// @param new_index receives the local index of each of `come`, -1 if it was dropped because another site lies at its
  /// place
  /// @pre sites have not moved since they were sorted, and leads are released
  IndexShift edit(std::vector<LocalIndex> gone, std::span<const Site> come, std::vector<LocalIndex>& new_index);
  /// Bounds on how far sites have moved since they were sorted; searches go farther by these distances.
  const Drifts& drifts() const { return drifts_; }
  Drifts& drifts() { return drifts_; }
  const TileMarks& marks() const { return marks_; }
  TileMarks& marks() { return marks_; }
  void set_pushes(LocalIndex i, std::int32_t pushes) {
    pushes_[at(i)] = static_cast<std::uint8_t>(std::min(pushes, 255));
  }
  void set_boundary(LocalIndex i, std::int32_t boundary) { boundary_[at(i)] = boundary; }
  std::int32_t pushes(LocalIndex i) const { return pushes_[at(i)]; }
  /// Returns the places of the ghosts, which the halo sets after their owners have moved them.
  std::span<geometry::Vec2> ghost_positions() {
    return std::span(positions_).subspan(static_cast<std::size_t>(owned_));
  }

  /// Frees the leads, and ignores those of arriving sites, because no rule moves sites from now on. @post until
  /// assign_owned, leads() and next().leads() are empty, and site() has the lead 0
  void release_leads();
  bool has_leads() const { return has_leads_; }
  /// Frees the bins, and all data that only moving sites need. @post the state is released, see above
  void release_moves();

private:
  enum class State { empty, grouped, sorted, prepared, released };
  template <class Sites>
  LocalIndex sort(const Sites& sites);
  /// A site that is inserted.
  struct Newcomer {
    BinRef bin;
    LocalIndex number, place; // index in the list of new sites; owned site before which it is inserted
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

/// Prepares an advance in which every owned site stays, until the caller changes its next place. Uses all threads.
void prepare_to_stay(BinnedPoints& points);

/// Returns an owned site at its next place, with all data that travel with it. @pre next places are set
inline Site next_site(const BinnedPoints& points, LocalIndex i) {
  const NextPlaces& next = points.next();
  return {next.positions()[at(i)], points.boundary(i), points.pushes(i),
          next.leads().empty() ? geometry::Vec2{} : next.leads()[at(i)]};
}

} // namespace trime::mesh
