// SPDX-License-Identifier: BSD-3-Clause
// The named parts that a region is made of: polygons (rectangle, triangle, contour, traced function) and circles. All
// coordinates lie on the lattice of the container, so the inside tests are exact.
#pragma once

#include "trime/contours/contour.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/segment_grid.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <string>
#include <variant>
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

/// How rings of a contour are separated where they touch.
struct TouchOptions {
  bool outside = false; ///< the contour is subtracted: what lies around it is separated there, and not its area
  double gap = 0; ///< distance between the separated vertices, if the rings leave room for it; at least 1e-12 of the
                  ///< container
};

/// One named part. Immutable.
class Part {
public:
  /// @brief Makes an axis-parallel rectangle. @throws GeometryError if it is not wider and higher than 0 or leaves
  /// frame.reach()
  static Part rectangle(const std::string& name, const geometry::Box& box, const geometry::Frame& frame);
  /// @brief Makes a disc. @throws GeometryError if the radius is not positive or the disc leaves frame.reach()
  static Part circle(const std::string& name, geometry::Vec2 center, double radius, const geometry::Frame& frame);
  /// @brief Makes a triangle; the corners may have either orientation. @throws GeometryError if they are collinear or
  /// leave frame.reach()
  static Part triangle(const std::string& name, const std::array<geometry::Vec2, 3>& corners,
                       const geometry::Frame& frame);
  /// @brief Makes a part of the rings of a contour, moved by `normalization` and rounded to the lattice. Even-odd
  /// nesting decides which rings are holes.
  ///
  /// Takes O(M log M) for M vertices; the test for crossings uses all threads. Rings that touch at a vertex are
  /// separated there by about 1e-12 of the container, or as `touches` say, and the area does not reach through the gap.
  /// A ring given twice is used once. Warnings report both.
  /// @throws GeometryError `source:line: ...` if rings cross or overlap along edges, enclose no area, or leave
  /// frame.reach()
  static Part contour(const std::string& name, const contours::Contour& contour,
                      const contours::Normalization& normalization, const geometry::Frame& frame,
                      const TouchOptions& touches = {});
  /// @brief Makes a part of a polygon that is on the lattice already. @param warnings for the user, one sentence each
  static Part polygon(const std::string& name, Polygon polygon, std::vector<std::string> warnings = {});

  const std::string& name() const { return name_; }
  /// Warnings for the user, one sentence each: those of the contour, and about vertices that the lattice made equal.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Return null if the part is not of this kind.
  const Circle* as_circle() const { return std::get_if<Circle>(&form_); }
  const Polygon* as_polygon() const { return std::get_if<Polygon>(&form_); }
  bool is_contour() const { return is_contour_; }

  /// @brief Returns the closed boundary with the interior on the left; a circle has four arcs that start at the right.
  /// Loops are in the order of the rings, with tags from 1 and `part` 0.
  std::vector<geometry::Loop> boundary() const;
  /// @brief Returns whether p lies inside. Exact for lattice points; a point on the boundary may get either answer.
  /// O(log M), thread-safe.
  bool inside(geometry::Vec2 p) const;
  /// Returns the distance from p to the boundary of the part. Thread-safe.
  double distance(geometry::Vec2 p) const;

private:
  Part(const std::string& name, std::variant<Polygon, Circle> form) : name_(name), form_(std::move(form)) {}

  std::string name_;
  std::variant<Polygon, Circle> form_;
  std::vector<std::string> warnings_;
  bool is_contour_ = false;
};

} // namespace trime::shape
