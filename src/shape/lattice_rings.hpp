// SPDX-License-Identifier: BSD-3-Clause
// The rings of a contour on the lattice, before they become a polygon. Finds rings that were given twice, and separates
// rings that touch.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/shape/part.hpp"

#include <array>
#include <vector>

namespace trime::shape {

/// A closed ring with the line of each vertex in its file.
struct LatticeRing {
  std::vector<geometry::Vec2> points;
  std::vector<int> lines;
  std::vector<int> markers{}; ///< as those of a ContourRing; empty after rings were separated
};

enum class Meeting { none, touch, crossing };

/// @brief Returns how two segments without a common end meet. Exact for lattice points.
Meeting meeting_of(const geometry::Segment& s, const geometry::Segment& t);

using SegmentPair = std::array<LocalIndex, 2>;

/// @brief Returns the pairs (i, j), i < j, of segments that meet, except neighbours of one ring; ascending.
///
/// The segments are those of the rings, one ring after the other, each from its vertex to the next. O(M log M), by all
/// threads. If many segments of a chunk meet others, only the first meetings are found, the same for any number of
/// threads.
std::vector<SegmentPair> find_meetings(const std::vector<LatticeRing>& rings, const geometry::SegmentGrid& grid);

/// Returns all segments, ring by ring.
std::vector<geometry::Segment> segments_of(const std::vector<LatticeRing>& rings);

/// A ring that was given before, with its first line and the first line of the other ring.
struct RepeatedRing {
  int line, first_line;
  bool loses_markers; ///< its markers differ from those of the other ring
};

/// @brief Keeps the first of rings that have the same edges, whatever their starts and directions.
std::vector<RepeatedRing> drop_repeated(std::vector<LatticeRing>& rings);

/// A place where rings met, with the lines of two vertices there, or of a vertex and the edge that it lies on.
struct RingTouch {
  geometry::Vec2 place;
  int line, other_line;
};

/// @brief Separates rings where a vertex lies on another vertex or on an edge, and rings do not cross.
///
/// The area stays the same. Each of its sectors around the place gets a separate vertex. One of these vertices stays,
/// and the others move into their sectors. So the area is never connected through the place. A
/// hole that touches its outer ring becomes a bay, and a ring that pinches the area becomes two rings. Where edges
/// overlap or rings cross, nothing is changed, and find_meetings finds them again.
/// @param meetings all meetings @param grid the grid of segments_of(rings) @param options the gap is at least
/// ShapeRules::touch_gap steps of the lattice
std::vector<RingTouch> part_touches(std::vector<LatticeRing>& rings, const std::vector<SegmentPair>& meetings,
                                    const geometry::SegmentGrid& grid, const geometry::Frame& frame,
                                    const TouchOptions& options);

} // namespace trime::shape
