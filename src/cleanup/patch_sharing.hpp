// SPDX-License-Identifier: BSD-3-Clause
// Distributes the patches of a round over the ranks: sites on the boundary, where most patches lie, belong to few
// ranks.
#pragma once

#include "cleanup/cleanup_choice.hpp"
#include "cleanup/cleanup_sites.hpp"
#include "cleanup/rules.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// All that the trial of a patch asks for, on whichever rank.
struct PatchTask {
  Contender contender;
  Surroundings around;
};

/// The patches of a round, the same on all ranks.
struct PatchCounts {
  std::int64_t patches = 0; ///< of all ranks
  std::int64_t threads = 1; ///< of all ranks
  std::int64_t turns = 0;   ///< most patches of a rank over its threads, rounded up
  /// Would the slowest rank save CleanupRules::least_spared patches if all ranks had about equally many?
  bool is_uneven() const { return turns >= (patches + threads - 1) / threads + CleanupRules::least_spared; }
};

/// Tries patches of this rank and of others. Must not throw or communicate. @return a result for each
using PatchTrial = std::function<std::vector<PatchResult>(std::span<PatchTask>)>;

/// @brief Has the patches of this rank tried by this rank, or, if ranks have uneven numbers, by all ranks, about
/// equally many each. Then a patch and its result are sent, about 20 KB together. Collective. Takes O(log(ranks)) steps
/// and the trials.
/// @param own by number @return the results, in the same order
std::vector<PatchResult> try_shared(const comm::Communicator& comm, const PatchCounts& counts,
                                    std::vector<PatchTask> own, const PatchTrial& trial);

} // namespace trime::cleanup
