// SPDX-License-Identifier: BSD-3-Clause
// Distributes the patches of a round over the ranks, because most patches lie on the boundary, whose sites belong to
// few ranks.
#pragma once

#include "cleanup/cleanup_choice.hpp"
#include "cleanup/cleanup_sites.hpp"
#include "cleanup/rules.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// All data that the trial of a patch needs, on any rank.
struct PatchTask {
  Contender contender;
  Surroundings around;
};

/// The patches of a round, the same on all ranks.
struct PatchCounts {
  std::int64_t patches = 0; ///< number on all ranks
  std::int64_t threads = 1; ///< number on all ranks
  std::int64_t turns = 0;   ///< largest number of patches of a rank over its threads, rounded up
  /// Returns whether the slowest rank would save CleanupRules::least_spared patches if all ranks had about equally
  /// many.
  bool is_uneven() const { return turns >= (patches + threads - 1) / threads + CleanupRules::least_spared; }
};

/// Tries patches of this rank and of others. Must not throw or communicate. @return a result for each
using PatchTrial = std::function<std::vector<PatchResult>(std::span<PatchTask>)>;

/// @brief Tries the patches of all ranks. If ranks have uneven numbers, patches are sent to other ranks, so that each
/// tries about equally many; a patch and its result have about 20 KB. Collective. Takes O(log(ranks)) steps in addition
/// to the trials.
/// @param own the patches of this rank by number @return their results, in the same order
std::vector<PatchResult> try_shared(const comm::Communicator& comm, const PatchCounts& counts,
                                    std::vector<PatchTask> own, const PatchTrial& trial);

} // namespace trime::cleanup
