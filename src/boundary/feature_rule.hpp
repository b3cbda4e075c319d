// SPDX-License-Identifier: BSD-3-Clause
// Decides which features of the boundary that are smaller than the triangles are left out of the mesh.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/boundary/features.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/sizing/size_field.hpp"

#include <span>

namespace trime::boundary {

/// @brief The rule drops loops whose perimeter is below `least_perimeter` local sizes. The rule leaves out a corner if
/// the boundary edges then stay within `tolerance` local sizes of the boundary. The rule always keeps corners whose two
/// sides are at least two local sizes long, and corners that the user asked for (Piece::corner). The default keeps
/// everything.
struct FeatureRule {
  double tolerance = 0;
  double least_perimeter = 0;
  Components components = Components::all;
  geometry::Vec2 place{};     ///< for Components::at
  double inner_tolerance = 0; ///< like `tolerance`, for curves and interfaces inside
};

/// @brief Checks that the options choose exactly one component of the given boundary. Cost: O(pieces).
/// @throws GeometryError if the chosen place lies outside of the shape, or the container is periodic
void check_choice_of_component(const geometry::Boundary& boundary, const FeatureOptions& options);

/// @brief Adds the loops of all components except the chosen one to the dropped loops. If no component contains the
/// chosen place, because the part around it was cut off, the nearest component is chosen. Does nothing in a periodic
/// container. Cost: O(pieces) for each component around a hole.
void drop_other_components(const geometry::Boundary& boundary, const FeatureRule& rule, polygon::DroppedLoops& dropped);

/// Returns whether p is inside by the even-odd rule. O(pieces)
bool lies_within(std::span<const geometry::Loop> loops, geometry::Vec2 p);

/// Returns the area that a loop encloses, with exact arcs; positive if the loop is counter-clockwise. Cost: O(pieces).
/// @pre the loop does not wind around the container
double enclosed_area(const geometry::Loop& loop);

/// Returns the boundary without the dropped loops. Cost: O(pieces).
geometry::Boundary boundary_without(const geometry::Boundary& boundary, const polygon::DroppedLoops& dropped);

/// @brief Returns the loops that the rule drops. A loop stays if it winds around the container, has a corner that the
/// user asked for, or encloses more than 1 % of the area of the shape, a remaining loop, or a point of `inside`. One
/// component always stays. Cost: O(pieces + loops log loops) for separate loops.
/// @param inside points of the shape that must remain in it, in lexicographic order
polygon::DroppedLoops drop_small_loops(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                       double least_perimeter, std::span<const geometry::Vec2> inside = {});

} // namespace trime::boundary
