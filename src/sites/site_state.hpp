// SPDX-License-Identifier: BSD-3-Clause
// The distributed state of the sites of a run: grid, partition, halo, stars. Also defines the view through which update
// rules and measurements read stars, and the sites of a checkpoint, from which a state is restored.
#pragma once

#include "decomposition/halo.hpp"
#include "decomposition/migration.hpp"
#include "delaunay/star_builder.hpp"
#include "delaunay/star_table.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/drifts.hpp"
#include "mesh/site.hpp"
#include "mesh/tile_tree.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace trime::sites {

/// The tiles in a checkpoint, in the order of the Hilbert curve; the same on all ranks.
struct SavedTiles {
  std::vector<mesh::Tile> tiles;
  std::vector<std::int64_t> counts; ///< number of sites that were sorted into each tile
  std::vector<double> drifts;       ///< upper bound on how far these sites may have moved since then, in domain units
  std::vector<std::uint64_t> activity; ///< activity of each tile in the sweeps, see TileActivity
  mesh::DriftBound largest;            ///< bound for all tiles
};

/// The sites of consecutive tiles, ordered by tile. The sites may have left the tiles into which they were sorted.
struct SavedSites {
  mesh::SiteList sites;
  std::vector<double> sizes; ///< target edge length h of each site; empty if the size is uniform
};

/// A function that fetches rows [first, first + count) of all sites in a checkpoint. Does not communicate.
/// @throws FileError if they cannot be read
using SiteLoader = std::function<SavedSites(std::int64_t first, std::int64_t count)>;

/// Certified stars around the inner sites, and the target edge length h.
class StarView {
public:
  /// @param sizes h at the sites, as far as it is known; if null, the size field is evaluated
  StarView(const mesh::BinnedPoints& all_points, const delaunay::StarTable& all_stars, const sizing::SizeField& field,
           const mesh::LocalSizes* sizes = nullptr)
      : points(all_points), stars(all_stars), size_(field), sizes_(sizes), is_uniform_(field.is_uniform()),
        uniform_size_(is_uniform_ ? field.size({}) : 0) {}

  bool is_uniform() const { return is_uniform_; }
  /// Returns h at any point, or at a periodic image of a point.
  double size(geometry::Vec2 p) const {
    return is_uniform_ ? uniform_size_ : size_.size(points.grid().periods().wrap(p));
  }
  /// Returns h at site i, owned or ghost. The value has the same bits as size(points.position(i)); stored values are
  /// used where they are known.
  double size(LocalIndex i) const { return sizes_ && sizes_->known(i) ? (*sizes_)[i] : size(points.position(i)); }

  const mesh::BinnedPoints& points;
  const delaunay::StarTable& stars;

private:
  const sizing::SizeField& size_;
  const mesh::LocalSizes* sizes_;
  bool is_uniform_;
  double uniform_size_;
};

/// Which stars to compute: those of all sites, or only of sites that are not on the boundary.
enum class Wanted { inner_sites, all_sites };

/// A disc in which a rank must know all sites.
struct Disc {
  geometry::Vec2 center;
  double radius;
};

/// @brief Owned and ghost sites with their stars. The state decides which functions may be called; functions that
/// change it assert it:
/// - empty: the state after construction. Only share_out, distribute and restore may be called.
/// - sorted: the state after distribute and move_sites. The owned sites are sorted, the ghosts are missing, and no star
///   is certain. Only refresh, compute_stars, forget_sizes, distribute, move_sites and edit_sites may be called.
/// - complete: the state after refresh, compute_stars, restore, edit_sites and finish_advance. All functions except
///   share_out and finish_advance may be called.
/// - advancing: the state after begin_advance. The owned sites are at their next places, and the ghosts are still being
///   sent. Only finish_advance and queries about sites far from all ghosts may be called.
/// - released: the state after release_work_space. Only queries may be called, and h is not known.
class SiteState {
public:
  /// @param box contains all sites during the whole run
  SiteState(const comm::Communicator& comm, const geometry::Box& box, const mesh::GridOptions& grid_options);
  /// @brief Copies the sites of another state at their present places, sorted and without stars. Collective.
  explicit SiteState(const SiteState& other);

  /// @brief Replaces the tiles before sites exist, and distributes the tiles so that ranks get about equal weights. The
  /// arguments must be the same on all ranks.
  void share_out(std::vector<mesh::Tile> tiles, std::span<const std::int64_t> weights);
  /// Takes the first sites, each from any rank. Fits the tiles to them, and distributes the tiles over the ranks by
  /// their numbers of sites. Collective.
  /// @throws ConfigError on all ranks if a rank would own more sites than a local index can count
  void distribute(mesh::SiteList sites);
  /// @brief Distributes the sites of a checkpoint over the ranks, in the tiles and bins that they had. The stars of the
  /// sites are not known afterwards. Collective.
  /// @throws FileError on all ranks if `load` throws or the sites do not fit the tiles; ConfigError under the
  /// conditions of distribute
  void restore(const SavedTiles& saved, const SiteLoader& load, const sizing::SizeField& size);
  /// @brief Moves the owned sites to BinnedPoints::next, removes some, and adds the sites `more`, which may lie in
  /// tiles of any rank. Sends sites to their new owners, sorts them, and keeps their rings of neighbours. Collective.
  /// @param gone 1 for each owned site to be removed, by local index; empty if no site is removed
  void move_sites(std::vector<std::uint8_t> gone = {}, mesh::SiteList more = {});

