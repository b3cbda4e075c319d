// SPDX-License-Identifier: BSD-3-Clause
// Which places of a ragged curve become sites: the shortest path through them, where a chord costs what its length, its
// distance from the curve and its angle with the chord before do to the triangles on it.
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
  double size = 0;          ///< wanted length of chords
  double tolerance = 0;     ///< how far a chord may pass from places that it leaves out
  LocalIndex junction = -1; ///< index of the piece that starts here; -1 within a piece
};

/// @brief Places that become sites, ascending, the first and the last among them.
///
/// Each place left out lies in the disc of its chord, and at most the tolerance from it; neighbouring places always may
/// be joined, so that there is a path. Among these the path of least cost, a sum over chords and pairs of neighbouring
/// chords: an estimate of alpha - 1 over the triangles there. Interior on the left. O(n c^2) for c <= 24 chords from a
/// place; by + - * / sqrt alone.
/// @param closed the last place is the first one come round; the angle between the last chord and the first counts
std::vector<LocalIndex> shortest_site_path(std::span<const SitePlace> places, bool closed);

} // namespace trime::boundary
