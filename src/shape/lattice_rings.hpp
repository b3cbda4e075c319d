// SPDX-License-Identifier: BSD-3-Clause
// The rings of a contour after rounding to the coordinate lattice, before they become a polygon. Finds rings that occur
// twice, and separates rings that touch.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/shape/part.hpp"

#include <array>
#include <vector>

namespace trime::shape {

/// A closed ring, with the line of each vertex in its file.
struct LatticeRing {
  std::vector<geometry::Vec2> points;
  std::vector<int> lines;
  std::vector<int> markers{}; ///< markers as in ContourRing; empty after rings were separated
  int polygon = 0;            ///< number as in ContourRing
};

enum class Meeting { none, touch, crossing };

/// @brief Returns whether two segments without a common end touch or cross. Exact for lattice points.
Meeting meeting_of(const geometry::Segment& s, const geometry::Segment& t);

using SegmentPair = std::array<LocalIndex, 2>;

/// @brief Returns the pairs (i, j), i < j, of segments that touch or cross, in ascending order. Neighbours in one ring
/// are left out.
///
/// The segments are those of the rings, one ring after the other, each from its vertex to the next. Cost: O(M log M),
/// by all threads. If many segments of a chunk meet others, only the first meetings are returned, which are the same
/// for any number of threads.
std::vector<SegmentPair> find_meetings(const std::vector<LatticeRing>& rings, const geometry::SegmentGrid& grid);

/// Returns the segments of all rings, ring by ring.
std::vector<geometry::Segment> segments_of(const std::vector<LatticeRing>& rings);

/// A ring that occurs a second time, with its first line in the file and the first line of the other occurrence.
struct RepeatedRing {
  int line, first_line;
  bool loses_markers; ///< whether its markers differ from those of the other occurrence
};

/// @brief Removes rings whose edges equal those of an earlier ring, regardless of start and direction. Returns the
/// removed rings.
std::vector<RepeatedRing> drop_repeated(std::vector<LatticeRing>& rings);

/// A place where rings touched, with the lines in the file of two vertices there, or of a vertex and the edge on which
/// it lies.
struct RingTouch {
  geometry::Vec2 place;
  int line, other_line;
};

/// @brief Separates rings that touch without crossing: where a vertex of one ring lies on a vertex or an edge of
/// another ring.
///
/// The area stays the same. Each sector of the area around the place gets a separate vertex. One of these vertices
/// stays, and each other vertex moves into its sector. So the area is never connected through the point where the rings
/// touched. A hole that touches its outer ring becomes a bay, and a ring that pinches the area becomes two rings. Where
/// edges overlap or rings cross, nothing is changed, so that find_meetings still finds them.
/// @param meetings all pairs of segments that meet
/// @param grid the grid made from segments_of(rings)
/// @param options the gap is at least ShapeRules::touch_gap steps of the lattice
std::vector<RingTouch> part_touches(std::vector<LatticeRing>& rings, const std::vector<SegmentPair>& meetings,
                                    const geometry::SegmentGrid& grid, const geometry::Frame& frame,
                                    const TouchOptions& options);

} // namespace trime::shape