  /// @brief Does the same as move_sites for the case that few of the owned sites are removed and few are added in the
  /// tiles of this rank. Changes order, h and rings in place. If the container is not periodic, stars without a change
  /// nearby stay certain. Fetches the ghosts. Collective among neighbours. Cost: O(edits log edits), and one copy of
  /// the data of the owned sites.
  /// @param builder the builder that made the certain stars
  /// @param gone local indices of the sites to be removed, ascending, each once
  /// @param sizes target edge length h at each new site
  /// @pre sites have not moved since they were sorted, and h at the owned sites is known
  void edit_sites(const delaunay::StarBuilder& builder, std::vector<LocalIndex> gone, mesh::SiteList come,
                  std::span<const double> sizes);

  /// @brief Refreshes the halo and the sizes, and computes the wanted stars; fetches more bins until all of these stars
  /// are certain. Collective.
  /// @param size must be the same field in all calls, because h of a site that stays in place is not evaluated again
  /// @throws GeometryError on all ranks together if h at a site is not positive and finite
  delaunay::StarPass compute_stars(const delaunay::StarBuilder& builder, const sizing::SizeField& size, Wanted wanted);

  /// Does the same; `wanted` has one entry for each owned site.
  delaunay::StarPass compute_stars(const delaunay::StarBuilder& builder, const sizing::SizeField& size,
                                   std::span<const delaunay::StarWish> wanted);
  /// @brief Fetches the ghosts after a change of sites, and evaluates h at sites that have moved. compute_stars does
  /// this, too. Collective.
  void refresh(const sizing::SizeField& size);
  /// Makes the next move evaluate h at all sites, even at sites that stay, whose h may belong to an earlier place.
  void forget_sizes();
  /// @brief Moves the owned sites to BinnedPoints::next without sorting, and sends their places to other ranks. The
  /// ghosts must not be used until finish_advance is called. Collective.
  /// @pre the container is not periodic
  /// @param drift upper bound on the drift of any site of any rank, including this move
  /// @param new_sizes true to evaluate h at the new places; otherwise sites keep their h
  void begin_advance(const sizing::SizeField& size, const mesh::DriftBound& drift, bool new_sizes);
  void finish_advance(const sizing::SizeField& size);
  /// Fetches more bins; their ghosts are appended to the others. Collective.
  void fetch(std::span<const mesh::BinRef> missing, const sizing::SizeField& size);

  const mesh::TileGrid& grid() const { return grid_; }
  const mesh::BinnedPoints& points() const { return points_; }
  mesh::BinnedPoints& points() { return points_; }
  const delaunay::StarTable& stars() const { return stars_; }
  delaunay::StarTable& stars() { return stars_; }
  /// Returns h at every known site as of the last compute_stars; unknown after a move.
  const mesh::LocalSizes& sizes() const { return sizes_; }
  const decomposition::Halo& halo() const { return halo_; }
  const decomposition::Partition& partition() const { return partition_; }
  const comm::Communicator& comm() const { return comm_; }
  /// Frees the data that only further moves need. Sites must not move afterwards.
  void release_work_space();

private:
  enum class State { empty, sorted, complete, advancing, released };

  bool has_sites() const { return state_ == State::sorted || state_ == State::complete; }
  void check_counts(std::span<const std::int64_t> weights) const;
  int halo_margin() const;
  void count_sites() const;
  void wrap(mesh::SiteList& sites) const;
  void wrap_next();
  void list_leaving(std::vector<std::uint8_t>& gone, mesh::SiteList& leaving) const;
  void choose_bins(std::span<const mesh::Site> sites);
  void evaluate_agreed(const sizing::SizeField& size, LocalIndex end);
  void remember_sizes();
  void carry_sizes(std::span<const LocalIndex> new_index);
  void evaluate_sizes(const sizing::SizeField& size, LocalIndex end);
  void evaluate_blocks(const sizing::SizeField& size, LocalIndex first, LocalIndex end);
  double carried_size(LocalIndex site) const;
  void restore_drifts(const SavedTiles& saved);
  void restore_sizes(const std::vector<double>& sizes, std::span<const LocalIndex> new_index,
                     const sizing::SizeField& size);

  const comm::Communicator& comm_;
  mesh::TileGrid grid_;
  decomposition::Partition partition_;
  mesh::BinnedPoints points_;
  decomposition::Halo halo_;
  delaunay::StarTable stars_;
  mesh::LocalSizes sizes_;
  std::vector<delaunay::StarWish> wanted_;
  State state_ = State::empty;
  bool ghosts_need_sizes_ = false; // true while advancing, if h must be evaluated after the ghosts have arrived
  std::vector<double> carried_;    // h of owned sites before a move; 0 for sites that moved
};

/// Returns points, stars and sizes in the form that update rules use.
/// @param size the size field of the last call of compute_stars
inline StarView view_of(const SiteState& state, const sizing::SizeField& size) {
  return {state.points(), state.stars(), size, &state.sizes()};
}

} // namespace trime::sites
