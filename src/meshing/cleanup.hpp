// SPDX-License-Identifier: BSD-3-Clause
// The tail of the quality: what the sweeps leave of bad triangles is mended patch by patch, after all sweeps.
#pragma once

#include "meshing/boundary_chain.hpp"
#include "meshing/cleanup_candidates.hpp"
#include "meshing/cleanup_sites.hpp"
#include "meshing/layout.hpp"
#include "meshing/patch.hpp"
#include "trime/core/thread_loop.hpp"
#include "trime/meshing/options.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace trime::meshing {

/// @brief Rounds of try and keep. A site is a candidate if it has a bad triangle; the worst one of each cell of a few h
/// is a contender for the middle of a patch (PatchOptimizer). Of the contenders those act that are the first of their
/// surroundings in the order of a hash of place and round: their patches do not overlap, and the choice is the same for
/// any partition. The owner of a contender asks the others for what it does not know of its patch, computes it, and
/// sends the changes to the owners of the sites; what changes on the boundary goes to all ranks. A site of a triangle
/// for which nothing helped rests until it has moved by some share of h.
///
/// Nothing in a round costs more than what it touches: stars are computed once at the beginning; then the patches tell
/// what has become of their triangles, and the state learns of all edits at the end.
///
/// The number of sites stays near that of the beginning, at most half a percent below, and never above `most_sites` (0:
/// half a percent above): when the patches of a round would leave these limits together, the worst places come first.
class Cleanup {
public:
  /// References must outlive the object.
  Cleanup(const comm::Communicator& comm, Layout& layout, const geometry::Boundary& boundary,
          const geometry::Lattice& lattice, const delaunay::StarBuilder& builder, GlobalId most_sites,
          const PatchOptions& options = {});

  /// @brief Rounds until no candidate is left, at most `most_rounds`. Stars are to be computed anew afterwards.
  /// Collective. About 0.5 ms a patch.
  CleanupCounts run();
  static constexpr int most_rounds = 250;

private:
  void find_candidates();
  double find_again_alpha() const;
  std::vector<Contender> list_contenders();
  void find_tolerances(std::span<const LocalIndex> boundary_sites);
  PatchBudget budget(std::size_t own_patches) const;
  GlobalId room() const;
  void keep_within_limits(std::span<const Contender> chosen, std::vector<PatchResult>& results) const;
  CleanupCounts round(std::span<const Contender> contenders);
  std::vector<PatchResult> try_patches(std::span<const Contender> chosen);
  std::vector<SiteEdit> collect(std::span<const Contender> chosen, const std::vector<PatchResult>& results,
                                CleanupCounts& counts);
  void take_verdicts(std::span<const Contender> chosen, const std::vector<PatchResult>& results);
  CleanupCounts sum_over_ranks(const CleanupCounts& own) const;
  void edit_the_boundary(std::vector<SiteEdit>& edits);
  std::vector<SiteEdit> send_to_owners(const std::vector<SiteEdit>& edits) const;

  const comm::Communicator& comm_;
  Layout& layout_;
  SiteState& state_;
  BoundaryCurve curve_;
  geometry::Lattice lattice_;
  const delaunay::StarBuilder& builder_;
  PatchOptions options_;
  GlobalId most_sites_, least_sites_, wanted_sites_, sites_; // over all ranks
  int round_ = 0;
  int stage_ = 1;          // above the first, places that are bad for this mesh are tried once more
  double again_alpha_ = 0; // that is above this
  BoundaryChain chain_;
  std::vector<double> tolerances_; // by index in the chain
  std::unique_ptr<CleanupSites> places_;
  PerThread<PatchOptimizer> optimizers_;
  CleanupCandidates candidates_; // owned sites
};

} // namespace trime::meshing
