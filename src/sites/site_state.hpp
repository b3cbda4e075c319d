// SPDX-License-Identifier: BSD-3-Clause
// The sites of a run and what holds them together over the ranks: grid, partition, halo, stars.
#pragma once

#include "decomposition/halo.hpp"
#include "decomposition/migration.hpp"
#include "delaunay/star_builder.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/local_sizes.hpp"
#include "sites/saved_sites.hpp"
#include "sites/star_view.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/sizing/size_field.hpp"

#include <vector>

namespace trime::sites {

/// Which stars are to be computed.
enum class Wanted { inner_sites, all_sites };

/// A place and how far around it sites must be known.
struct Disc {
  geometry::Vec2 center;
  double radius;
};

/// @brief Owned and ghost sites with their stars. The state says which calls are allowed; those that change it check
/// it:
/// - empty: at first. Only share_out, distribute and restore.
/// - sorted: after distribute and move_sites. The owned sites are in order, the ghosts are not here, and no star is
///   certain. Only refresh, compute_stars, forget_sizes, distribute, move_sites and edit_sites.
/// - complete: after refresh, compute_stars, restore, edit_sites and finish_advance. All except share_out and
///   finish_advance.
/// - advancing: after begin_advance. The owned sites are at their next places, the ghosts on their way. Only
///   finish_advance, and questions about sites that no ghost is near.
/// - released: after release_work_space. Only questions, and h is not known any more.
class SiteState {
public:
  /// @param box that holds all sites, now and later
  SiteState(const comm::Communicator& comm, const geometry::Box& box, const mesh::GridOptions& grid_options);
  /// @brief The sites of another state at their present places, sorted, without stars; that state stays as it is.
  /// Collective.
  explicit SiteState(const SiteState& other);

  /// @brief Other tiles, and who is to fill them with sites: ranks get about equal weights. Before there are sites. The
  /// arguments are the same on all ranks.
  void share_out(std::vector<mesh::Tile> tiles, std::span<const std::int64_t> weights);
  /// First sites, from any ranks: fits the tiles to them and partitions these by their counts. Collective.
  /// @throws ConfigError on all ranks if one would own more sites than a local index can count
  void distribute(mesh::SiteList sites);
  /// @brief The sites of a checkpoint, with the tiles and bins that they had, shared out among these ranks. Their stars
  /// are not known. Collective.
  /// @throws FileError on all ranks as `load`, or if the sites do not fit the tiles; ConfigError as distribute
  void restore(const SavedTiles& saved, const SiteLoader& load, const sizing::SizeField& size);
  /// @brief Moves the owned sites to BinnedPoints::next, except those that are gone (by local index; empty: no sites),
  /// and adds new sites, whichever rank owns their places. Migrates, sorts, keeps the rings. Collective.
  void move_sites(std::vector<std::uint8_t> gone = {}, mesh::SiteList more = {});

  /// @brief Has the effect of move_sites where few of the owned sites go, and a few come to the tiles of this rank:
  /// keeps order, h and rings in place. Without periods, stars that nothing near has changed stay certain. Fetches the
  /// ghosts. Collective among neighbours. O(edits log edits), and a pass at the speed of memory over the owned sites.
  /// @param builder of the stars that are certain
  /// @param gone ascending, each once
  /// @param sizes h at each that comes, that of the stage
  /// @pre sites were sorted and have not moved since; their leads are released, and h of the owned ones is known
  void edit_sites(const delaunay::StarBuilder& builder, std::vector<LocalIndex> gone, mesh::SiteList come,
                  std::span<const double> sizes);

  /// @brief Refreshes the halo and the sizes and computes the wanted stars, asking for more bins until every one is
  /// certain. Collective.
  /// @param size the same field in all calls: h of sites that stay in place is not evaluated again
  /// @throws GeometryError on all ranks together if h at a site is not positive and finite
  delaunay::StarPass compute_stars(const delaunay::StarBuilder& builder, const sizing::SizeField& size, Wanted wanted);

  /// Does the same for some stars: `wanted` by local index of the owned sites.
  delaunay::StarPass compute_stars(const delaunay::StarBuilder& builder, const sizing::SizeField& size,
                                   std::span<const delaunay::StarWish> wanted);
  /// @brief Fetches the ghosts after a change of sites and evaluates h at sites that moved; part of compute_stars.
  /// Collective.
  void refresh(const sizing::SizeField& size);
  /// Makes the next move evaluate h again, also at sites that stay: their h may be older than their place.
  void forget_sizes();
  /// @brief Moves the owned sites to BinnedPoints::next, without sorting. The ghosts follow on their way:
  /// nothing about them may be asked until finish_advance. Collective. @pre no periods
  /// @param drift of any site of any rank, with this move
  /// @param new_sizes evaluates h at the new places; else sites keep theirs
  void begin_advance(const sizing::SizeField& size, const mesh::DriftBound& drift, bool new_sizes);
  void finish_advance(const sizing::SizeField& size);
  /// Adds bins to those that this rank knows; their ghosts come behind the others. Collective.
  void fetch(std::span<const mesh::BinRef> missing, const sizing::SizeField& size);

  const mesh::TileGrid& grid() const { return grid_; }
  const mesh::BinnedPoints& points() const { return points_; }
  mesh::BinnedPoints& points() { return points_; }
  const delaunay::StarTable& stars() const { return stars_; }
  delaunay::StarTable& stars() { return stars_; }
  /// h at every known site since the last compute_stars; unknown after a move.
  const mesh::LocalSizes& sizes() const { return sizes_; }
  const decomposition::Halo& halo() const { return halo_; }
  const decomposition::Partition& partition() const { return partition_; }
  const comm::Communicator& comm() const { return comm_; }
  /// Frees what only further moves would need: there must be none.
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
  bool ghosts_need_sizes_ = false; // once they have come; while advancing
  std::vector<double> carried_;    // h of owned sites from before a move, 0 where they moved
};

/// Points, stars and sizes, as an update rule sees them. @param size the field of the last compute_stars
inline StarView view_of(const SiteState& state, const sizing::SizeField& size) {
  return {state.points(), state.stars(), size, &state.sizes()};
}

} // namespace trime::sites
