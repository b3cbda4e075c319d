// SPDX-License-Identifier: BSD-3-Clause
// Finds the narrow parts that join or separate bodies above the resolution.
#pragma once

#include "generalise/narrow_parts.hpp"

#include <span>
#include <vector>

namespace trime::generalise {

/// A triangle of each body and region that stays. They show later whether what was connected is connected still.
struct Witnesses {
  bool inside = true;                 ///< the side of the bodies
  std::vector<LocalIndex> bodies;     ///< triangles on the side of the parts
  std::vector<LocalIndex> components; ///< by body: equal where a way through narrow parts leads from one to the other
  std::vector<LocalIndex> regions;    ///< triangles on the other side
};

/// States what the narrow parts of one side may become.
struct Verdict {
  std::vector<char> goes;        ///< by part: whether it may go to the other side
  std::vector<LocalIndex> rest;  ///< triangles of small bodies that are cut off: they go, too
  std::vector<LocalIndex> loose; ///< triangles of small bodies that would be cut off if all parts went
  Witnesses witnesses;
};

/// @brief Decides which narrow parts may go to the other side: dead ends, and what leads only to bodies below the
/// resolution. A body is what remains of a side without its narrow parts; it is below the resolution if its area is
/// below GeneraliseRules::least_body and the user has asked for none of its vertices.
///
/// A part stays if it joins two bodies that stay, and no wider way does. It also stays if two regions of the other side
/// would become one, each with that area, or a perimeter of GeneraliseRules::small_component or more. Where a component
/// has only bodies below the resolution, the largest one stays. O(triangles + parts log(parts))
/// @param labels by triangle: 1 inside
/// @param parts all on one side
/// @param keeps_thin components without a body above the resolution stay as a whole, unless their perimeter is small
Verdict judge_parts(const CurveMap& map, const std::vector<char>& labels, std::span<const NarrowPart> parts,
                    bool keeps_thin);

/// Returns whether the witnesses are on the same sides as before, those of one component are still connected, and all
/// regions are separate. O(triangles)
bool confirms(const CurveMap& map, const std::vector<char>& labels, const Witnesses& witnesses);

} // namespace trime::generalise
