// SPDX-License-Identifier: BSD-3-Clause
// The mesher takes a Domain: a boundary together with the container in which it was made, the names of its parts, and
// the points that the mesh keeps.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/frame.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace trime::geometry {

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
