// SPDX-License-Identifier: BSD-3-Clause
// The named parts that a region is made of: polygons (rectangle, triangle, contour, traced function) and circles, with
// all numbers on the lattice of the container, so that the inside tests are exact.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/contour.hpp"
#include "trime/geometry/frame.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace trime::geometry {

class Shape;

/// Centre and radius are multiples of the lattice step.
struct Circle {
  Vec2 center;
  double radius;
};

/// Simple closed rings that do not meet; inside by the even-odd rule.
struct Polygon {
  /// Segments first .. first + count - 1 of the grid; `reversed` if the interior lies on their right.
  struct Ring {
    LocalIndex first, count;
    bool reversed;
  };
  SegmentGrid grid; ///< segments ring by ring, each starting where the one before it ends
  std::vector<Ring> rings;
};

/// One named part. Immutable.
class Part {
public:
  /// @brief Axis-parallel rectangle. @throws GeometryError if it is not wider and higher than 0 or leaves frame.reach()
  static Part rectangle(const std::string& name, const Box& box, const Frame& frame);
  /// @brief Disc. @throws GeometryError if the radius is not positive or the disc leaves frame.reach()
  static Part circle(const std::string& name, Vec2 center, double radius, const Frame& frame);
  /// @brief Triangle, corners in either orientation. @throws GeometryError if they are collinear or leave frame.reach()
  static Part triangle(const std::string& name, const std::array<Vec2, 3>& corners, const Frame& frame);
  /// @brief Rings of a contour, moved by `normalization` and snapped; holes by even-odd nesting.
  ///
  /// O(M log M) for M vertices; the test for crossings uses all threads.
  /// @throws GeometryError `source:line: ...` if rings cross, touch or overlap themselves or each other, enclose no
  /// area, or leave frame.reach()
  static Part contour(const std::string& name, const Contour& contour, const Normalization& normalization,
                      const Frame& frame);
  /// @brief The inside of a function, `shape` < 0, as polygons that are traced within the container.
  ///
  /// Straight sides become one segment each, smooth curves chords that stray by 1e-6 of the container's longer side at
  /// most; corners that turn by more than 4 degrees are vertices, to within some lattice steps. A part that reaches
  /// beyond the container goes on a little way outside, so that `domain` may cut it; across a periodic side it goes on
  /// in its image, so the function must have the period of the container. Features narrower than
  /// `resolution` may be missed (default: 1/512 of the longer side; finer than 1/8192 of it is taken as that, with a
  /// warning, see warnings()). About (side/resolution)^2 / 4 evaluations plus some thousands per unit of length, by all
  /// threads; the function is not kept.
  /// @throws GeometryError with the place if a value is not finite, if pieces of the curve touch, and if the function
  /// oscillates below the resolution: more than 16384 closed curves, 4096 vertices between neighbouring grid lines or
  /// 2^23 in all before thinning, or 2^25 cells of half the resolution near zeros; and if the function has the same
  /// sign everywhere
  static Part implicit(const std::string& name, const Shape& shape, const Frame& frame, double resolution = 0);

  const std::string& name() const { return name_; }
  /// For the user, one sentence each: those of the contour, and vertices that the lattice made equal.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Null if the part is not of this kind.
  const Circle* as_circle() const { return std::get_if<Circle>(&form_); }
  const Polygon* as_polygon() const { return std::get_if<Polygon>(&form_); }
  bool is_contour() const { return is_contour_; }

  /// @brief The closed boundary with the interior on the left; a circle has four arcs that start at the right.
  /// Loops in the order of the rings, tags from 1, `part` 0.
  std::vector<Loop> boundary() const;
  /// @brief Exact for lattice points; a point on the boundary may get either answer. O(log M), thread-safe.
  bool inside(Vec2 p) const;
  /// Distance from p to the boundary of the part. Thread-safe.
  double distance(Vec2 p) const;

private:
  Part(const std::string& name, std::variant<Polygon, Circle> form) : name_(name), form_(std::move(form)) {}

  std::string name_;
  std::variant<Polygon, Circle> form_;
  std::vector<std::string> warnings_;
  bool is_contour_ = false;
};

/// The four vertices of a circle at angles 0, pi/2, pi, 3 pi/2; exact.
std::array<Vec2, 4> quadrant_vertices(const Circle& circle);

/// @brief Counter-clockwise arc of `circle` from a to b, less than a full turn.
Piece make_arc(const Circle& circle, Vec2 a, Vec2 b);

} // namespace trime::geometry
