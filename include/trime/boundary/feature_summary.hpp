// SPDX-License-Identifier: BSD-3-Clause
// Part of the result: how a run simplified features of the boundary that are smaller than the triangles.
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

/// How the last stage simplified features of the boundary that are smaller than the triangles.
struct FeatureReport {
  static constexpr double sharp_angle = 56; ///< degrees; below, a good triangle does not fit in a corner
  GlobalId dropped_islands = 0, dropped_lakes = 0;
  double dropped_area = 0;                ///< the area of both
  double dropped_share = 0;               ///< that area divided by the area of the given shape
  GlobalId corners_left_out = 0;          ///< on the loops that were kept
  double largest_deviation = 0;           ///< distance of one of them from its facet, divided by the local size
  GlobalId segments_halved = 0;           ///< halved after the layout, to keep their diametral circles empty
  GlobalId size_limits = 0;               ///< places where the size was lowered
  double lowest_size_share = 1;           ///< smallest size at these places, divided by the size that was asked for
  std::vector<SharpCorner> sharp_corners; ///< below sharp_angle, the sharpest first
  GlobalId cut = 0;                       ///< narrow parts of the shape that were cut off before the layout
  GlobalId closed = 0,
           widened = 0;      ///< narrow parts of the outside: those that were filled, and those with sides moved apart
  GlobalId severed = 0;      ///< narrow parts that joined or separated what stays, and were cut or closed
  double widest_severed = 0; ///< the least width of the widest of these, divided by the size
  geometry::Vec2 severed_place;  ///< where that is
  GlobalId held = 0;             ///< narrow parts that were kept since they join or separate what stays
  GlobalId filled = 0;           ///< holes around which no triangle fits
  GlobalId smoothed = 0;         ///< vertices of ragged curves that smoothing replaced
  GlobalId thinned = 0;          ///< pieces of ragged curves that thinning replaced
  double coarseness = 1;         ///< the h for which the boundary was simplified, divided by the h of the mesh
  GlobalId other_components = 0; ///< left out since one component was asked for
  double other_share = 0;        ///< their area divided by that of the shape
  double lost_share = 0,
         added_share = 0;      ///< areas divided by the area of the shape, including dropped islands and lakes
  std::vector<LoopFate> loops; ///< one for each loop of the shape, in their order
  int given_components = 0, given_holes = 0; ///< of the shape as it was given
  int components = 0, holes = 0;             ///< of the simplified shape, which the mesh has
  geometry::Vec2 lost_place;                 ///< first vertex of the longest loop that is lost
  double lost_perimeter = 0;                 ///< its length divided by the size there
};

/// Returns one line of text for each kind of change; no lines for a boundary that was kept as it is.
std::vector<std::string> describe(const FeatureReport& report);

/// Has the mesh other components or holes than the shape as it was given, or was a loop lost or split?
bool changes_topology(const FeatureReport& report);

/// Returns a warning that says what of the shape is missing in the mesh, and what the user can do. Numbers of
/// components and holes that have changed come first, with the reason and a place. It is empty if no loop is lost or
/// split, the numbers of components and holes are those of the shape, and at most 0.1 % of the area is lost or added.
std::string loss_warning(const FeatureReport& report);

} // namespace trime::boundary
