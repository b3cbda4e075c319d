// SPDX-License-Identifier: BSD-3-Clause
// What a run did about features of the boundary that are smaller than the triangles: a part of the result.
#pragma once

#include "trime/boundary/loop_fate.hpp"
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
  GlobalId cut = 0;                       ///< narrow parts of the shape, before anything was laid out
  GlobalId closed = 0, widened = 0;       ///< narrow parts of the outside: filled; sides moved apart
  GlobalId filled = 0;                    ///< holes around which no triangle fits
  GlobalId smoothed = 0;                  ///< vertices of ragged curves that others stand for
  GlobalId thinned = 0;                   ///< pieces of ragged curves that others stand for
  double coarseness = 1;                  ///< the h for which all this was done, over that of the mesh
  double lost_share = 0, added_share = 0; ///< of the shape's area, by all of these, dropped islands and lakes included
  std::vector<LoopFate> loops;            ///< of the shape, in their order
};

/// One line for each thing that was done; none for a boundary that needed nothing.
std::vector<std::string> describe(const FeatureReport& report);

/// What of the shape is not in the mesh, and what to do about it, in one warning. Empty if no loop is lost, and at most
/// 0.1 % of the area is lost or added.
std::string loss_warning(const FeatureReport& report);

} // namespace trime::boundary
