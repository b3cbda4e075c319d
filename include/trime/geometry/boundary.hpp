// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a shape: closed loops of smooth pieces with the interior on the left. The mesher takes a Domain: a
// boundary together with the container in which it was made, the names of its parts, and the points that the mesh
// keeps.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::geometry {

/// A straight segment or a circular arc from `start` to `end`; both ends lie on the lattice.
struct Piece {
  Vec2 start, end;
  Vec2 center; ///< only for circular pieces, as the next three members
  double radius = 0;
  double start_angle = 0; ///< radians
  double sweep = 0;       ///< signed angle from start to end, radians, counter-clockwise positive, |sweep| <= 2 pi
  int part = 0;           ///< index into Boundary::part_names of the part that the piece comes from
  bool circular = false;
  bool corner = false; ///< the mesh keeps the start as a corner, however little the curve turns there

  /// Arc length.
  double length() const;
  /// Returns the point at arc length s from the start, 0 <= s <= length(). The ends are returned bit for bit.
  Vec2 point(double s) const;
  /// Returns the unit tangent at arc length s.
  Vec2 tangent(double s) const;
  /// Returns the distance from p to the piece.
  double distance(Vec2 p) const;
  /// Returns a box that contains the piece; it may be too large for arcs.
  Box covering_box() const;
};

/// @brief A closed curve: piece i ends where piece i+1 starts. The last piece ends where the first starts, moved by
/// `winding`.
///
/// In a periodic container the pieces follow each other as if there were no border ("unrolled"). All pieces lie in the
/// container or in the images next to it. The first start is canonical.
struct Loop {
  std::vector<Piece> pieces;
  bool outer = true; ///< counter-clockwise around a component, or clockwise around a hole; true if it winds
  int tag = 1;       ///< value that the mesh file has for its edges, from 1
  Vec2 winding{};    ///< multiple of the periods; zero unless the loop goes around the container

  double length() const;
  /// Returns the turn at the start of piece i, in degrees from 0 to 180.
  double turn_degrees(std::size_t i) const;
  /// Returns whether the loop goes around the periodic container.
  bool winds() const { return winding != Vec2{}; }
};

/// The boundary of a shape. Invariant: loops and their images do not cross or touch, and area > 0.
struct Boundary {
  std::vector<Loop> loops;
  std::vector<std::string> part_names;
  double area = 0; ///< enclosed area, arcs included
  Periods periods; ///< periods of the container
  /// One component reaches around the torus both ways. Then all its loops are holes, or it has no loops.
  bool covers_torus = false;

  int components() const; ///< outer loops, bands (two winding loops each), and one if covers_torus
  int holes() const;      ///< number of hole loops
  /// @brief Returns the Euler characteristic of the shape on the plane, cylinder or torus: outer loops minus holes. By
  /// the theorem of Gauss and Bonnet it is the sum of the turns of the loops; loops around the container do not turn.
  int euler_characteristic() const;
  double length() const;
  /// Returns the box around the unrolled loops; empty without loops.
  Box bounding_box() const;
};

/// A point that is to be a vertex of the mesh.
struct FixedPoint {
  Vec2 position;
  std::string label; ///< for messages: where the point comes from, such as `points.xy:7`
};

/// @brief The domain of a mesh. A shape makes it (shape::RegionShape::domain, shape::domain_of), the mesher takes it.
///
/// The names of the parts are Boundary::part_names. Pieces of a part whose segments have a marker other than 0 are a
/// part of their own, behind all others: "NAME.MARKER", or "NAME.TEXT" if the file has a name for the marker. Where two
/// such parts meet on one curve there is a corner.
/// @note Curves inside and named regions of triangles will be members of this class, too, once there is support for
/// them.
class Domain {
public:
  /// @brief Checks that the boundary belongs to the frame. O(pieces)
  /// @param part_markers one for each of boundary.part_names; 0, or none at all: no marker
  /// @throws GeometryError if a vertex of the boundary lies off the lattice or outside of the container, if a loop is
  /// not closed, or if periods, names or markers do not agree
  Domain(const Frame& frame, Boundary boundary, std::vector<std::int32_t> part_markers = {});

  const Frame& frame() const { return frame_; }
  const Boundary& boundary() const { return boundary_; }
  /// The marker of each of Boundary::part_names; 0 if it has none.
  const std::vector<std::int32_t>& part_markers() const { return part_markers_; }

  /// @brief Points that the mesh keeps bit for bit (on the lattice) and never moves. On the boundary (to within 1e-10
  /// of the container) they become corners; for those outside of the shape the mesher throws a GeometryError.
  const std::vector<FixedPoint>& fixed_points() const { return fixed_points_; }
  void set_fixed_points(std::vector<FixedPoint> points) { fixed_points_ = std::move(points); }

private:
  Frame frame_;
  Boundary boundary_;
  std::vector<std::int32_t> part_markers_;
  std::vector<FixedPoint> fixed_points_;
};

} // namespace trime::geometry
