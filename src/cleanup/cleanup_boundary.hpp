// SPDX-License-Identifier: BSD-3-Clause
// The boundary during the clean-up. Each rank knows the places of the boundary sites that it owns; all ranks receive
// the edits at the end.
#pragma once

#include "cleanup/patch_data.hpp"
#include "polygon/boundary_chain.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/sizing/size_field.hpp"

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace trime::cleanup {

/// @brief The sites on the boundary at the beginning, which are the same on all ranks, and the present places of those
/// that this rank owns. For sites of other ranks the places may be outdated.
class CleanupBoundary {
public:
  /// @brief Collective. Throws on all ranks together if the size field throws. The arguments must outlive the object.
  /// @param tolerance [size] largest distance of a boundary edge from corners between its ends; 0: no boundary edge may
  /// leave out a corner
  CleanupBoundary(const comm::Communicator& comm, const geometry::Boundary& curves, const polygon::BoundarySites& sites,
                  const sizing::SizeField& size, double tolerance);

  const polygon::BoundaryCurve& curve() const { return curve_; }

  /// Returns the place on the boundary of a site that this rank owns.
  BoundaryPlace place(BoundaryName site) const;
  /// Returns BoundaryPlace::tolerance at the point p. Throws if the size field throws.
  double tolerance(geometry::Vec2 p) const { return tolerance_ > 0 ? tolerance_ * size_.size(p) : 0; }

  /// Stores the new place of a site of this rank on its loop. @pre set_next() follows for this site
  void set_place(BoundaryName site, const SiteEdit& edit);
  void set_next(BoundaryName site, BoundaryName next);
  /// Removes the data of a site that is deleted or that another rank now owns.
  void forget(BoundaryName site) { known_.erase(site); }

  /// Returns the name of a site inside that has not moved: that of a site on a curve, or mesh::fixed_site.
  /// @param p its position in the container
  BoundaryName name_inside(geometry::Vec2 p) const {
    const LocalIndex site = sites_.inner.index_of(p);
    return site < 0 ? BoundaryName{mesh::fixed_site} : name_on_curve(site);
  }

  /// Stores edits of this rank's patches in a round (0, 1, ...), which finish() sends.
  void note(std::span<const SiteEdit> edits, int round);
  /// @brief Sends all edits to all ranks. Collective. O(edits on the boundary and on curves of all ranks); if there are
  /// any, also O(sites on the boundary). @return the sites on the boundary after the edits; nothing if there were no
  /// edits
  std::optional<polygon::BoundarySites> finish();
  /// Returns whether finish() has found edits that may have changed the indices of sites.
  bool has_new_indices() const { return !new_index_.empty(); }
  /// Returns the index of a site after finish(). @pre the site still exists
  LocalIndex index(BoundaryName site) const;

private:
  struct Edit { // an edit of the boundary
    std::int32_t round;
    polygon::EditKind kind;
    BoundaryName site, made; // see SiteEdit
    double arc;
    geometry::Vec2 position;
    std::uint64_t patch;
  };
  void carry_out(std::span<const Edit> edits, polygon::BoundaryChain& chain);
  static std::vector<polygon::InnerMove> inner_moves(std::vector<Edit>& edits);

  const comm::Communicator& comm_;
  const polygon::BoundarySites& sites_;
  const sizing::SizeField& size_;
  double tolerance_;
  polygon::BoundaryCurve curve_;
  std::vector<LocalIndex> loops_;                         // loop by index at the beginning
  std::vector<double> tolerances_;                        // by index at the beginning
  std::unordered_map<BoundaryName, BoundaryPlace> known_; // places of sites that are new or have changed
  std::vector<Edit> edits_;                               // edits of this rank's patches, by round
  std::unordered_map<BoundaryName, LocalIndex> made_;     // index in the chain of new sites
  std::vector<LocalIndex> new_index_;                     // by index in the chain; empty if no index has changed
};

} // namespace trime::cleanup
