// SPDX-License-Identifier: BSD-3-Clause
// Chooses the places of a ragged curve that become sites, by a shortest path. The cost of a chord estimates how much
// its length, its distance from the curve and its angle with the chord before spoil the triangles on it.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <span>
#include <vector>

namespace trime::boundary {

/// A place on the curve that may become a site.
struct SitePlace {
  double t;                 ///< coordinate of LoopMetric, unwrapped
  geometry::Vec2 position;  ///< on the lattice
  double size = 0;          ///< wanted length of chords there
  double tolerance = 0;     ///< largest distance of a chord from places that it leaves out
  LocalIndex junction = -1; ///< index of the piece that starts here; -1 within a piece
};

/// @brief Returns the places that become sites in ascending order, including the first and the last.
///
/// Each place left out lies in the disc of its chord and within the tolerance of it. Neighbouring places may always be
/// joined, so there is a path. The result is the path of least cost. The cost is a sum over chords and pairs of
/// neighbouring chords, which estimates alpha - 1 of the triangles there. The interior is on the left. O(n c^2) for c
/// <= 24 chords from a place; uses only + - * / and sqrt.
/// @param closed if true, the last place is the first one again, and the angle between the last and the first chord
/// counts
std::vector<LocalIndex> shortest_site_path(std::span<const SitePlace> places, bool closed);

} // namespace trime::boundary
