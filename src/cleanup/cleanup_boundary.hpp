// SPDX-License-Identifier: BSD-3-Clause
// The boundary during the clean-up: each rank knows the places of its sites, and all ranks learn the edits at the end.
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

/// @brief The sites on the boundary as they were at the beginning, the same on all ranks, and what has become of those
/// that this rank owns. What it does not own it may know by an older place.
class CleanupBoundary {
public:
  /// @brief Collective, throws on all ranks together if the size field does. References must outlive the object.
  /// @param tolerance in `size`: how far chords may pass from corners that they leave out; 0: they may leave out none
  CleanupBoundary(const comm::Communicator& comm, const geometry::Boundary& curves, const polygon::BoundarySites& sites,
                  const sizing::SizeField& size, double tolerance);

  const polygon::BoundarySites& sites_at_first() const { return sites_; }
  const polygon::BoundaryCurve& curve() const { return curve_; }

  /// Returns the name of an owned site.
  BoundaryPlace place(BoundaryName site) const;
  /// BoundaryPlace::tolerance at a place. Throws if the size field does.
  double tolerance(geometry::Vec2 p) const { return tolerance_ > 0 ? tolerance_ * size_.size(p) : 0; }

  /// An owned site has come to a new place on its loop. @pre a link of it follows
  void set_place(BoundaryName site, const SiteEdit& edit);
  void set_next(BoundaryName site, BoundaryName next);
  /// The site has gone, or another rank owns it now.
  void forget(BoundaryName site) { known_.erase(site); }

  /// Notes edits of the own patches of a round (0, 1, ...), for `finish`.
  void note(std::span<const SiteEdit> edits, int round);
  /// @brief Sends all edits to all ranks. @return the sites on the boundary after them; nothing if there were no edits.
  /// Collective: O(edits on the boundary of all ranks), and passes over all its sites if there were any.
  std::optional<polygon::BoundarySites> finish();
  /// Has `finish` found edits that may have changed the indices?
  bool has_new_indices() const { return !new_index_.empty(); }
  /// The index of a site after `finish`. @pre it is still there
  LocalIndex index(BoundaryName site) const;

private:
  struct Edit { // of the boundary
    std::int32_t round;
    polygon::EditKind kind;
    BoundaryName site, made; // see SiteEdit
    double arc;
    geometry::Vec2 position;
    std::uint64_t patch;
  };
  void carry_out(std::span<const Edit> edits, polygon::BoundaryChain& chain);

  const comm::Communicator& comm_;
  const polygon::BoundarySites& sites_;
  const sizing::SizeField& size_;
  double tolerance_;
  polygon::BoundaryCurve curve_;
  std::vector<LocalIndex> loops_;                         // by index at the beginning
  std::vector<double> tolerances_;                        // by index at the beginning
  std::unordered_map<BoundaryName, BoundaryPlace> known_; // sites that are new or have changed
  std::vector<Edit> edits_;                               // of the own patches, by round
  std::unordered_map<BoundaryName, LocalIndex> made_;     // index in the chain of sites that are new
  std::vector<LocalIndex> new_index_;                     // by index in the chain; empty: all are as they were
};

} // namespace trime::cleanup
