// SPDX-License-Identifier: BSD-3-Clause
// The tail of the quality: what the sweeps leave of bad triangles is mended patch by patch, after all sweeps.
#pragma once

#include "meshing/layout.hpp"
#include "meshing/patch.hpp"

#include <cstdint>
#include <unordered_set>
#include <vector>

namespace trime::meshing {

/// @brief Rounds of try and keep. A site is a candidate if it has a bad triangle and no neighbour has a worse one. Of
/// the candidates those act that are the first of their surroundings in an order of size class and hash of place and
/// round: their patches (PatchOptimizer) do not overlap, and the choice is the same for any partition. The owner of a
/// candidate computes its patch and sends the changes to the owners of the sites; what changes on the boundary goes to
/// all ranks. A place where nothing helped is not tried again; its neighbours are.
class Cleanup {
public:
  /// References must outlive the object.
  Cleanup(const comm::Communicator& comm, Layout& layout, const geometry::Boundary& boundary,
          const geometry::Lattice& lattice, const delaunay::StarBuilder& builder, const PatchOptions& options = {});

  /// @brief Rounds until no place is left where something has not been tried, at most `most_rounds`. Stars are to be
  /// computed anew afterwards. Collective. About 0.3 ms a patch; from the second round on only stars near bad triangles
  /// and changes are computed.
  CleanupCounts run();

  /// One round. Collective.
  CleanupCounts round();
  static constexpr int most_rounds = 30;

private:
  struct Candidate {
    LocalIndex site;
    double separation; // no other patch may begin within
  };
  void compute_stars();
  std::vector<Disc> share_places() const;
  void remember_places(const std::vector<GlobalId>& keys);
  std::vector<GlobalId> worst_alphas() const;
  std::vector<Candidate> find_candidates(std::vector<GlobalId>& order);
  void choose_apart(std::vector<Candidate>& candidates, std::vector<GlobalId> order) const;
  std::vector<SiteEdit> try_patches(const std::vector<Candidate>& chosen, CleanupCounts& counts);
  CleanupCounts sum_over_ranks(const CleanupCounts& own) const;
  std::vector<PatchSite> sites_around(LocalIndex site, double reach) const;
  std::vector<SiteEdit> send_to_owners(const std::vector<SiteEdit>& edits) const;
  void edit_the_boundary(const std::vector<SiteEdit>& edits);
  std::int32_t new_boundary_index(const SiteEdit& insertion) const;
  void apply(const std::vector<SiteEdit>& edits);

  const comm::Communicator& comm_;
  Layout& layout_;
  SiteState& state_;
  BoundaryCurve curve_;
  geometry::Lattice lattice_;
  const delaunay::StarBuilder& builder_;
  PatchOptions options_;
  int round_ = 0;
  bool changed_ = true;      // something, in the last round
  std::vector<Disc> places_; // where this rank saw bad triangles, or changed something, in the last round
  // The boundary's changes of this round, sorted, and what became of its sites; empty: none.
  std::vector<BoundaryEdit> boundary_edits_;
  std::vector<LocalIndex> inserted_, new_index_;
  std::unordered_set<std::uint64_t> hopeless_; // hashes of owned places where nothing helped
};

} // namespace trime::meshing
