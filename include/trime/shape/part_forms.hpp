// SPDX-License-Identifier: BSD-3-Clause
// The forms of a part on the lattice: a circle, or a polygon of simple rings.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <string>
#include <vector>

namespace trime::shape {

/// A circle whose centre and radius are multiples of the lattice step.
struct Circle {
  geometry::Vec2 center;
  double radius;
};

/// Simple closed rings that do not meet. The even-odd rule says what is inside.
struct Polygon {
  /// Segments first .. first + count - 1 of the grid; `reversed` if the interior lies on their right.
  struct Ring {
    LocalIndex first, count;
    bool reversed;
  };
  geometry::SegmentGrid grid; ///< segments ring by ring, each starting where the one before it ends
  std::vector<Ring> rings;
  std::vector<int> markers{};              ///< marker of each segment; 0 for no marker; empty if all are 0
  std::vector<std::string> marker_names{}; ///< Contour::marker_names
};

/// Returns the four vertices of a circle at angles 0, pi/2, pi, 3 pi/2; exact.
std::array<geometry::Vec2, 4> quadrant_vertices(const Circle& circle);

/// @brief Returns the counter-clockwise arc of `circle` from a to b, less than a full turn.
geometry::Piece make_arc(const Circle& circle, geometry::Vec2 a, geometry::Vec2 b);

} // namespace trime::shape
