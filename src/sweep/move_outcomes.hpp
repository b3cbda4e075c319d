// SPDX-License-Identifier: BSD-3-Clause
// The outcome of a sweep for each site, and the sums over all moves.
#pragma once

#include "sweep/guard_treatment.hpp"
#include "sweep/site_classes.hpp"

#include <span>
#include <vector>

namespace trime::sweep {

/// The outcome for a site.
enum class SiteOutcome : std::uint8_t { moved, pushed, deleted };

/// @brief Collects the next places of the sites that the kernel has not moved alone, and tallies all moves tile by
/// tile. The kernel tallies its own tiles; those with other sites among them are tallied again, from their places.
class MoveOutcomes {
public:
  /// Both arguments outlive this object.
  MoveOutcomes(sites::SiteState& state, const SiteClasses& classes) : state_(state), classes_(classes) {}

  /// To be called after sites were sorted.
  void reset();
  /// All sites count as moved.
  void forget();
  /// Site i goes where its treatment says. Different sites may be recorded concurrently.
  void record(LocalIndex i, const Treated& treated);
  /// The tally of owned tile t, as the kernel has it.
  void set_tally(std::size_t t, const SweepTally& tally) {
    tallies_[t] = tally;
    has_others_[t] = 0;
  }
  /// Not all sites of owned tile t were moved by the kernel. May be called concurrently.
  void tally_again(std::size_t t);
  /// The sums over all moves of this rank.
  SweepTally sum();
  std::span<const SweepTally> tallies() const { return tallies_; }

  /// Which of the sites to be deleted are deleted in this round, by owned site.
  std::vector<std::uint8_t> deletions(int round) const;
  /// @brief Counts the pushes of the sites that were pushed, and forgets what became of sites.
  /// @return by owned tile: some of its sites were pushed, and still go to a place in a disc
  std::vector<std::uint8_t> count_pushes(const polygon::BoundaryGuard& guard);

private:
  SweepTally tally_tile(LocalIndex tile) const;

  sites::SiteState& state_;
  const SiteClasses& classes_;
  std::vector<SiteOutcome> outcomes_;    // by site; other than `moved` only in tiles with has_others_
  std::vector<std::uint8_t> has_others_; // by owned tile: not all of its sites were moved by the kernel
  std::vector<SweepTally> tallies_;      // by owned tile
};

} // namespace trime::sweep
