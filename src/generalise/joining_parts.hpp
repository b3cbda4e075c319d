// SPDX-License-Identifier: BSD-3-Clause
// Finds the narrow parts of a shape that join or separate bodies larger than the triangles.
#pragma once

#include "generalise/narrow_parts.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// A triangle of each body and of each region that stays. With these triangles the caller later checks whether bodies
/// that were connected are still connected.
struct Witnesses {
  bool inside = true;                 ///< whether the bodies are parts of the shape (or of the outside)
  std::vector<LocalIndex> bodies;     ///< one triangle of each body, on the side of the narrow parts
  std::vector<LocalIndex> components; ///< by body: equal numbers if a way through narrow parts connects two bodies
  std::vector<LocalIndex> regions;    ///< one triangle of each region on the other side
};

/// Says which narrow parts of one side may be given to the other side.
struct Verdict {
  std::vector<char> goes;        ///< by part: whether it may go to the other side
  std::vector<LocalIndex> rest;  ///< triangles of small bodies that are cut off: they go, too
  std::vector<LocalIndex> loose; ///< triangles of small bodies that would be cut off if all parts went
  Witnesses witnesses;
};

/// @brief Decides which narrow parts may be given to the other side: dead ends, and parts that lead only to bodies
/// smaller than the triangles. A body is what remains of a side without its narrow parts. It is smaller than the
/// triangles if its area is below GeneraliseRules::least_body and the user asked for none of its vertices.
///
/// A part stays if it joins two bodies that stay, unless a wider part joins them, too. It also stays if two regions of
/// the other side would otherwise become one, and each has at least that area, or a perimeter of at least
/// GeneraliseRules::small_component. If a component has only small bodies, the largest one stays. Cost: O(triangles +
/// parts log(parts)).
/// @param labels by triangle: 1 inside the shape
/// @param parts narrow parts, all on one side
/// @param keeps_thin whether components with only small bodies stay as a whole, unless their perimeter is small
Verdict judge_parts(const CurveMap& map, const std::vector<char>& labels, std::span<const NarrowPart> parts,
                    bool keeps_thin);

/// Returns whether the triangles of all bodies and regions are on the same sides as before, bodies of one component are
/// still connected, and all regions are separate. Cost: O(triangles).
bool confirms(const CurveMap& map, const std::vector<char>& labels, const Witnesses& witnesses);

} // namespace trime::generalise
