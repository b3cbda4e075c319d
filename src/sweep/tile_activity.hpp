// SPDX-License-Identifier: BSD-3-Clause
// Decides which tiles and sites take part in a sweep: where nothing moves, nothing is done.
#pragma once

#include "core/state_fields.hpp"
#include "sites/site_state.hpp"
#include "sweep/site_classes.hpp"
#include "sweep/sweep_kernel.hpp"

#include <atomic>
#include <span>
#include <vector>

namespace trime::sweep {

/// @brief A tile sleeps while three conditions hold: no site of it or of the tiles around it has moved in the last
/// sweep, none of its sites may move for any momentum, and the rule does not change. So the sites of a sleeping tile
/// stay where they would be if it were awake. Tiles do not depend on the number of ranks, so the same tiles sleep on
/// any number of ranks. Tiles have the numbers of KnownBins: owned tiles (`t`) first, then tiles with known ghosts.
class TileActivity {
public:
  /// Both arguments outlive this object.
  TileActivity(const sites::SiteState& state, const delaunay::StarBuilder& builder)
      : state_(state), builder_(builder) {}

  /// Wakes all tiles. Must be called after sites were sorted.
  void reset(const TilesAround& around);
  /// Notes that h has been evaluated again at the owned sites: triangles may now be wider than before.
  void widen(const TilesAround& around);
  /// Wakes all tiles in the next sweep.
  void wake_all() { all_awake_ = true; }
  /// Decides which of the inner tiles, or of the others, take part in this sweep. Must be called for the inner tiles
  /// first.
  void wake(const RuleParameters& rule, TilePlace which, const TilesAround& around);
  /// Ends the decisions: from now on tiles may fall asleep.
  void end_waking() { all_awake_ = false; }
  bool is_awake(std::size_t t) const { return awake_[t]; }
  /// Returns whether this sweep wakes all tiles.
  bool wakes_all() const { return all_awake_; }

  /// Returns whether the next places of a sleeping tile are still those of the last sweep, so that the present places
  /// must be copied to them. May be called once per sweep.
  bool needs_copy(std::size_t t) {
    const bool needs = !copied_[t];
    copied_[t] = 1;
    return needs;
  }
  /// Notes that next places of sites of this tile differ from their present ones. May be called concurrently.
  void note_moves(std::size_t t) { std::atomic_ref(copied_[t]).store(0, std::memory_order_relaxed); }

  /// Sets whether some site of tile t may move (see surely_rests). Different tiles may be set concurrently.
  void set_restless(std::size_t t, bool restless) { restless_[t] = restless; }

  /// Visits the members that a checkpoint keeps: for all tiles, and for owned tile t. Call it between a move and the
  /// next waking.
  void visit(StateFields& fields);
  std::uint64_t saved(std::size_t t) const {
    return (active_[t] ? active_bit : 0) | (wide_[t] ? wide_bit : 0) | (restless_[t] ? restless_bit : 0);
  }
  /// Restores the saved state. @param activity of all tiles of the container @pre reset(), visit()
  void restore(std::span<const std::uint64_t> activity);

  /// Returns how far sites will have moved since the last sorting, after their next move: the largest share of the
  /// narrowest() of their tile.
  static double largest_drift(const mesh::BinnedPoints& points, const TilesAround& around,
                              std::span<const SweepTally> tallies);
  /// Notes how far the sites of the owned tiles will move.
  void begin_move(mesh::BinnedPoints& points, const TilesAround& around, std::span<const SweepTally> tallies);
  /// Notes which tiles of other ranks had moves, after their drifts have arrived.
  void finish_move(const TilesAround& around);
  /// Returns, for each owned tile, whether a neighbour in the ring of one of its sites may move. It counts owned
  /// neighbours after begin_move(), and ghosts after finish_move().
  std::span<const std::uint8_t> near_moves() const { return near_moves_; }

private:
  bool is_any_active(std::span<const LocalIndex> tiles) const;
  void find_near_moves(const TilesAround& around, bool foreign);

