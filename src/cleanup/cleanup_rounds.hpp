// SPDX-License-Identifier: BSD-3-Clause
// The rounds of the clean-up over all ranks; see mend.
#pragma once

#include "cleanup/cleanup.hpp"
#include "cleanup/cleanup_boundary.hpp"
#include "cleanup/cleanup_candidates.hpp"
#include "cleanup/cleanup_limits.hpp"
#include "cleanup/cleanup_sites.hpp"
#include "cleanup/patch_optimizer.hpp"
#include "core/thread_loop.hpp"

#include <memory>
#include <span>
#include <vector>

namespace trime::cleanup {

/// @brief Chooses patches, has them tried, and tells all owners of sites what came of it. The state stays as it is
/// until finish. All calls are collective.
class CleanupRounds {
public:
  /// @brief References must outlive the object.
  /// @param candidates the own sites with bad triangles @pre sizes of the owned sites are known
  CleanupRounds(const sites::Stage& stage, const geometry::Boundary& meshed, const geometry::Lattice& lattice,
                const CleanupOptions& options, std::span<const Candidate> candidates);

  /// Rounds until no candidate is left for this stage (1, 2, ...), at most CleanupRules::most_rounds.
  CleanupCounts run_stage(int stage);
  /// Carries all edits over to the state, the polygon and the guard of the stage.
  void finish(sites::Stage& stage);

private:
  double find_again_alpha() const;
  std::vector<Contender> list_contenders();
  CleanupCounts round(std::span<const Contender> contenders);
  std::vector<sites::Disc> discs_of(std::span<const Contender> chosen) const;
  void prepare(std::vector<PatchSite>& sites) const;
  void give_up_crowds(std::span<const sites::Disc> discs, std::span<const Surroundings> around);
  std::vector<PatchResult> try_patches(std::span<const Contender> chosen);
  std::vector<SiteEdit> collect(std::span<const Contender> chosen, std::span<const PatchResult> results,
                                CleanupCounts& counts) const;
  void take_edits(std::span<const SiteEdit> edits);
  void take_verdicts(std::span<const Contender> chosen, std::span<const PatchResult> results);
  CleanupCounts sum_over_ranks(const CleanupCounts& own) const;

  const comm::Communicator& comm_;
  const geometry::Periods& periods_;
  const geometry::Lattice& lattice_;
  CleanupLimits limits_;
  CleanupBoundary boundary_;
  CleanupSites sites_;
  CleanupCandidates candidates_; // owned sites
  PerThread<std::unique_ptr<PatchOptimizer>> optimizers_;
  int round_ = 0;
  int stage_ = 1;          // above the first, places that are bad for this mesh are tried once more
  double again_alpha_ = 0; // that is above this
};

} // namespace trime::cleanup
