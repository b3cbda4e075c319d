// SPDX-License-Identifier: BSD-3-Clause
// Where a shape, or the outside between its parts, is narrower than the resolution.
#pragma once

#include "generalise/curve_map.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// @brief A connected set of triangles on one side of the curves that is narrow throughout. Its lids are the edges
/// behind which that side becomes wider: none if all of a component or hole is narrow, one for a dead end, two or more
/// for a passage.
struct NarrowPart {
  bool inside = false; ///< of the shape
  std::vector<LocalIndex> triangles;
  std::vector<Triangulation::HalfEdge> lids; ///< seen from the narrow part
  double width = 0;                          ///< its least one, over the width below which parts are narrow
  double depth = 0;                          ///< of a dead end that holds nothing kept: from the lid to its tip
  double size = 0;                           ///< the smallest h at its nodes
  geometry::Vec2 place;                      ///< where it is narrowest
  double widened_to = 0;                     ///< [h] the width that it gets if its sides are moved apart
  geometry::Vec2 tip;                        ///< the node farthest from the lid
  bool is_corner = false;                    ///< a dead end between two straight arms
  bool holds_kept = false;                   ///< a vertex that the user has asked for, on the curve or inside
};

/// Adds nodes where the two sides of a narrow part have too few nodes to measure its width.
void add_nodes_to_narrow_parts(CurveMap& map);

/// @brief All narrow parts on one side, in the order of their first triangles. O(triangles)
/// @param labels by triangle: 1 inside, 0 outside
/// @param share of h: what is less wide is narrow
std::vector<NarrowPart> find_narrow_parts(const CurveMap& map, const std::vector<char>& labels, bool inside,
                                          double share);

/// @brief The dead ends that branch off from passages: from there no way leads to a lid, but through the passage. Each
/// has one lid, towards the rest of its passage. O(triangles)
/// @param passages all on one side
/// @param share as above
std::vector<NarrowPart> dead_ends_of(const CurveMap& map, const std::vector<char>& labels,
                                     std::span<const NarrowPart> passages, double share);

} // namespace trime::generalise
