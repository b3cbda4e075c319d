// SPDX-License-Identifier: BSD-3-Clause
// Keeps the stars of the inner sites right while these move: by the Delaunay lemma where it does, else by emptiness.
#pragma once

#include "sweep/site_classes.hpp"

#include <span>
#include <vector>

namespace trime::sweep {

/// @brief Certifies the stars of the inner owned sites. The lemma (sweep_kernel.hpp) does for most of them, and the
/// kernels apply it while they move the sites; whatever fails there is a suspect, and is certified here.
///
/// The lemma needs the stars of all neighbours, so those beside ghosts are certified by emptiness instead; so are those
/// that fail, and whatever changes beside them, until all rings agree. Both certificates say the same: no result
/// depends on which was used, nor on ranks and threads.
///
/// Why that is enough: a star that was not looked at again is locally convex, and its triangles are those of its
/// neighbours (else one of them had changed, and this one been looked at). The region of all such stars is bounded by
/// edges of stars certified by emptiness, which are edges of the one Delaunay triangulation; inside, the lemma holds.
///
/// Boundary sites keep no stars, but where the diametral disc of a chord holds no site the chord is an edge of that
/// triangulation as well, and may be part of the border: the disc of a triangle on the chord reaches less far beyond it
/// than that of the chord. No boundary site is in such a disc (BoundarySites); inner sites are rarely in one, and then
/// the stars beside the boundary in the tiles around are certified by emptiness.
class StarCertifier {
public:
  /// @pre each star of an inner site was certain before the last moves, or its ring is empty; h is known at all sites;
  /// all arguments outlive this object
  StarCertifier(sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                LemmaReach reach);

  /// To be called after sites were sorted.
  void reset();
  const SiteClasses& classes() const { return classes_; }
  SiteClasses& classes() { return classes_; }

  /// Certifies all stars where their sites are, with as many ghosts as that takes. Nothing moves, and the leads are
  /// freed. Collective.
  void certify_all();

  /// Begins a sweep without suspects.
  void begin_sweep();
  /// These stars are to be certified by emptiness, unless they have been in this sweep.
  void suspect(std::span<const LocalIndex> sites) { mark(sites, suspects_); }
  /// @brief Certifies the suspects, then what they have changed beside them, until nothing changes. Those that miss a
  /// bin stay suspects. Local.
  /// @return the sites whose stars were certified in this call
  std::vector<LocalIndex> certify_suspects();
  /// Number of stars that still miss a bin.
  std::int64_t uncertain() const { return static_cast<std::int64_t>(suspects_.size()); }
  /// Fetches the bins that are missing on any rank; `round` counts these calls in a sweep. Collective.
  /// @throws InternalError on all ranks after SiteRules::most_halo_rounds
  void fetch_missing(int round);
  /// Was the star of site i looked at in this sweep?
  bool was_checked(LocalIndex i) const { return marked_[static_cast<std::size_t>(i)]; }
  /// Stars of this sweep that were not right any more, and those beside borders that were lost; on this rank.
  std::int64_t rebuilt() const { return rebuilt_; }
  void end_sweep();

  /// Compares every star with one computed by emptiness. Collective. @throws InternalError on all ranks if any differs
  void verify() const;

private:
  void find_suspects();
  void mark(std::span<const LocalIndex> sites, std::vector<LocalIndex>& list);

  sites::SiteState& state_;
  const delaunay::StarBuilder& builder_;
  const MoveContext context_;
  SiteClasses classes_;
  std::vector<std::uint8_t> marked_;  // by site: its star has been looked at in this sweep
  std::vector<LocalIndex> suspects_;  // to be certified by emptiness
  std::vector<LocalIndex> checked_;   // all that were suspects in this sweep
  std::vector<mesh::BinRef> missing_; // bins that suspects miss, ascending
  std::int64_t rebuilt_ = 0;
};

} // namespace trime::sweep
