// SPDX-License-Identifier: BSD-3-Clause
// Decides which tiles and sites take part in a sweep: a sweep skips tiles and sites where nothing moves.
#pragma once

#include "core/state_fields.hpp"
#include "sites/site_state.hpp"
#include "sweep/site_classes.hpp"
#include "sweep/sweep_kernel.hpp"

#include <atomic>
#include <span>
#include <vector>

namespace trime::sweep {

/// @brief Decides which tiles sleep, that is, are skipped by the sweeps. A tile sleeps while no site in it or in the
/// tiles around it moved in the last sweep, none of its sites can move for any value of the momentum, and the update
/// rule does not change. So a sleeping tile has the same sites as if it had been swept. Tiles do not depend on the
/// number of ranks, so the same tiles sleep on any number of ranks. Tiles are numbered as in KnownBins: owned tiles
/// (`t`) first, then tiles with known ghosts.
class TileActivity {
public:
  /// Keeps references to both arguments, which must outlive this object.
  TileActivity(const sites::SiteState& state, const delaunay::StarBuilder& builder)
      : state_(state), builder_(builder) {}

  /// Wakes all tiles. Must be called after each sorting of the sites.
  void reset(const TilesAround& around);
  /// Notes that h has been evaluated again at the owned sites. Triangles may now be larger than before.
  void widen(const TilesAround& around);
  /// Makes all tiles take part in the next sweep.
  void wake_all() { all_awake_ = true; }
  /// Decides which of the inner tiles, or which of the tiles at the border of the rank, take part in this sweep. Must
  /// be called for the inner tiles first.
  void wake(const RuleParameters& rule, TilePlace which, const TilesAround& around);
  /// Ends the decisions for this sweep: from now on tiles may fall asleep.
  void end_waking() { all_awake_ = false; }
  bool is_awake(std::size_t t) const { return awake_[t]; }
  /// Returns whether all tiles take part in this sweep.
  bool wakes_all() const { return all_awake_; }

  /// Returns whether the present places of a sleeping tile must be copied to its next places, because these are still
  /// the places of an earlier sweep. May be called once per sweep.
  bool needs_copy(std::size_t t) {
    const bool needs = !copied_[t];
    copied_[t] = 1;
    return needs;
  }
  /// Notes that some sites of tile t have next places that differ from their present ones. May be called concurrently.
  void note_moves(std::size_t t) { std::atomic_ref(copied_[t]).store(0, std::memory_order_relaxed); }

  /// Sets whether some site of tile t may move even if its neighbours do not (see surely_rests). Different tiles may be
  /// set concurrently.
  void set_restless(std::size_t t, bool restless) { restless_[t] = restless; }

  /// Visits the members that are stored in a checkpoint and concern all tiles; saved(t) returns the data of owned tile
  /// t. Call both between a move and the next wake().
  void visit(StateFields& fields);
  std::uint64_t saved(std::size_t t) const {
    return (active_[t] ? active_bit : 0) | (wide_[t] ? wide_bit : 0) | (restless_[t] ? restless_bit : 0);
  }
  /// Restores the saved state.
  /// @param activity the saved data of all tiles of the container
  /// @pre reset() and visit() were called
  void restore(std::span<const std::uint64_t> activity);

  /// Returns the largest distance that sites will have moved since the last sorting, after their next move, divided by
  /// narrowest() of their tile.
  static double largest_drift(const mesh::BinnedPoints& points, const TilesAround& around,
                              std::span<const SweepTally> tallies);
  /// Notes how far the sites of the owned tiles will move.
  void begin_move(mesh::BinnedPoints& points, const TilesAround& around, std::span<const SweepTally> tallies);
  /// Notes which tiles of other ranks had moves, after the drifts of these tiles have arrived.
  void finish_move(const TilesAround& around);
  /// Returns, for each owned tile, whether a neighbour of one of its sites may move. Owned neighbours count after
  /// begin_move(), and ghosts after finish_move().
  std::span<const std::uint8_t> near_moves() const { return near_moves_; }

private:
  bool is_any_active(std::span<const LocalIndex> tiles) const;
  void find_near_moves(const TilesAround& around, bool foreign);

