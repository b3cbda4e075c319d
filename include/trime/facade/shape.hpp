// SPDX-License-Identifier: BSD-3-Clause
// Shapes as a program says them: named parts, joined by + (union), - (difference) and & (intersection).
#pragma once

#include "trime/geometry/vec2.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace trime {

using geometry::Box;
using geometry::Vec2;

/// @brief A part, or parts that are joined. A value: copies are cheap, and nothing is computed before make_mesh. The
/// names of the parts are those of the boundary in the mesh: letters, digits, `_` and `-`. Parts of one name must be
/// copies of one part. All ranks must make the same shape.
class Shape {
public:
  /// The inside of either.
  friend Shape operator+(const Shape& a, const Shape& b);
  /// The inside of `a` without that of `b`.
  friend Shape operator-(const Shape& a, const Shape& b);
  /// The inside of both.
  friend Shape operator&(const Shape& a, const Shape& b);

  /// The expression of the config key `region` for this shape, such as "difference(plate, hole)".
  std::string text() const;

  struct Node; ///< private to the library
  explicit Shape(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  const Node& node() const { return *node_; }

private:
  std::shared_ptr<const Node> node_; ///< shared by all shapes that hold this part; immutable
};

/// @name Parts. Lengths and places are in the unit of the user's coordinates. Mistakes (a radius of 0, rings that
/// cross) are a GeometryError of make_mesh, on all ranks.
/// @{
/// The axis-parallel rectangle with these two opposite corners, the lower left one first.
Shape rectangle(const std::string& name, Vec2 lower, Vec2 upper);
Shape circle(const std::string& name, Vec2 center, double radius);
/// @brief Closed polygons in either orientation; the last vertex is joined to the first. A ring inside of another one
/// is a hole, one inside of a hole an island, and so on. See shape::Part::contour.
Shape rings(const std::string& name, const std::vector<std::vector<Vec2>>& rings);
/// @brief The rings of a file: `.xy`, `.poly`, `.shp`, `.geojson`, `.msh` of JIGSAW. Rank 0 reads it in make_mesh; if
/// it cannot, that is a FileError on all ranks.
Shape contour(const std::string& name, const std::string& path);
/// @brief The places where `distance` is negative, best of all a signed distance. It must be finite in the whole
/// container and the same on every rank; threads call it concurrently. Features narrower than 1/512 of the container
/// may be missed. See shape::traced_part for the cost.
/// @param box around these places, in which they are searched; the container follows from it
Shape function(const std::string& name, std::function<double(Vec2)> distance, const Box& box);
/// The container itself, under the name `domain`: what a periodic mesh begins with.
Shape domain();
/// @}

} // namespace trime
