// SPDX-License-Identifier: BSD-3-Clause
// Tests whether points of a periodic container lie in an area whose border crosses the sides of the container, or winds
// around it.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"

#include <vector>

namespace trime::geometry {

/// @brief Returns the segments together with additional ones outside of `window`, so that every end belongs to an even
/// number of segments. Then the even-odd rule separates inside from outside in the window, but does not say which is
/// which.
/// @param segments an end that belongs to an odd number of them must lie outside of `window`
/// @param margin distance of the added segments from all others; a multiple of the coordinate lattice's step, as are
/// all ends
std::vector<Segment> close_outside(std::vector<Segment> segments, const Box& window, double margin);

/// @brief An area of a periodic container. The segments of its border and their images that meet the container are
/// completed to closed polygons outside of it. Then the even-odd rule separates the area from the rest; the left side
/// of one segment shows which is which. Immutable and thread-safe; takes O(n log n) time to build for n segments.
class PeriodicOutline {
public:
  /// @param border with the area on its left; each segment as any of its images. The segments form closed paths in the
  /// periodic container, and there is at least one
  PeriodicOutline(const std::vector<Segment>& border, const Periods& periods, const Lattice& lattice);

  /// Returns whether a point of the container lies inside. Exact for lattice points off the border.
  bool inside(Vec2 p) const { return closed_.inside(p) != inverted_; }
  /// Returns the nearest segment of the border or image of one within the distance `reach` of a point of the container.
  bool is_within(Vec2 p, double reach) const { return images_.nearest(p, reach).has_value(); }
  /// Returns a box that holds all of the area that lies in the container, or an empty one if that may be everywhere.
  Box box() const;
  std::size_t memory_bytes() const { return closed_.memory_bytes() + images_.memory_bytes(); }

private:
  SegmentGrid images_, closed_;
  bool inverted_ = false;
};

} // namespace trime::geometry
