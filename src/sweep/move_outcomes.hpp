// SPDX-License-Identifier: BSD-3-Clause
// Stores the outcome of a sweep for each site, and the sums over all moves.
#pragma once

#include "sweep/guard_treatment.hpp"
#include "sweep/site_classes.hpp"

#include <span>
#include <vector>

namespace trime::sweep {

/// The outcome for a site.
enum class SiteOutcome : std::uint8_t { moved, pushed, deleted };

/// @brief Collects the next places of sites that the kernel has not moved, and sums all moves tile by tile. The kernel
/// gives the sums of tiles in which it moved all sites; those of other tiles are computed again from the places.
class MoveOutcomes {
public:
  /// Both arguments outlive this object.
  MoveOutcomes(sites::SiteState& state, const SiteClasses& classes) : state_(state), classes_(classes) {}

  /// Must be called after sites were sorted.
  void reset();
  /// Resets all outcomes to `moved`.
  void forget();
  /// Records the next place of site i. Different sites may be recorded concurrently.
  void record(LocalIndex i, const Treated& treated);
  /// Sets the sums of the kernel for owned tile t.
  void set_tally(std::size_t t, const SweepTally& tally) {
    tallies_[t] = tally;
    has_others_[t] = 0;
  }
  /// Notes that the kernel has not moved all sites of owned tile t. May be called concurrently.
  void tally_again(std::size_t t);
  /// Returns the sums over all moves of this rank.
  SweepTally sum();
  std::span<const SweepTally> tallies() const { return tallies_; }

  /// Returns 1 for each owned site that is deleted in this round, and 0 for the others.
  std::vector<std::uint8_t> deletions(int round) const;
  /// @brief Adds to the push counts of the sites that were pushed, and forgets the outcomes.
  /// @return for each owned tile, 1 if some of its sites were pushed and will still be in a disc
  std::vector<std::uint8_t> count_pushes(const polygon::BoundaryGuard& guard);

private:
  SweepTally tally_tile(LocalIndex tile) const;

  sites::SiteState& state_;
  const SiteClasses& classes_;
  std::vector<SiteOutcome> outcomes_;    // by site; all are `moved` in tiles without has_others_
  std::vector<std::uint8_t> has_others_; // by owned tile: not all of its sites were moved by the kernel
  std::vector<SweepTally> tallies_;      // by owned tile
};

} // namespace trime::sweep
