// SPDX-License-Identifier: BSD-3-Clause
// Limits how many sites the clean-up may add and remove.
#pragma once

#include "cleanup/cleanup_candidates.hpp"
#include "cleanup/patch_data.hpp"
#include "trime/comm/communicator.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief The number of sites over all ranks and its limits. It never exceeds the largest allowed number, and never
/// falls below the first number by more than CleanupRules::largest_loss. All ranks have the same numbers.
class CleanupLimits {
public:
  /// @param number of sites over all ranks @param most_points largest number; 0 means CleanupRules::largest_loss above
  /// `sites`
  CleanupLimits(GlobalId sites, GlobalId most_points);

  /// Returns what each patch of a round may do within the limits.
  PatchBudget budget(int stage, double again_alpha) const;

  /// @brief Numbers of sites that patches add, and that patches remove.
  struct Gains {
    std::int64_t added = 0, taken = 0;
  };
  static Gains gains_of(std::span<const PatchResult> results);

  /// @brief Counts the sites of a round. If the patches together would exceed the limits, it drops the edits of some:
  /// the worst places come first, and a patch may add sites that others remove. Patches that are put off may try again.
  /// Collective only if edits are dropped.
  /// @param all gains over all ranks @param chosen the patches of this rank, with their results
  void count(const comm::Communicator& comm, const Gains& all, std::span<const ChosenContender> chosen,
             std::vector<PatchResult>& results);

private:
  GlobalId room(int stage) const;

  GlobalId most_points_, least_sites_, wanted_sites_, sites_;
};

} // namespace trime::cleanup
