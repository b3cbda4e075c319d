// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary while some of them move, are inserted or are removed. The cost of a change grows only with
// what it touches.
#pragma once

#include "polygon/boundary_curve.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::polygon {

enum class EditKind : std::int32_t { move, remove, insert };

/// One change of the boundary sites. Sites keep their order along the loop.
struct BoundaryEdit {
  LocalIndex site = -1; ///< the site that moves along its curve or is removed; for a new site, the site before it
  EditKind kind = EditKind::move;
  double arc = 0;          ///< arc length of the new place
  geometry::Vec2 position; ///< new place, canonical
  std::uint64_t patch = 0; ///< number of the patch that makes the edit: only one patch may divide a chord
};

/// @brief A copy of boundary sites as a linked list. Sites keep their indices until renumber is called. New sites are
/// appended, so indices no longer follow the loops. All ranks hold the same copy.
class BoundaryChain {
public:
  /// The curve must outlive the object.
  BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve);

  /// The sites; `loop_start`, counts and sums are those after the last renumber, or at first.
  const BoundarySites& sites() const { return sites_; }
  LocalIndex loop(LocalIndex site) const { return loops_[static_cast<std::size_t>(site)]; }
  const BoundaryCurve& curve() const { return curve_; }

  /// @brief Carries out edits: first all moves and removals, then the insertions. Several new sites of one chord get
  /// the order of their arcs. O(edits log edits)
  /// @pre neighbouring sites lie within half a period of each other; a loop keeps 3 sites
  /// @throws InternalError if a site is changed twice, if two patches divide a chord, or if a site is gone already
  /// @return the indices that have changed or are new, each as often as it was changed
  std::vector<LocalIndex> apply(std::vector<BoundaryEdit> edits);

  /// @brief Numbers the sites along the loops again. A loop begins with the first of its old sites that still exists.
  /// O(sites + pieces) @return for each old index the new one, -1 if the site is gone
  std::vector<LocalIndex> renumber();

private:
  void move_or_remove(const BoundaryEdit& edit, std::vector<LocalIndex>& changed);
  void insert(const BoundaryEdit& edit, std::vector<LocalIndex>& changed);
  void place(LocalIndex site, double arc, geometry::Vec2 position);
  void close_chord(LocalIndex site);
  std::vector<LocalIndex> list_along_loops();
  void check(std::span<const BoundaryEdit> edits) const;

  const BoundaryCurve& curve_;
  BoundarySites sites_;
  std::vector<LocalIndex> loops_;     // by site
  std::vector<std::uint8_t> is_gone_; // by site
};

} // namespace trime::polygon
