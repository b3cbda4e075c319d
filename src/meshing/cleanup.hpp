// SPDX-License-Identifier: BSD-3-Clause
// The tail of the quality: what the sweeps leave of bad triangles is mended patch by patch, after all sweeps.
#pragma once

#include "meshing/layout.hpp"
#include "meshing/patch.hpp"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace trime::meshing {

/// @brief Rounds of try and keep. A site is a candidate if it has a bad triangle and no neighbour has a worse one. Of
/// the candidates those act that are the first of their surroundings in an order of size class and hash of place and
/// round: their patches (PatchOptimizer) do not overlap, and the choice is the same for any partition. The owner of a
/// candidate computes its patch and sends the changes to the owners of the sites; what changes on the boundary goes to
/// all ranks. A triangle for which nothing helped is not tried again before a corner of it has moved, and a
/// place where nothing helped twice not at all.
///
/// The number of sites stays near that of the beginning, at most half a percent below, and never above `most_sites` (0:
/// half a percent above): when the patches of a round would leave these limits, those first in the order of a hash are
/// carried out.
class Cleanup {
public:
  /// References must outlive the object.
  Cleanup(const comm::Communicator& comm, Layout& layout, const geometry::Boundary& boundary,
          const geometry::Lattice& lattice, const delaunay::StarBuilder& builder, GlobalId most_sites,
          const PatchOptions& options = {});

  /// @brief Rounds until no place is left where something has not been tried, at most `most_rounds` in each stage; the
  /// stages for the worst triangles hand over their last places to the next. Stars are to be computed anew afterwards.
  /// Collective. About 1 ms a patch, 2.5 where nothing helps; from the second round on only stars near bad triangles
  /// and changes are computed.
  CleanupCounts run();

  /// One round. Collective.
  CleanupCounts round();
  static constexpr int most_rounds = 250;

private:
  struct Candidate {
    LocalIndex site;
    double separation; // no other patch may begin within
  };
  void compute_stars();
  std::vector<Disc> share_places() const;
  void remember_places(const std::vector<GlobalId>& keys);
  std::uint64_t cell_key(geometry::Vec2 p, double h) const;
  bool is_hopeless(LocalIndex i, double h) const;
  std::vector<GlobalId> worst_alphas() const;
  std::vector<Candidate> find_candidates(std::vector<GlobalId>& order);
  std::int64_t leave_crowded(std::vector<Candidate>& candidates, std::vector<GlobalId>& order);
  void note_failure(geometry::Vec2 p, double h);
  void choose_apart(std::vector<Candidate>& candidates, std::vector<GlobalId> order) const;
  PatchBudget budget() const;
  std::vector<std::vector<SiteEdit>> try_patches(const std::vector<Candidate>& chosen);
  void keep_within_limits(const std::vector<Candidate>& chosen, std::vector<std::vector<SiteEdit>>& edits);
  std::vector<SiteEdit> collect(const std::vector<Candidate>& chosen, const std::vector<std::vector<SiteEdit>>& edits,
                                CleanupCounts& counts);
  CleanupCounts sum_over_ranks(const CleanupCounts& own) const;
  std::vector<PatchSite> sites_around(LocalIndex site, double reach) const;
  void set_tolerances(std::vector<PatchSite>& sites) const;
  std::vector<SiteEdit> send_to_owners(const std::vector<SiteEdit>& edits) const;
  void edit_the_boundary(const std::vector<SiteEdit>& edits);
  void apply(const std::vector<SiteEdit>& edits);

  const comm::Communicator& comm_;
  Layout& layout_;
  SiteState& state_;
  BoundaryCurve curve_;
  geometry::Lattice lattice_;
  const delaunay::StarBuilder& builder_;
  PatchOptions options_;
  GlobalId most_sites_, least_sites_, wanted_sites_, sites_; // over all ranks
  int round_ = 0;
  GlobalId crowded_ = 0;     // places of the last round with too many sites around, over all ranks
  bool changed_ = true;      // something, in the last round
  bool all_stars_ = true;    // are to be computed in the next
  double threshold_ = 1;     // of alpha, of the present stage
  std::vector<Disc> places_; // where this rank saw bad triangles, or changed something, in the last round
  // What became of the boundary's sites in this round, by their old index (empty: nothing), and the index of new ones.
  std::vector<LocalIndex> new_index_;
  std::map<std::pair<double, double>, LocalIndex> index_at_;
  std::unordered_map<std::uint64_t, int> failures_; // by cell
  std::unordered_set<std::uint64_t> hopeless_;      // hashes of owned sites with a triangle for which nothing helped
};

} // namespace trime::meshing
