// SPDX-License-Identifier: BSD-3-Clause
// What a run did about features of the boundary that are smaller than the triangles: a part of the result.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <string>
#include <vector>

namespace trime::boundary {

/// A corner of the boundary polygon and its angle on the inside.
struct SharpCorner {
  geometry::Vec2 place;
  double degrees;
};

/// What was done about features of the boundary that are smaller than the elements, in the last stage.
struct FeatureReport {
  static constexpr double sharp_angle = 56; ///< degrees; below, a good triangle does not fit in a corner
  GlobalId dropped_islands = 0, dropped_lakes = 0;
  double dropped_area = 0;                ///< of both
  double dropped_share = 0;               ///< that area over the shape's, as the shape was given
  GlobalId corners_left_out = 0;          ///< on the loops that stay
  double largest_deviation = 0;           ///< of one of them from its facet, over the local size
  GlobalId segments_halved = 0;           ///< after the layout, to keep their discs empty
  GlobalId size_limits = 0;               ///< places where the size was lowered
  double lowest_size_share = 1;           ///< there, of what was asked for
  std::vector<SharpCorner> sharp_corners; ///< below sharp_angle, the sharpest first
};

/// One line for each thing that was done; none for a boundary that needed nothing.
std::vector<std::string> describe(const FeatureReport& report);

} // namespace trime::boundary
