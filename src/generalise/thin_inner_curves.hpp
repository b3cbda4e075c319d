// SPDX-License-Identifier: BSD-3-Clause
// Simplifies the curves inside a shape to the resolution of a mesh.
#pragma once

#include "generalise/absorb_parts.hpp"

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>
#include <span>

namespace trime::generalise {

/// @brief Returns the curves without vertices whose removal changes little. The vertex of an arc whose triangle with
/// its neighbours has the smallest area goes first (Visvalingam and Whyatt 1993). This ends when the smallest area is
/// GeneraliseRules::vertex_area h^2. A vertex stays if it is farther than GeneraliseRules::vertex_move h from the edge
/// that would replace it.
///
/// Before, curves are joined with the interfaces and curves that they follow, see snapped_arcs(), and with regions also
/// by zip_lines(). Then interfaces between regions are smoothed, see smooth_arcs(), and narrow wedges are cut
/// afterwards, see cut_wedges(). InnerArc::lost_area says how much area an interface takes from its left side.
///
/// Nodes, corners that the user asked for, and all other curves stay on their side: a vertex stays if its triangle
/// contains a vertex of another curve or of the boundary (see VertexTree). Only straight pieces are changed. Cost: O(n
/// log n) for n pieces of the curves and the boundary.
/// @param boundary the boundary that is meshed
/// @param corners vertices that stay, in lexicographic order
/// @throws GeometryError if a size is not positive and finite
geometry::InnerCurves thin_inner_curves(const geometry::InnerCurves& curves, const geometry::Boundary& boundary,
                                        const sizing::SizeField& size, const geometry::Lattice& lattice,
                                        std::span<const geometry::Vec2> corners);

/// @brief Does the same, and gives parts of regions that are smaller or narrower than the triangles to the regions next
/// to them, see absorb_parts(): small faces first, narrow parts once the arcs are simple. The arcs that result are
/// simplified again, until no part is narrow, or for a few rounds.
/// @param pairs pairs of regions that may be neighbours, the lower one first, in ascending order
/// @pre the container is not periodic, unless `pairs` is empty
Partition simplify_partition(const geometry::InnerCurves& curves, const geometry::Boundary& boundary,
                             const ArcRequest& request, std::span<const std::array<int, 2>> pairs);

} // namespace trime::generalise
