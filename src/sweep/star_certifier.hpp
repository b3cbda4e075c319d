// SPDX-License-Identifier: BSD-3-Clause
// Keeps the stars (Delaunay neighbours) of the inner sites correct while sites move. Most stars are certified by the
// local Delaunay condition (the Delaunay lemma), the others by the empty-circumcircle test.
#pragma once

#include "sweep/site_classes.hpp"

#include <set>
#include <span>
#include <unordered_set>
#include <vector>

namespace trime::sweep {

/// @brief Certifies the stars of the inner owned sites. The Delaunay lemma (sweep_kernel.hpp) suffices for most of
/// them, and the vector kernels apply the lemma while they move the sites. A star that fails there is a *suspect*, and
/// is certified by this class.
///
/// Suspects are certified by the empty-circumcircle test. If that changes a star, the stars next to it are certified
/// too, until all neighbours agree. Only the owner of a site keeps its star, so ranks send each other messages about
/// stars of ghosts that may have changed. Both kinds of certificate are equivalent: no result depends on which kind was
/// used, on ranks or on threads.
///
/// Why that is enough: a star that was not examined again is locally convex and agrees with its neighbours, because a
/// change of a neighbour would have led to an examination. The region of all such stars is bounded by edges of stars
/// that the empty-circumcircle test has certified, and these edges belong to the unique Delaunay triangulation. Inside
/// the region, the Delaunay lemma holds.
///
/// Boundary sites keep no stars. But if the diametral circle of a boundary edge contains no site, the edge also belongs
/// to the Delaunay triangulation, and may be part of the border of the region. The reason is that the circumcircle of a
/// triangle on this edge lies, beyond the edge, inside the diametral circle. No boundary site is inside such a circle
/// (BoundarySites). Inner sites are rarely inside one; then the stars next to the boundary in nearby tiles need the
/// empty-circumcircle test.
///
/// Two sites may come to the same place, for example when both are pushed out of the same disc. Their neighbours then
/// see only one of them. Once the two part, the stars around them cover the plane twice, which the lemma does not see.
/// So the caller must sort the sites as soon as coincident() is positive on any rank: that drops one of the two.
///
/// No such place is missed. Suppose that neither of the two stars there was examined. Then no star next to them has
/// changed its triangles with them, so all stars are locally convex and agree. By the lemma they are a triangulation,
/// and in a triangulation no two sites have the same place.
class StarCertifier {
public:
  /// @pre each star of an inner site was certain before the last moves, or its list of neighbours is empty; the target
  /// edge length h is known at all sites; all arguments outlive this object
  StarCertifier(sites::SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                LemmaReach reach);

  /// Must be called after each sorting of the sites.
  void reset();
  const SiteClasses& classes() const { return classes_; }
  SiteClasses& classes() { return classes_; }

  /// Certifies all stars at the present places of the sites, and fetches the ghosts that the tests need. Moves no site,
  /// and releases the memory of the leads. Collective.
  void certify_all();

  /// Begins a sweep with an empty list of suspects.
  void begin_sweep();
  /// Adds sites whose stars must be certified, except sites whose stars were already certified in this sweep.
  void suspect(std::span<const LocalIndex> sites) { mark(sites, suspects_); }
  /// @brief Certifies the suspects, then the stars next to changed ones, until no star of this rank changes. Then
  /// neighbouring ranks send each other the affected stars, and certify these too. A star that needs the sites of an
  /// unknown bin stays a suspect. Collective among neighbours.
  /// @return the sites whose stars this call has certified
  std::vector<LocalIndex> certify_suspects();
  /// The certification work that is left, on this rank or summed over all ranks.
  struct Open {
    std::int64_t uncertain = 0; ///< stars that need the sites of a bin that the rank does not know
    std::int64_t untold = 0;    ///< ghosts whose owners still have to receive a message about a changed star
    bool any() const { return uncertain + untold > 0; }
  };
  Open open() const { return {std::ssize(suspects_), std::ssize(news_)}; }
  /// Fetches the bins that suspects on any rank need. `round` counts these calls in a sweep. Collective.
  /// @param all the open work, summed over all ranks
  /// @throws InternalError on all ranks if `round` exceeds SiteRules::most_halo_rounds
  void go_on(const Open& all, int round);
  /// Returns whether this object has certified the star of site i in this sweep.
  bool was_checked(LocalIndex i) const { return marked_[static_cast<std::size_t>(i)]; }
  /// Returns whether the star of site i has changed in this sweep.
  bool has_changed(LocalIndex i) const { return marked_[static_cast<std::size_t>(i)] == changed; }
  /// Returns the number of stars of this rank that changed in this sweep, including stars next to borders that had to
  /// be built again.
  std::int64_t rebuilt() const { return rebuilt_; }
  /// Returns the number of stars that were certified in this sweep at a place where two sites lie. Over all ranks it is
  /// positive exactly if there is such a place, whatever the ranks and threads (see above).
  std::int64_t coincident() const { return coincident_; }
  void end_sweep();

  /// Compares every star with a star computed from all surrounding sites by the empty-circumcircle test. Collective.
  /// @throws InternalError on all ranks if any two differ
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
  std::vector<std::uint8_t>
      marked_; // by site: 0, `checked` (its star was certified in this sweep) or `changed` (and differs from before)
  std::vector<LocalIndex> suspects_;  // sites whose stars need the empty-circumcircle test
  std::vector<LocalIndex> checked_;   // all sites that were suspects in this sweep
  std::vector<mesh::BinRef> missing_; // bins that the stars of suspects need and this rank does not know, ascending
  std::vector<LocalIndex> affected_ghosts_;    // ghosts whose owners will receive a message
  std::vector<decomposition::GhostNews> news_; // messages about the affected ghosts
  std::unordered_set<LocalIndex> told_ghosts_; // ghosts whose owners have received a message in this sweep, or will
  /// Places of the ghosts whose owners, according to their messages, have examined the star in this sweep.
  std::set<geometry::Vec2, decltype(&geometry::lexicographically_less)> heard_of_{geometry::lexicographically_less};
  std::int64_t rebuilt_ = 0, coincident_ = 0;
};

} // namespace trime::sweep
