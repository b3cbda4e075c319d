// SPDX-License-Identifier: BSD-3-Clause
// Runs the rounds of the clean-up over all ranks; see cleanup.hpp.
#pragma once

#include "cleanup/cleanup.hpp"
#include "cleanup/cleanup_boundary.hpp"
#include "cleanup/cleanup_limits.hpp"
#include "cleanup/cleanup_sites.hpp"
#include "cleanup/patch_optimizer.hpp"
#include "cleanup/patch_sharing.hpp"
#include "comm/neighbours.hpp"
#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace trime::cleanup {

/// @brief Chooses patches, tries them on all ranks, and sends the results to the owners of the sites. Does not change
/// the stage before finish() is called. All methods are collective.
///
/// In a round, ranks exchange messages with their neighbours, and further messages with ranks whose patches lie near
/// their tiles. One reduction counts the patches; if some ranks have more than their share, patches are sent to other
/// ranks. Another reduction counts new sites and finds out whether any rank has an error. A rank with an error takes
/// part in all messages before that reduction.
class CleanupRounds {
public:
  /// @brief The arguments must outlive the object.
  /// @param candidates the sites of this rank with bad triangles @pre sizes of the owned sites are known
  CleanupRounds(const sites::Stage& stage, const geometry::Boundary& meshed, const geometry::Lattice& lattice,
                const CleanupOptions& options, std::span<const Candidate> candidates);

  /// Runs rounds until no candidate is left for this stage (1, 2, ...), at most CleanupRules::most_rounds rounds.
  void run_stage(int stage);
  /// Returns the counts of all rounds so far.
  CleanupCounts counts() const;
  /// Applies all edits to the state, the polygon and the guard of the stage. @param builder the object that has built
  /// the Delaunay stars of the stage
  void finish(sites::Stage& stage, const delaunay::StarBuilder& builder);

private:
  /// The patches that this rank tries in a round.
  struct Attempt {
    Choice choice;
    std::vector<PatchResult> results; // results of the chosen patches
    std::vector<sites::Disc> crowds;  // discs around patches that hold too many sites
    std::optional<Error> error;
  };
  enum class Outcome { done, nothing_left, neighbours_missing };
  /// A message between two ranks about patches.
  struct News {
    std::vector<SiteEdit> edits;
    std::vector<BoundaryLink> links;
    std::vector<SiteVerdict> verdicts;
    std::vector<sites::Disc> crowds;
  };

  double find_again_alpha() const;
  std::vector<Contender> list_contenders();
  void meet_neighbours(std::span<const Contender> contenders);
  Outcome round(std::span<const Contender> contenders);
  std::pair<bool, PatchCounts> count_patches(const Choice& choice) const;
  Attempt try_patches(Choice choice, const PatchCounts& counts);
  void improve(PatchTask& task, const PatchBudget& budget, int thread, PatchResult& result);
  void make_canonical(PatchResult& result) const;
  void count(const Attempt& attempt);
  std::map<int, News> list_news(const Attempt& attempt) const;
  News exchange_news(const Attempt& attempt) const;
  void take(const News& news);
  void settle_failures(const Attempt& attempt);

  const comm::Communicator& comm_;
  const geometry::Periods& periods_;
  const geometry::Lattice& lattice_;
  const sizing::SizeField& size_;
  CleanupLimits limits_;
  CleanupBoundary boundary_;
  CleanupSites sites_;
  CleanupCandidates candidates_; // candidates among the owned sites
  comm::Neighbours neighbours_;
  PerThread<std::unique_ptr<PatchOptimizer>> optimizers_;
  CleanupCounts counts_; // sums over the patches of this rank
  int round_ = 0;
  int stage_ = 1;          // stages after the first try the worst places of this mesh once more
  double bad_alpha_;       // triangles with a larger alpha are improved
  double again_alpha_ = 0; // places with a larger alpha are tried once more
};

} // namespace trime::cleanup
