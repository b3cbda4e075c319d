// SPDX-License-Identifier: BSD-3-Clause
// Which tiles take part in a sweep: where nothing moves, nothing is done.
#pragma once

#include "core/state_fields.hpp"
#include "sites/site_state.hpp"
#include "sweep/site_classes.hpp"
#include "sweep/sweep_kernel.hpp"
#include "sweep/tiles_around.hpp"

#include <atomic>
#include <span>
#include <vector>

namespace trime::sweep {

/// @brief A tile sleeps while no site of it and of the tiles around it has moved in the last sweep, none of its sites
/// may move once there is momentum, and the rule stays as it is. So a sleeping tile is where an awake one would be.
/// Tiles are the same on any ranks, so that no result depends on which of them sleep. Tiles have the numbers of
/// KnownBins here: owned ones (`t`) first, then tiles with known ghosts.
class TileActivity {
public:
  /// Both arguments outlive this object.
  TileActivity(const sites::SiteState& state, const delaunay::StarBuilder& builder)
      : state_(state), builder_(builder) {}

  /// All tiles wake; to be called after sites were sorted.
  void reset(const TilesAround& around);
  /// Notes that h has been evaluated again at the owned sites: triangles may be wider than before.
  void widen(const TilesAround& around);
  /// All tiles wake in the next sweep.
  void wake_all() { all_awake_ = true; }
  /// Decides which of the tiles that lie so take part in this sweep: first for the inner ones, then for the others.
  void wake(const RuleParameters& rule, TilePlace which, const TilesAround& around);
  /// All tiles have been asked: from now on they may fall asleep.
  void end_waking() { all_awake_ = false; }
  bool is_awake(std::size_t t) const { return awake_[t]; }
  /// Does this sweep wake all tiles, whatever has moved?
  bool wakes_all() const { return all_awake_; }

  /// Do the next places of a sleeping tile hold those of the last sweep, not yet the present ones? Asked once a sweep.
  bool needs_copy(std::size_t t) {
    const bool needs = !copied_[t];
    copied_[t] = 1;
    return needs;
  }
  /// Sites of this tile have got next places of their own. May be called concurrently.
  void note_moves(std::size_t t) { std::atomic_ref(copied_[t]).store(0, std::memory_order_relaxed); }

  /// Some site of tile t does not surely rest, or all do. Different tiles may be set concurrently.
  void set_restless(std::size_t t, bool restless) { restless_[t] = restless; }

  /// Visits the members that a checkpoint keeps: for all tiles, and for owned tile t. Call it between a move and the
  /// next waking.
  void visit(StateFields& fields);
  std::uint64_t saved(std::size_t t) const {
    return (active_[t] ? active_bit : 0) | (wide_[t] ? wide_bit : 0) | (restless_[t] ? restless_bit : 0);
  }
  /// Restores the saved state. @param activity of all tiles of the container @pre reset(), visit()
  void restore(std::span<const std::uint64_t> activity);

  /// How far sites will have come with their next move: the largest share of the narrowest() of their tile.
  static double largest_drift(const mesh::BinnedPoints& points, const TilesAround& around,
                              std::span<const SweepTally> tallies);
  /// Notes that the sites of the owned tiles are going as far as their tallies say.
  void begin_move(mesh::BinnedPoints& points, const TilesAround& around, std::span<const SweepTally> tallies);
  /// Notes which tiles of other ranks had moves, once their drifts are here.
  void finish_move(const TilesAround& around);
  /// By owned tile: may a neighbour in the ring of one of its sites be among those that move? Of owned neighbours since
  /// begin_move(), of ghosts since finish_move().
  std::span<const std::uint8_t> near_moves() const { return near_moves_; }

private:
  bool is_any_active(std::span<const LocalIndex> tiles) const;
  void find_near_moves(const TilesAround& around, bool foreign);