  static constexpr std::uint64_t active_bit = 1, wide_bit = 2, restless_bit = 4; // bits of the saved state of a tile
  const sites::SiteState& state_;
  const delaunay::StarBuilder& builder_;
  std::vector<std::uint8_t> awake_;    // by owned tile
  std::vector<std::uint8_t> copied_;   // by owned tile: the next places of its sites are their present ones
  std::vector<std::uint8_t> wide_;     // by owned tile: triangles may reach beyond the tiles around it
  std::vector<std::uint8_t> restless_; // by owned tile: some site may move even if its neighbours do not
  std::vector<std::uint8_t> active_;   // by known tile: the last sweep moved some of its sites
  std::vector<std::uint8_t> near_moves_;
  std::vector<double> drifts_before_; // by tile with ghosts: its drift before the last move
  RuleParameters waking_rule_;        // rule of the last sweep with all tiles awake
  bool all_awake_ = true;             // all tiles wake in the next sweep
};

/// @brief A site falls asleep when it surely rests (surely_rests). It wakes when a neighbour in its ring moves, when
/// its ring changes, or with all sites of its tile. Until then it stays, because its move depends only on its ring, the
/// sizes there and the rule, and none of these has changed.
///
/// The star of a sleeping local site needs no new certificate either, because the lemma depends only on the places of
/// the site and its ring. All other stars are watched: they are certified in each sweep of their tile, whether the site
/// sleeps or not. So places and rings alone decide which sites are awake, on any number of ranks. One byte per site.
class SiteActivity {
public:
  /// Both arguments outlive this object.
  SiteActivity(const sites::SiteState& state, const SiteClasses& classes) : state_(state), classes_(classes) {}

  /// Must be called after sites were sorted; then all tiles must be woken.
  void reset();
  /// Wakes the sites of this tile. Different tiles may be woken concurrently.
  void wake_tile(LocalIndex tile);
  /// Returns the flags of all owned sites, for the kernel.
  std::uint8_t* flags() { return flags_.data(); }
  bool is_awake(LocalIndex i) const { return (flags_[at(i)] & SiteFlags::awake) != 0; }
  /// Returns whether any site of this tile is awake.
  bool any_awake(LocalIndex tile) const;
  void wake(LocalIndex i) { flags_[at(i)] |= SiteFlags::awake; }
  /// Notes that the class of site i has been computed again. Threads may set different sites concurrently.
  void watch(LocalIndex i) { flags_[at(i)] |= SiteFlags::watched; }
  /// Notes that the rule has moved site i, whose star was certified by the empty-circle test. Threads may set different
  /// sites concurrently.
  void set_rest(LocalIndex i, bool rests) {
    flags_[at(i)] = static_cast<std::uint8_t>(SiteFlags::watched | (rests ? 0 : SiteFlags::awake));
  }

  /// Notes which of these sites, whose rings may have changed, must look for moves of their neighbours themselves.
  void note_rings(std::span<const LocalIndex> sites);
  /// @brief Wakes the neighbours of the sites that will move.
  /// @param tallies sums over the moves of each owned tile
  /// @param near_moves see TileActivity::near_moves
  void begin_move(std::span<const SweepTally> tallies, std::span<const std::uint8_t> near_moves);
  /// Wakes the neighbours of ghosts that have moved, after the ghosts have arrived. @pre ghosts were not fetched since
  /// the move
  void finish_move(std::span<const std::uint8_t> near_moves);

private:
  bool has_ghost(LocalIndex i) const;
  void wake_ring(LocalIndex i);
  template <class Moves>
  void look(std::span<const std::uint8_t> near_moves, const Moves& moves);

  const sites::SiteState& state_;
  const SiteClasses& classes_;
  std::vector<std::uint8_t> flags_; // SiteFlags, by owned site
  /// Sites that look for moves of their neighbours themselves. Where the lemma does not hold, the star of a neighbour
  /// may lack this site, and other ranks keep the stars of ghosts. Ascending; a few entries may be superfluous.
  std::vector<LocalIndex> watchers_;
};

} // namespace trime::sweep
