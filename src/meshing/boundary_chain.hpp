// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary while the clean-up moves, inserts and deletes some: every change costs what it touches.
#pragma once

#include "meshing/boundary_curve.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::meshing {

/// @brief A copy of boundary sites as a linked list. Sites keep their index as long as they exist; new ones are
/// appended, so that indices do not follow the loops any more. The same on every rank.
class BoundaryChain {
public:
  /// References must outlive the object.
  BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve);

  /// `loop_start` and all that is said of the whole boundary is that of the beginning.
  const BoundarySites& sites() const { return sites_; }
  LocalIndex loop(LocalIndex site) const { return loops_[static_cast<std::size_t>(site)]; }

  /// @brief Carries out edits; several new sites of one chord stand in the order of their arcs. O(edits log edits)
  /// @pre neighbouring sites lie within half a period of each other; a loop keeps 3 sites
  /// @throws InternalError if a site is changed twice, or a chord divided by two patches
  /// @return the indices that have changed or are new, each as often as it has changed
  std::vector<LocalIndex> apply(std::vector<BoundaryEdit> edits);

  /// Carries all changes over. @return by index in the chain the new index, -1 if the site is gone
  std::vector<LocalIndex> finish(BoundarySites& boundary) const;

private:
  enum class Fate : std::uint8_t { untouched, moved, gone };
  void place(LocalIndex site, double arc, geometry::Vec2 position);
  void close_chord(LocalIndex site);
  static void check_apart(std::span<const BoundaryEdit> edits);

  const BoundaryCurve& curve_;
  BoundarySites sites_;
  std::size_t original_; // number of sites at the beginning
  std::vector<LocalIndex> loops_;
  std::vector<Fate> fates_;
};

} // namespace trime::meshing
