// SPDX-License-Identifier: BSD-3-Clause
// Chooses by a shortest path which places of a ragged curve become sites. The cost of a chord estimates how much it
// spoils the triangles on it, by its length, its distance from the curve and its angle with the chord before.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <span>
#include <vector>

namespace trime::boundary {

/// A place on the curve that may become a site.
struct SitePlace {          ///< coordinate along the loop, see LoopMetric; not reduced modulo the loop's length
  double t;                 ///< coordinate of LoopMetric, unwrapped
  geometry::Vec2 position;  ///< position on the coordinate lattice
  double size = 0;          ///< wanted length of chords at this place
  double tolerance = 0;     ///< largest distance from a chord to a place that it leaves out
  LocalIndex junction = -1; ///< index of the piece that starts here; -1 inside a piece
};

/// @brief Returns the indices of the places that become sites, ascending, with the first and the last place.
///
/// Each place that is left out lies in the diametral circle of its chord and within the tolerance of it. Neighbouring
/// places may always be joined, so at least one path exists. The result is the path with the lowest cost. The cost is a
/// sum over chords and pairs of neighbouring chords, which estimates alpha - 1 of the triangles on them. The interior
/// of the shape is on the left. Takes O(n c^2) time if at most c <= 24 chords leave each place; uses only + - * / and
/// sqrt.
/// @param closed true if the last place is the first one again; then the angle between the last and the first chord
/// counts
std::vector<LocalIndex> shortest_site_path(std::span<const SitePlace> places, bool closed);

} // namespace trime::boundary
