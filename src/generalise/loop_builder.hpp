// SPDX-License-Identifier: BSD-3-Clause
// Makes closed loops around the triangles that lie inside the shape.
#pragma once

#include "generalise/curve_map.hpp"

#include <vector>

namespace trime::generalise {

/// The position of each vertex after some were moved; empty if no vertex was moved.
using MovedVertices = std::vector<geometry::Vec2>;

/// @brief Makes the loops around the triangles that lie inside, from the remaining pieces of the given boundary and
/// straight pieces elsewhere. Unchanged loops are bit-identical. The tag of a given loop goes to the largest new loop
/// that contains pieces of it; other loops get new tags.
/// @param labels labels of triangles for which no loops touch, see separate_touching_loops
geometry::Boundary build_loops(const CurveMap& map, const std::vector<char>& labels, const MovedVertices& moved);

/// @brief Changes labels until no two loops around the inside meet in a vertex. Where they meet, the part with the
/// shortest edges is removed, if these are shorter than GeneraliseRules::narrow_inside and the part has no point that
/// must stay inside. Otherwise the triangles around the vertex get their old labels back. Returns false if that does
/// not end. O(triangles + changed triangles log(changed triangles))
/// @param given labels of a boundary that does not touch itself
bool separate_touching_loops(const CurveMap& map, const std::vector<char>& given, std::vector<char>& labels);

} // namespace trime::generalise
