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
/// CleanupRules::largest_loss below that of the beginning. The same on every rank.
class CleanupLimits {
public:
  /// @param sites over all ranks @param most_points 0: CleanupRules::largest_loss above `sites`
  CleanupLimits(GlobalId sites, GlobalId most_points);

  /// The number of sites has changed.
  void add(GlobalId gain) { sites_ += gain; }

  /// @brief What each patch of a round may do: a share of what the limits leave.
  /// @param patches of the round, over all ranks
  PatchBudget budget(GlobalId patches, int stage, double again_alpha) const;

  /// @brief Takes the edits back where the patches of a round would leave the limits together: the worst places come
  /// first, and a patch that adds may where another one takes. Those that are put off may try again. Collective.
  /// @param chosen the own patches, with their results
  void keep_within(const comm::Communicator& comm, std::span<const Contender> chosen,
                   std::vector<PatchResult>& results) const;

private:
  GlobalId room(int stage) const;

  GlobalId most_points_, least_sites_, wanted_sites_, sites_;
};

} // namespace trime::cleanup
