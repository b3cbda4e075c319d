// SPDX-License-Identifier: BSD-3-Clause
// Finds where a shape, or the outside between its parts, is narrower than the resolution of the mesh.
#pragma once

#include "generalise/curve_map.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// @brief A connected set of triangles, on one side of the curves, that is narrow everywhere. Its lids are the edges
/// behind which that side becomes wider. A component or hole that is narrow everywhere has no lid, a dead end has one
/// lid, and a passage has two or more.
struct NarrowPart {
  bool inside = false; ///< true if the part belongs to the shape, false if it belongs to the outside
  std::vector<LocalIndex> triangles;
  std::vector<Triangulation::HalfEdge> lids; ///< half-edges of the narrow part behind which its side becomes wider
  double width = 0;                          ///< smallest width, divided by the width below which parts are narrow
  double depth = 0;                          ///< distance from the lid to the tip, for a dead end without kept vertices
  double size = 0;                           ///< smallest h at the part's nodes
  geometry::Vec2 place;                      ///< place where the part is narrowest
  double widened_to = 0;                     ///< [h] width of the part after its sides were moved apart
  geometry::Vec2 tip;                        ///< the node farthest from the lid
  bool is_corner = false;                    ///< true for a dead end between two straight sides
  bool holds_kept = false; ///< whether the part contains a vertex that the user asked for, on the curve or inside
};

/// Adds nodes where the two sides of a narrow part have too few nodes to measure its width.
void add_nodes_to_narrow_parts(CurveMap& map);

/// @brief Returns all narrow parts on one side, in the order of their first triangles. Cost: O(triangles).
/// @param labels by triangle: 1 inside, 0 outside
/// @param share [h] width below which a part is narrow
std::vector<NarrowPart> find_narrow_parts(const CurveMap& map, const std::vector<char>& labels, bool inside,
                                          double share);

/// @brief Returns the dead ends that branch off from passages: from such a triangle, each way to a lid leads through
/// the passage. Each dead end has one lid, towards its passage. Cost: O(triangles).
/// @param passages passages, all on one side
/// @param share [h] width below which a part is narrow
std::vector<NarrowPart> dead_ends_of(const CurveMap& map, const std::vector<char>& labels,
                                     std::span<const NarrowPart> passages, double share);

} // namespace trime::generalise
