// SPDX-License-Identifier: BSD-3-Clause
// Which sites of the awake tiles take part in a sweep.
#pragma once

#include "sites/site_state.hpp"
#include "sweep/site_classes.hpp"
#include "sweep/sweep_kernel.hpp"

#include <atomic>
#include <span>
#include <vector>

namespace trime::sweep {

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
