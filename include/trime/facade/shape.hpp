// SPDX-License-Identifier: BSD-3-Clause
// Shapes in a program: named parts, joined by + (union), - (difference) and & (intersection).
#pragma once

#include "trime/geometry/vec2.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace trime {

using geometry::Box;
using geometry::Vec2;

/// @brief A part of a shape, or several parts joined by operators. Copies are cheap, and nothing is computed before
/// make_mesh. A part gives its name to its boundary in the mesh; names consist of letters, digits, `_` and `-`. Two
/// parts with the same name must be copies of one part. All ranks must make the same shape.
class Shape {
public:
  /// Returns the union: all places inside of `a` or `b`.
  friend Shape operator+(const Shape& a, const Shape& b);
  /// Returns the difference: all places inside of `a` that are not inside of `b`.
  friend Shape operator-(const Shape& a, const Shape& b);
  /// Returns the intersection: all places inside of both `a` and `b`.
  friend Shape operator&(const Shape& a, const Shape& b);

  /// Returns this shape as the expression of a config, such as "difference(plate, hole)".
  std::string text() const;

  struct Node; ///< private to the library
  explicit Shape(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  const Node& node() const { return *node_; }

private:
  std::shared_ptr<const Node> node_; ///< shared by all shapes that contain this part; immutable
};

/// @name The parts of shapes. Lengths and places are in the unit of the user's coordinates. If a part is wrong (a
/// radius of 0, rings that cross), make_mesh throws a GeometryError on all ranks.
/// @{
/// The axis-parallel rectangle with these opposite corners, lower left and upper right.
Shape rectangle(const std::string& name, Vec2 lower, Vec2 upper);
Shape circle(const std::string& name, Vec2 center, double radius);
/// @brief Closed polygons in either orientation; the last vertex is joined to the first. A ring inside of another ring
/// is a hole, a ring inside of the hole is an island, and so on. See shape::Part::contour.
Shape rings(const std::string& name, const std::vector<std::vector<Vec2>>& rings);
/// @brief The rings of a file: `.xy`, `.poly`, `.shp`, `.geojson`, or `.msh` of JIGSAW. Rank 0 reads the file in
/// make_mesh; if it cannot be read, all ranks throw a FileError.
Shape contour(const std::string& name, const std::string& path);
/// @brief All places where `distance` is negative; a signed distance works best. The function must be finite in the
/// whole container and the same on every rank; threads call it concurrently. Features narrower than 1/512 of the
/// container may be missed. See shape::traced_part for the cost.
/// @param box a box around these places, in which the function is evaluated; the container follows from it
Shape function(const std::string& name, std::function<double(Vec2)> distance, const Box& box);
/// The container itself, as a part with the name `domain`. A periodic shape is this part, or this part minus others.
Shape domain();
/// @}

/// @brief A region of a shape, such as a material. Triangles know their region, and edges follow the interfaces between
/// regions, see MeshOptions::regions.
struct Region {
  std::string name;
  Shape shape;                  ///< the places of the region; what lies outside of the mesh is left out
  std::optional<double> size{}; ///< largest size in the region: a length if MeshOptions::absolute_sizes is set,
                                ///< otherwise relative to the size of the mesh, so that 0.5 halves a uniform size
};

/// @brief A curve inside a shape that edges of the mesh follow. Lines may cross, branch and end inside.
struct Curve {
  std::string name;
  std::vector<std::vector<Vec2>> lines; ///< the vertices of each line; a line that ends where it begins is a ring
  bool clip = false;                    ///< what lies outside of the shape is left out; otherwise it is a GeometryError
  /// The curve is a crack or a wall: its points are doubled, and both sides are boundary edges with the name of the
  /// curve. See configs/curves.md.
  bool split = false;
};

} // namespace trime