  static constexpr std::uint64_t active_bit = 1, wide_bit = 2, restless_bit = 4; // the bits of a tile's saved state
  const sites::SiteState& state_;
  const delaunay::StarBuilder& builder_;
  std::vector<std::uint8_t> awake_;    // by owned tile
  std::vector<std::uint8_t> copied_;   // by owned tile: 1 if the next places of its sites equal their present ones
  std::vector<std::uint8_t> wide_;     // by owned tile: 1 if triangles may reach beyond the tiles around it
  std::vector<std::uint8_t> restless_; // by owned tile: 1 if some site may move even if its neighbours do not
  std::vector<std::uint8_t> active_;   // by known tile: 1 if the last sweep moved some of its sites
  std::vector<std::uint8_t> near_moves_;
  std::vector<double> drifts_before_; // by tile with ghosts: its drift before the last move
  RuleParameters waking_rule_;        // update rule of the last sweep in which all tiles took part
  bool all_awake_ = true;             // whether all tiles take part in the next sweep
};

/// @brief Decides which sites of an awake tile sleep, that is, are not moved. A site falls asleep when it surely rests
/// (surely_rests). A sleeping site wakes when one of its neighbours moves, when its neighbours change, or when all
/// sites of its tile wake. Until then it stays in place, because its move depends only on its neighbours, their h and
/// the rule, and none of these has changed.
///
/// The star of a sleeping local site needs no new certificate either, because the Delaunay lemma depends only on the
/// places of the site and its neighbours. All other stars are watched: they are certified in each sweep of their tile,
/// even if the site sleeps. So places and neighbours alone decide which sites are awake, and the number of ranks does
/// not matter. Memory: one byte per site.
class SiteActivity {
public:
  /// Keeps references to both arguments, which must outlive this object.
  SiteActivity(const sites::SiteState& state, const SiteClasses& classes) : state_(state), classes_(classes) {}

  /// Must be called after each sorting of the sites; then all tiles must be woken.
  void reset();
  /// Wakes all sites of this tile. Different tiles may be woken concurrently.
  void wake_tile(LocalIndex tile);
  /// Returns the flags of all owned sites, which the kernel reads and writes.
  std::uint8_t* flags() { return flags_.data(); }
  bool is_awake(LocalIndex i) const { return (flags_[at(i)] & SiteFlags::awake) != 0; }
  /// Returns whether any site of this tile is awake.
  bool any_awake(LocalIndex tile) const;
  void wake(LocalIndex i) { flags_[at(i)] |= SiteFlags::awake; }
  /// Notes that the class of site i has been computed again. Threads may call this for different sites concurrently.
  void watch(LocalIndex i) { flags_[at(i)] |= SiteFlags::watched; }
  /// Notes that the update rule has moved site i outside of the kernel, and whether it rests. The site's star was
  /// certified by the empty-circumcircle test. Threads may call this for different sites concurrently.
  void set_rest(LocalIndex i, bool rests) {
    flags_[at(i)] = static_cast<std::uint8_t>(SiteFlags::watched | (rests ? 0 : SiteFlags::awake));
  }

  /// Notes that the neighbours of these sites may have changed, and finds out which of the sites must look for moves of
  /// their neighbours themselves.
  void note_rings(std::span<const LocalIndex> sites);
  /// @brief Wakes the neighbours of the sites that will move in this sweep.
  /// @param tallies sums over the moves, for each owned tile
  /// @param near_moves result of TileActivity::near_moves
  void begin_move(std::span<const SweepTally> tallies, std::span<const std::uint8_t> near_moves);
  /// Wakes the neighbours of ghosts that have moved, after the new places of the ghosts have arrived.
  /// @pre no new ghosts were fetched since the move
  void finish_move(std::span<const std::uint8_t> near_moves);

private:
  bool has_ghost(LocalIndex i) const;
  void wake_ring(LocalIndex i);
  template <class Moves>
  void look(std::span<const std::uint8_t> near_moves, const Moves& moves);

  const sites::SiteState& state_;
  const SiteClasses& classes_;
  std::vector<std::uint8_t> flags_; // SiteFlags, by owned site
  /// Sites that look for moves of their neighbours themselves, ascending. Where the Delaunay lemma does not hold, a
  /// neighbour may not list the site as its neighbour, and the stars of ghosts are kept by other ranks. A few entries
  /// may be superfluous.
  std::vector<LocalIndex> watchers_;
};

} // namespace trime::sweep
