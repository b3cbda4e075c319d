// SPDX-License-Identifier: BSD-3-Clause
// Finds where a shape, or the outside between its parts, is narrower than the resolution.
#pragma once

#include "generalise/curve_map.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// @brief A connected set of triangles on one side of the curves that is narrow everywhere. Its lids are the edges
/// behind which that side becomes wider. A component or hole that is narrow everywhere has no lid, a dead end has one,
/// and a passage has two or more.
struct NarrowPart {
  bool inside = false; ///< true if it belongs to the shape, false if to the outside
  std::vector<LocalIndex> triangles;
  std::vector<Triangulation::HalfEdge> lids; ///< half-edges of the narrow part
  double width = 0;                          ///< least width, over the width below which parts are narrow
  double depth = 0;                          ///< distance from the lid to the tip, for a dead end without kept vertices
  double size = 0;                           ///< the smallest h at its nodes
  geometry::Vec2 place;                      ///< where it is narrowest
  double widened_to = 0;                     ///< [h] the width that it gets if its sides are moved apart
  geometry::Vec2 tip;                        ///< the node farthest from the lid
  bool is_corner = false;                    ///< true for a dead end between two straight arms
  bool holds_kept = false; ///< true if it contains a vertex that the user has asked for, on the curve or inside
};

/// Adds nodes where the two sides of a narrow part have too few nodes to measure its width.
void add_nodes_to_narrow_parts(CurveMap& map);

/// @brief Returns all narrow parts on one side, in the order of their first triangles. O(triangles)
/// @param labels by triangle: 1 inside, 0 outside
/// @param share [h] width below which a part is narrow
std::vector<NarrowPart> find_narrow_parts(const CurveMap& map, const std::vector<char>& labels, bool inside,
                                          double share);

/// @brief The dead ends that branch off from passages: from there no way leads to a lid, but through the passage. Each
/// has one lid, towards the rest of its passage. O(triangles)
/// @param passages all on one side
/// @param share as above
std::vector<NarrowPart> dead_ends_of(const CurveMap& map, const std::vector<char>& labels,
                                     std::span<const NarrowPart> passages, double share);

} // namespace trime::generalise
