// SPDX-License-Identifier: BSD-3-Clause
// Stores for each site whether a sweep moves, pushes or deletes it, and sums the lengths and counts of all moves.
#pragma once

#include "sweep/guard_treatment.hpp"
#include "sweep/site_classes.hpp"

#include <span>
#include <vector>

namespace trime::sweep {

/// Says how a sweep treats a site: it moves it by the update rule, pushes it away from the boundary, or deletes it.
enum class SiteOutcome : std::uint8_t { moved, pushed, deleted };

/// @brief Collects the next places of the sites that the vector kernel has not moved, and sums all moves tile by tile.
/// In a tile where the kernel moved all sites, the sums of the kernel are taken; in other tiles they are computed from
/// the old and the new places.
class MoveOutcomes {
public:
  /// Keeps references to both arguments, which must outlive this object.
  MoveOutcomes(sites::SiteState& state, const SiteClasses& classes) : state_(state), classes_(classes) {}

  /// Must be called after each sorting of the sites.
  void reset();
  /// Sets the outcome of each site to `moved`.
  void forget();
  /// Records the next place of site i. Threads may record different sites concurrently.
  void record(LocalIndex i, const Treated& treated);
  /// Stores the sums that the vector kernel computed for owned tile t.
  void set_tally(std::size_t t, const SweepTally& tally) {
    tallies_[t] = tally;
    has_others_[t] = 0;
  }
  /// Notes that the vector kernel has not moved all sites of owned tile t. May be called concurrently.
  void tally_again(std::size_t t);
  /// Returns the sums over all moves of this rank.
  SweepTally sum();
  std::span<const SweepTally> tallies() const { return tallies_; }

  /// Returns 1 for each owned site that is deleted in this deletion round, and 0 for all other owned sites.
  std::vector<std::uint8_t> deletions(int round) const;
  /// @brief Adds to the push counts of the sites that were pushed, and resets the outcomes.
  /// @return for each owned tile, 1 if some of its sites were pushed and will still be in the diametral circle of a
  /// boundary edge, otherwise 0
  std::vector<std::uint8_t> count_pushes(const polygon::BoundaryGuard& guard);

private:
  SweepTally tally_tile(LocalIndex tile) const;

  sites::SiteState& state_;
  const SiteClasses& classes_;
  std::vector<SiteOutcome> outcomes_;    // by site; all are `moved` in tiles without has_others_
  std::vector<std::uint8_t> has_others_; // by owned tile: 1 if the kernel did not move all of its sites
  std::vector<SweepTally> tallies_;      // by owned tile
};

} // namespace trime::sweep
