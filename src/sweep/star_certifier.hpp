// SPDX-License-Identifier: BSD-3-Clause
// Keeps the stars of the inner sites correct while sites move: by the Delaunay lemma where it suffices, otherwise by
// the empty-circumcircle test.
#pragma once

#include "sweep/site_classes.hpp"

#include <set>
#include <span>
#include <unordered_set>
#include <vector>

namespace trime::sweep {

/// @brief Certifies the stars of the inner owned sites. The lemma (sweep_kernel.hpp) suffices for most of them, and the
/// kernels apply it while they move the sites. Stars that fail there are *suspects*, and are certified here.
///
/// Suspects are certified by the empty-circumcircle test, and so are stars next to them that change, until all rings
/// agree. The owner of a ghost keeps its star, so ranks send each other messages about stars that a change affects.
/// Both certificates are equivalent: no result depends on which was used, or on ranks and threads.
///
/// Why that is enough: a star that was not examined again is locally convex, and agrees with its neighbours (if one of
/// them had changed, this star would have been examined). The region of all such stars is bounded by edges of stars
/// certified by the empty-circumcircle test, which are edges of the unique Delaunay triangulation. Inside the region,
/// the lemma holds.
///
/// Boundary sites keep no stars. But if the diametral disc of a chord holds no site, the chord is an edge of that
/// triangulation as well, and may be part of the border of the region. The reason is that, beyond the chord, the disc
/// of a triangle on it lies inside the disc of the chord. No boundary site is in such a disc (BoundarySites); inner
/// sites are rarely in one, and then the stars next to the boundary in nearby tiles need the empty-circumcircle test.
class StarCertifier {
public:
  /// @pre each star of an inner site was certain before the last moves, or its ring is empty; h is known at all sites;
  /// all arguments outlive this object
  StarCertifier(sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                LemmaReach reach);

  /// Must be called after sites were sorted.
  void reset();
  const SiteClasses& classes() const { return classes_; }
  SiteClasses& classes() { return classes_; }

  /// Certifies all stars at the present places, and fetches the ghosts that this takes. Moves nothing, and frees the
  /// leads. Collective.
  void certify_all();

  /// Begins a sweep without suspects.
  void begin_sweep();
  /// Adds suspects, except stars that were already certified in this sweep.
  void suspect(std::span<const LocalIndex> sites) { mark(sites, suspects_); }
  /// @brief Certifies the suspects, then the stars next to them that they have changed, until nothing changes on this
  /// rank. Then ranks send each other the affected stars, and certify these. Stars that miss a bin stay suspects.
  /// Collective among neighbours.
  /// @return the sites whose stars were certified in this call
  std::vector<LocalIndex> certify_suspects();
  /// The work that is left, on this rank or summed over all ranks.
  struct Open {
    std::int64_t uncertain = 0; ///< stars that still miss a bin
    std::int64_t untold = 0;    ///< ghosts whose owners have not yet received a message about a change
    bool any() const { return uncertain + untold > 0; }
  };
  Open open() const { return {std::ssize(suspects_), std::ssize(news_)}; }
  /// Fetches the bins that are missing on any rank. `round` counts these calls in a sweep. Collective.
  /// @param all the sums over all ranks
  /// @throws InternalError on all ranks after SiteRules::most_halo_rounds
  void go_on(const Open& all, int round);
  /// Returns whether the star of site i was certified here in this sweep.
  bool was_checked(LocalIndex i) const { return marked_[static_cast<std::size_t>(i)]; }
  /// Returns whether the star of site i has changed in this sweep.
  bool has_changed(LocalIndex i) const { return marked_[static_cast<std::size_t>(i)] == changed; }
  /// Number of stars of this rank that changed in this sweep, including lost ones next to borders.
  std::int64_t rebuilt() const { return rebuilt_; }
  void end_sweep();

  /// Compares every star with one computed by emptiness. Collective. @throws InternalError on all ranks if any differs
  void verify() const;

private:
  void find_suspects();
  void settle(std::vector<LocalIndex>& certified, std::vector<LocalIndex>& uncertain);
  void note_ghost(const delaunay::AffectedStar& affected);
  void exchange_news();
  LocalIndex find_owned(geometry::Vec2 p) const;
  void mark(std::span<const LocalIndex> sites, std::vector<LocalIndex>& list);

  sites::SiteState& state_;
  const delaunay::StarBuilder& builder_;
  const MoveContext context_;
  SiteClasses classes_;
  static constexpr std::uint8_t checked = 1, changed = 2;
  std::vector<std::uint8_t> marked_;  // by site: whether its star was certified in this sweep, and whether it changed
  std::vector<LocalIndex> suspects_;  // stars that need the empty-circumcircle test
  std::vector<LocalIndex> checked_;   // all that were suspects in this sweep
  std::vector<mesh::BinRef> missing_; // bins that suspects miss, ascending
  std::vector<LocalIndex> affected_ghosts_;    // ghosts whose owners will receive a message
  std::vector<decomposition::GhostNews> news_; // messages about the affected ghosts
  std::unordered_set<LocalIndex> told_ghosts_; // ghosts whose owners have received a message in this sweep, or will
  /// Places of ghosts that, as far as this rank knows, their owners have examined in this sweep.
  std::set<geometry::Vec2, decltype(&geometry::lexicographically_less)> heard_of_{geometry::lexicographically_less};
  std::int64_t rebuilt_ = 0;
};

} // namespace trime::sweep
