// SPDX-License-Identifier: BSD-3-Clause
// Gives parts of regions that are smaller or narrower than the triangles to the regions next to them.
#pragma once

#include "generalise/cut_wedges.hpp"
#include "generalise/snap_arcs.hpp"
#include "trime/geometry/boundary.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace trime::generalise {

/// Says which parts of regions are given away.
enum class SmallParts : std::uint8_t {
  faces,     ///< connected parts with a short perimeter, and slivers
  and_necks, ///< in addition narrow passages between wider parts, and narrow ends of a region at the boundary
};

/// Curves inside a shape and its boundary.
struct Partition {
  geometry::InnerCurves curves;
  geometry::Boundary boundary;
  bool is_relabelled = false; ///< whether regions or corners along the boundary may differ from the given ones
  JoinedLines joined{};       ///< curves that were joined with interfaces
};

/// @brief Gives small parts of regions to the region with which they share the longest border. Faces are small if their
/// perimeter is below GeneraliseRules::smallest_face or their width below GeneraliseRules::narrowest_face. Narrow parts
/// are found in a triangulation of all curves, as those of the shape are: passages, ends at the boundary, and thin tips
/// (but not at the nodes ArcRequest::tips). Two regions between which `pairs` knows no
/// interface do not become neighbours. Parts at arcs of circles and at vertices that must stay are not changed. Curves
/// of the user stay, with other regions next to them; a part with curves all around it is not changed.
///
/// The curves and the boundary that result share their vertices with the given ones; arcs that are not concerned stay
/// as they are, in their order. Where an interface no longer meets the boundary, the corner of the boundary goes.
/// Adds to InnerCurves::losses; what the simplification of an arc has taken from its left side before is listed there
/// as well if the arc changes. Cost: O(n log n) for each of a few rounds.
/// @param pairs pairs of regions, the lower one first, in ascending order
/// @return nothing if no part is small, or if curves cross
/// @pre the container is not periodic
/// @throws GeometryError if a size is not positive and finite
std::optional<Partition> absorb_parts(const geometry::InnerCurves& curves, const geometry::Boundary& boundary,
                                      const ArcRequest& request, std::span<const std::array<int, 2>> pairs,
                                      SmallParts which);

} // namespace trime::generalise
