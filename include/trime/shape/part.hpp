// SPDX-License-Identifier: BSD-3-Clause
// The named parts from which a shape is composed: polygons (rectangle, triangle, contour, traced function) and circles.
// All coordinates lie on the coordinate lattice of the container, so the inside tests are exact.
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

/// A circle whose centre and radius are multiples of the coordinate lattice's step.
struct Circle {
  geometry::Vec2 center;
  double radius;
};

/// Simple closed rings that do not meet each other. A point is inside if an odd number of rings enclose it.
struct Polygon {
  /// A ring consists of the segments first .. first + count - 1 of the grid; `reversed` if the interior lies on their
  /// right.
  struct Ring {
    LocalIndex first, count;
    bool reversed;
    bool open = false; ///< a line of a curve: the last segment does not end where the first one starts
  };
  geometry::SegmentGrid grid; ///< the segments ring by ring; each segment starts where the one before it ends
  std::vector<Ring> rings;
  std::vector<int> markers{};              ///< marker of each segment; 0 for no marker; empty if all are 0
  std::vector<std::string> marker_names{}; ///< names of the markers, as in Contour::marker_names
  std::vector<std::string> notes{};        ///< sentences for the log about what was dissolved
  std::vector<std::string> labels{};       ///< file and line of each segment of a curve, for messages
};

/// A line of a curve: its vertices, and whether it is a ring, which returns from the last vertex to the first one.
struct CurveLine {
  std::vector<geometry::Vec2> points;
  bool closed = false;
  std::vector<std::string> labels{}; ///< file and line of each vertex, for messages; empty: none
};

/// Returns the four points of a circle at the angles 0, pi/2, pi, 3 pi/2. They are exact.
std::array<geometry::Vec2, 4> quadrant_vertices(const Circle& circle);

/// @brief Returns the counter-clockwise arc of `circle` from a to b, less than a full turn.
geometry::Piece make_arc(const Circle& circle, geometry::Vec2 a, geometry::Vec2 b);

/// How rings of a contour are separated where they touch, and whether its polygons are united first.
struct TouchOptions {
  bool outside = false;  ///< the contour is subtracted: what lies around it is separated there, and not its area
  bool dissolve = false; ///< polygons of the contour that overlap or share borders are united
  double gap = 0; ///< distance between the separated vertices, if the rings leave room for it; at least 1e-12 of the
                  ///< container
  contours::Faults faults = contours::Faults::refuse; ///< what happens with faults of the rings
  /// Rings of a raster, or of united polygons, that meet in vertices stay as they are, since regions may touch.
  bool keep_touches = false;
  double widest_gap = 0; ///< with `dissolve`: gaps that polygons enclose between them are closed if they are narrower
};

/// One named part of a shape. Immutable.
class Part {
public:
  /// @brief Makes an axis-parallel rectangle.
  /// @throws GeometryError if its width or height is not positive, or it leaves frame.reach()
  static Part rectangle(const std::string& name, const geometry::Box& box, const geometry::Frame& frame);
  /// @brief Makes a disc. @throws GeometryError if the radius is not positive or the disc leaves frame.reach()
  static Part circle(const std::string& name, geometry::Vec2 center, double radius, const geometry::Frame& frame);
  /// @brief Makes a triangle; the corners may have either orientation. @throws GeometryError if they are collinear or
  /// leave frame.reach()
  static Part triangle(const std::string& name, const std::array<geometry::Vec2, 3>& corners,
                       const geometry::Frame& frame);
  /// @brief Makes a part from the rings of a contour, moved by `normalization` and rounded to the coordinate lattice. A
  /// ring inside an odd number of other rings is a hole.
  ///
  /// Takes O(M log M) time for M vertices; the test for crossings uses all threads. Where two rings touch at a vertex,
  /// they are separated by a gap of about 1e-12 of the container, or by the gap of `touches`; the area does not cross
  /// this gap. A ring that occurs twice is used once. A warning reports each of these changes, and each repair.
  /// @throws GeometryError `source:line: ...` if rings cross or overlap along edges, enclose no area, or leave
  /// frame.reach(); the message lists all faults, with those that the reader found
  static Part contour(const std::string& name, const contours::Contour& contour,
                      const contours::Normalization& normalization, const geometry::Frame& frame,
                      const TouchOptions& touches = {});
  /// @brief Makes a curve, which encloses nothing: lines that the edges of a mesh follow. Lines may cross and touch
  /// each other. Equal successive vertices are joined.
  /// @throws GeometryError if a line has no two different points, or leaves frame.reach()
  static Part curve(const std::string& name, std::vector<CurveLine> lines, const geometry::Frame& frame);
  /// @brief Makes a part from a polygon whose vertices are already on the coordinate lattice.
  /// @param warnings for the user, one sentence each
  static Part polygon(const std::string& name, Polygon polygon, std::vector<std::string> warnings = {});

  const std::string& name() const { return name_; }
  /// Warnings for the user, one sentence each: those of the contour, and warnings about vertices that became equal when
  /// rounded to the coordinate lattice.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Return null if the part is of the other kind.
  const Circle* as_circle() const { return std::get_if<Circle>(&form_); }
  const Polygon* as_polygon() const { return std::get_if<Polygon>(&form_); }
  bool is_contour() const { return is_contour_; }
  bool is_curve() const { return is_curve_; }

  /// @brief Returns the closed boundary with the interior on the left. A circle has four arcs; the first one starts at
  /// the rightmost point. Loops are in the order of the rings, with tags from 1 and `part` 0.
  std::vector<geometry::Loop> boundary() const;
  /// @brief Returns whether p lies inside. Exact for points of the coordinate lattice; for a point on the boundary the
  /// answer may be either. Cost: O(log M). Thread-safe.
  bool inside(geometry::Vec2 p) const;
  /// Returns the distance from p to the boundary of the part. Thread-safe.
  double distance(geometry::Vec2 p) const;

private:
  Part(const std::string& name, std::variant<Polygon, Circle> form) : name_(name), form_(std::move(form)) {}

  std::string name_;
  std::variant<Polygon, Circle> form_;
  std::vector<std::string> warnings_;
  bool is_contour_ = false, is_curve_ = false;
};

} // namespace trime::shape
