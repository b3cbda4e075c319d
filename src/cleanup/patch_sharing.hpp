// SPDX-License-Identifier: BSD-3-Clause
// Distributes the patches of a round over the ranks. Most patches lie on the boundary, whose sites belong to few ranks,
// so without distribution most ranks would wait.
#pragma once

#include "cleanup/cleanup_choice.hpp"
#include "cleanup/cleanup_sites.hpp"
#include "cleanup/rules.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace trime::cleanup {

/// All data that a rank needs to try a patch.
struct PatchTask {
  Contender contender;
  Surroundings around;
};

/// Numbers that describe the patches of a round; they are the same on all ranks.
struct PatchCounts {
  std::int64_t patches = 0; ///< number of patches on all ranks
  std::int64_t threads = 1; ///< number of threads on all ranks
  std::int64_t turns = 0;   ///< largest value over the ranks of patches divided by threads, rounded up
  /// Returns whether the slowest rank would try at least CleanupRules::least_spared patches fewer, one after the other,
  /// if all ranks had about equally many.
  bool is_uneven() const { return turns >= (patches + threads - 1) / threads + CleanupRules::least_spared; }
};

/// A function that tries patches of this rank and of others. It must not throw or communicate. @return a result for
/// each patch
using PatchTrial = std::function<std::vector<PatchResult>(std::span<PatchTask>)>;

/// @brief Tries the patches of all ranks. If the ranks have uneven numbers of patches, some patches are sent to other
/// ranks, so that each rank tries about equally many; a patch and its result take about 20 KB. Collective. Takes
/// O(log(ranks)) steps in addition to the trials.
/// @param own the patches of this rank, by number @return their results, in the same order
std::vector<PatchResult> try_shared(const comm::Communicator& comm, const PatchCounts& counts,
                                    std::vector<PatchTask> own, const PatchTrial& trial);

} // namespace trime::cleanup
