// SPDX-License-Identifier: BSD-3-Clause
// Takes from a ring what has no area: spikes, and pairs of edges that lead to an inner ring and back ("keyholes").
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/vec2.hpp"

#include <functional>
#include <string>
#include <vector>

namespace trime::contours {

/// Something without area that a ring has.
struct Seam {
  std::size_t vertex;   ///< index in the ring as it is given
  geometry::Vec2 place; ///< the tip of a spike, or a vertex between the edges that cancel each other
  bool is_spike;
};

/// A ring without what has no area.
struct RepairedRing {
  std::vector<ContourRing> rings; ///< none if nothing with area is left; one or more otherwise
  std::vector<Seam> seams;        ///< in the order of their vertices; empty: `rings` holds the ring as it is given
};

/// @brief Removes pairs of edges that have the same ends and opposite directions, which do not change what the ring
/// encloses. If a vertex of the ring lies on an edge, the two parts of this edge count as edges. The edges that are
/// left form rings in their former order, and keep their lines and markers.
///
/// ContourRing::in_file must be empty. Cost: O(n log n) if the boxes of few edges overlap.
/// @param tolerance a vertex that is nearer to an edge lies on it
RepairedRing repair_ring(const ContourRing& ring, double tolerance);

/// Names the place of a vertex of a ring for the user.
struct PlaceText {
  std::function<std::string(int line)> where;             ///< file and line
  std::function<std::string(geometry::Vec2 place)> point; ///< coordinates
};

/// @brief Adds a fault for each seam, or one fault if nothing of the ring is left.
/// @param ring as it was given to repair_ring
void add_faults(FaultList& faults, const RepairedRing& repaired, const ContourRing& ring, const PlaceText& text);

/// @brief Replaces each ring by those that repair_ring makes of it, and adds the seams to the faults of the contour.
/// The tolerance is 1e-12 of the size of the ring.
/// @pre the rings are not projected
void repair_rings(Contour& contour);

} // namespace trime::contours
