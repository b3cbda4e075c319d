// SPDX-License-Identifier: BSD-3-Clause
// The four triangles into which one triangle is divided.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>

namespace trime::refinement {

/// @brief A triangle with a point on each of its edges, divided into four triangles. Vertex j, for j = 0, 1, 2, is a
/// corner of the triangle, and vertex 3 + j the point on the edge from corner j to corner (j + 1) % 3.
///
/// Usually the points on the edges form the inner triangle, and each corner belongs to one of the others. If the angle
/// at a corner is larger than 90 degrees, the edge across this corner would not be Delaunay. Then it is replaced by the
/// edge from the corner to the point opposite to it.
class Children {
public:
  using Code = int; ///< number of a vertex, from 0 to 5
  using Triangle = std::array<Code, 3>;

  /// @param corners counter-clockwise, at images next to each other
  Children(const std::array<geometry::Vec2, 3>& corners, const std::array<geometry::Vec2, 3>& middles,
           const geometry::Lattice& lattice);

  geometry::Vec2 at(Code code) const { return places_[static_cast<std::size_t>(code)]; }
  /// Returns the four triangles, counter-clockwise.
  std::array<Triangle, 4> triangles() const;
  /// Returns the three edges inside.
  std::array<std::array<Code, 2>, 3> inner_edges() const;
  /// Returns the vertex across half of an edge: half 0 is from corner `edge` to its point, half 1 from there on.
  Code across(int edge, int half) const;
  /// Returns whether all four triangles are counter-clockwise, and their edges inside are locally Delaunay.
  bool is_sound(const geometry::Lattice& lattice) const;
  /// Returns the largest alpha of the four triangles.
  double alpha() const;

private:
  static Code middle(int j) { return 3 + j % 3; }
  bool is_positive(const Triangle& triangle) const;
  bool wants_turn(int corner, const geometry::Lattice& lattice) const;

  std::array<geometry::Vec2, 6> places_;
  int turned_ = -1; // the corner across which an edge is replaced; -1: none
};

} // namespace trime::refinement
