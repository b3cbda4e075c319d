// SPDX-License-Identifier: BSD-3-Clause
// How many sites the clean-up may add and take.
#pragma once

#include "cleanup/cleanup_candidates.hpp"
#include "cleanup/patch_data.hpp"
#include "trime/comm/communicator.hpp"

#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief The number of sites over all ranks and its limits: never above what is allowed, and at most
/// CleanupRules::largest_loss below that of the beginning. All ranks have the same numbers.
class CleanupLimits {
public:
  /// @param sites over all ranks @param most_points 0: CleanupRules::largest_loss above `sites`
  CleanupLimits(GlobalId sites, GlobalId most_points);

  /// Returns what each patch of a round may do within the limits.
  PatchBudget budget(int stage, double again_alpha) const;

  /// @brief Sites that patches add and take: of those that gain sites, and of those that lose some.
  struct Gains {
    std::int64_t added = 0, taken = 0;
  };
  static Gains gains_of(std::span<const PatchResult> results);

  /// @brief Counts the sites of a round. Takes the edits back where the patches would leave the limits together: the
  /// worst places come first, and a patch that adds may where another one takes. Those that are put off may try again.
  /// Collective only where edits are taken back.
  /// @param all gains over all ranks @param chosen the own patches, with their results
  void count(const comm::Communicator& comm, const Gains& all, std::span<const ChosenContender> chosen,
             std::vector<PatchResult>& results);

private:
  GlobalId room(int stage) const;

  GlobalId most_points_, least_sites_, wanted_sites_, sites_;
};

} // namespace trime::cleanup
