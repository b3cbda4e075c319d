// SPDX-License-Identifier: BSD-3-Clause
// The rings of a contour on the lattice, before they are a polygon: what was given twice, and where rings touch.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"

#include <array>
#include <vector>

namespace trime::shape {

/// A closed ring with the line of each vertex in its file.
struct LatticeRing {
  std::vector<geometry::Vec2> points;
  std::vector<int> lines;
  std::vector<int> markers{}; ///< as those of a ContourRing; lost where rings are parted
};

enum class Meeting { none, touch, crossing };

/// @brief How two segments without a common end meet; exact for lattice points.
Meeting meeting_of(const geometry::Segment& s, const geometry::Segment& t);

using SegmentPair = std::array<LocalIndex, 2>;

/// @brief Returns the pairs (i, j), i < j, of segments that meet, except neighbours of one ring; ascending.
///
/// The segments are those of the rings in turn, each from its vertex to the next. Uses all threads, O(M log M); of a
/// part of the segments with very many meetings only the first are found, the same on any threads.
std::vector<SegmentPair> find_meetings(const std::vector<LatticeRing>& rings, const geometry::SegmentGrid& grid);

/// All segments, ring by ring.
std::vector<geometry::Segment> segments_of(const std::vector<LatticeRing>& rings);

/// A ring that was given before, with its first line and that of the other.
struct RepeatedRing {
  int line, first_line;
  bool loses_markers; ///< it has others than the one before
};

/// @brief Keeps the first of rings that have the same edges, whatever their starts and directions.
std::vector<RepeatedRing> drop_repeated(std::vector<LatticeRing>& rings);

/// A place where rings met, with the lines of two vertices there, or of a vertex and the edge that it lies on.
struct RingTouch {
  geometry::Vec2 place;
  int line, other_line;
};

/// @brief Parts rings where a vertex lies on another vertex or on an edge, and rings do not cross there.
///
/// The area stays the same: each sector of it around the place gets a separate vertex. One of these vertices stays, and
/// the others move into their sectors by ShapeRules::touch_gap. So the area never reaches through the place. A hole
/// that touches its outer ring becomes a bay, and a ring that pinches the area becomes two rings. Where edges overlap,
/// or rings cross, nothing is done: find_meetings finds them again.
/// @param meetings all of them @param grid of segments_of(rings)
std::vector<RingTouch> part_touches(std::vector<LatticeRing>& rings, const std::vector<SegmentPair>& meetings,
                                    const geometry::SegmentGrid& grid, const geometry::Frame& frame);

} // namespace trime::shape