  static constexpr std::uint64_t active_bit = 1, wide_bit = 2, restless_bit = 4; // of what is saved of a tile
  const sites::SiteState& state_;
  const delaunay::StarBuilder& builder_;
  std::vector<std::uint8_t> awake_;    // by owned tile
  std::vector<std::uint8_t> copied_;   // by owned tile: its sites have the same places now and next
  std::vector<std::uint8_t> wide_;     // by owned tile: triangles may reach beyond the tiles around it
  std::vector<std::uint8_t> restless_; // by owned tile: some site may move, though nothing next to it does
  std::vector<std::uint8_t> active_;   // by known tile: sites were moved by the last sweep
  std::vector<std::uint8_t> near_moves_;
  std::vector<double> drifts_before_; // by tile with ghosts: before the last move
  RuleParameters waking_rule_;        // of the last sweep with all tiles awake
  bool all_awake_ = true;             // in the next sweep
};

/// @brief A site falls asleep when it surely rests (surely_rests). It wakes when a neighbour in its ring moves, when
/// its ring changes, or with all sites of its tile. Until then it stays: what a rule makes of it follows from its
/// ring, the sizes there and the rule, and all of these are as they were.
///
/// The star of a sleeping local site needs no new certificate either, since that of the lemma follows from the places
/// of site and ring. All other stars are watched: they are certified in each sweep of their tile, whether the site
/// sleeps or not. So which sites are awake follows from places and rings alone, on any ranks. One byte a site.
class SiteActivity {
public:
  /// Both arguments outlive this object.
  SiteActivity(const sites::SiteState& state, const SiteClasses& classes) : state_(state), classes_(classes) {}

  /// To be called after sites were sorted; then all tiles must be woken.
  void reset();
  /// The sites of this tile wake. Different tiles may be woken concurrently.
  void wake_tile(LocalIndex tile);
  /// The flags of all owned sites, for the kernel.
  std::uint8_t* flags() { return flags_.data(); }
  bool is_awake(LocalIndex i) const { return (flags_[at(i)] & SiteFlags::awake) != 0; }
  /// Is any site of this tile awake?
  bool any_awake(LocalIndex tile) const;
  void wake(LocalIndex i) { flags_[at(i)] |= SiteFlags::awake; }
  /// Notes that the class of site i has been computed again. Threads may set different sites concurrently.
  void watch(LocalIndex i) { flags_[at(i)] |= SiteFlags::watched; }
  /// Notes that the rule has moved site i, whose star was certified by the empty-circle test. Threads may set different
  /// sites concurrently.
  void set_rest(LocalIndex i, bool rests) {
    flags_[at(i)] = static_cast<std::uint8_t>(SiteFlags::watched | (rests ? 0 : SiteFlags::awake));
  }

  /// The rings of these sites may have changed: notes which of them must look for moves themselves.
  void note_rings(std::span<const LocalIndex> sites);
  /// @brief Wakes the neighbours of the sites that are going to move.
  /// @param tallies of the moves of each owned tile
  /// @param near_moves by owned tile, see TileActivity::near_moves
  void begin_move(std::span<const SweepTally> tallies, std::span<const std::uint8_t> near_moves);
  /// Wakes the neighbours of ghosts that have moved, once these are here. @pre ghosts were not fetched since the move
  void finish_move(std::span<const std::uint8_t> near_moves);

private:
  bool has_ghost(LocalIndex i) const;
  void wake_ring(LocalIndex i);
  template <class Moves>
  void look(std::span<const std::uint8_t> near_moves, const Moves& moves);

  const sites::SiteState& state_;
  const SiteClasses& classes_;
  std::vector<std::uint8_t> flags_; // SiteFlags, by owned site
  /// Sites that look for moves of their neighbours: the stars of the neighbours may not show that they are neighbours
  /// where the lemma does not hold, and other ranks keep the stars of ghosts. Ascending; some no longer need it.
  std::vector<LocalIndex> watchers_;
};

} // namespace trime::sweep
