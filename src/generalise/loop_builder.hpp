// SPDX-License-Identifier: BSD-3-Clause
// From triangles that are inside to the closed loops around them.
#pragma once

#include "generalise/curve_map.hpp"

#include <vector>

namespace trime::generalise {

/// Where the curves lead after vertices were moved: by vertex; empty if none was.
using MovedVertices = std::vector<geometry::Vec2>;

/// @brief Loops around the triangles that are inside, each of the pieces of the given boundary as far as they remain,
/// and straight pieces elsewhere. Loops that nothing has changed come out as they were, bit for bit. Tags stay with the
/// largest loop that has pieces of the one that bore it; further loops get new tags.
/// @param labels by triangle, such that no loops touch: see separate_touching_loops
geometry::Boundary build_loops(const CurveMap& map, const std::vector<char>& labels, const MovedVertices& moved);

/// @brief Changes labels until no two ways around the inside meet in a vertex. Where they do, the part with the
/// shortest edges goes, if they are shorter than GeneraliseRules::narrow_inside and lead to no point that must stay
/// inside. Else the triangles around the vertex get back the labels that they had. False if that does not end.
/// O(triangles) a round
/// @param given the labels of a boundary that does not touch itself
bool separate_touching_loops(const CurveMap& map, const std::vector<char>& given, std::vector<char>& labels);

} // namespace trime::generalise
