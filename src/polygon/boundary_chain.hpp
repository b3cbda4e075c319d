// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary while some of them move, come and go: every change costs what it touches.
#pragma once

#include "polygon/boundary_curve.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::polygon {

enum class EditKind : std::int32_t { move, remove, insert };

/// One change of the boundary sites. Sites keep their order along the loop.
struct BoundaryEdit {
  LocalIndex site = -1; ///< that moves along its curve or goes; for a new site the one before it
  EditKind kind = EditKind::move;
  double arc = 0;          ///< of the new place
  geometry::Vec2 position; ///< of the new place, canonical
  std::uint64_t patch = 0; ///< which patch wants it: only one may divide a chord
};

/// @brief A copy of boundary sites as a linked list. Sites keep their index until renumber; new ones are appended, so
/// that indices no longer follow the loops. All ranks hold the same copy.
class BoundaryChain {
public:
  /// The curve must outlive the object.
  BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve);

  /// `loop_start`, counts and sums are those of the last renumber, or of the beginning.
  const BoundarySites& sites() const { return sites_; }
  LocalIndex loop(LocalIndex site) const { return loops_[static_cast<std::size_t>(site)]; }
  const BoundaryCurve& curve() const { return curve_; }

  /// @brief Carries out edits: first all moves and removals, then the insertions. Several new sites of one chord stand
  /// in the order of their arcs. O(edits log edits)
  /// @pre neighbouring sites lie within half a period of each other; a loop keeps 3 sites
  /// @throws InternalError if a site is changed twice, if two patches divide a chord, or if a site is gone already
  /// @return the indices that have changed or are new, each as often as it has changed
  std::vector<LocalIndex> apply(std::vector<BoundaryEdit> edits);

  /// @brief Numbers the sites along the loops again. A loop begins with the first of its old sites that is left.
  /// O(sites + pieces) @return by the index until now the new one, -1 if the site is gone
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
