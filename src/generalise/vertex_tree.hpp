// SPDX-License-Identifier: BSD-3-Clause
// Finds whether a triangle holds vertices of curves, while the vertices are removed one by one.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trime::generalise {

/// @brief The nodes of a boundary and some other points, in a hierarchy of boxes around runs of successive nodes.
///
/// If a vertex of simple closed polygons is removed, and the closed triangle with its neighbours holds no other vertex,
/// then the polygons stay simple, and each point outside of the triangle stays on its side. For an edge that crosses
/// the new one would have to end in the triangle, or to cross an old edge. Unlike geometry::BoxTree, a search skips
/// boxes next to a slanted triangle, and ends at the first vertex.
class VertexTree {
public:
  /// Nodes are the ends of all pieces and places on arcs, as CurveMap has them. O(n log n)
  /// @param points lattice points, no nodes
  VertexTree(const geometry::Boundary& boundary, const geometry::Lattice& lattice,
             std::span<const geometry::Vec2> points);

  /// Returns the numbers of the vertices where the pieces of a loop start.
  std::vector<LocalIndex> starts_of_loop(std::size_t loop) const;

  /// Returns whether the closed triangle holds no vertex that is left, except its corners. Exact. O(log n) for a small
  /// triangle.
  bool is_empty(std::array<LocalIndex, 3> corners) const;
  void remove(LocalIndex vertex) { is_left_[at(vertex)] = 0; }
  void restore(LocalIndex vertex) { is_left_[at(vertex)] = 1; }

private:
  /// Successive vertices.
  struct Run {
    LocalIndex begin, end;
  };
  void add(geometry::Vec2 p, bool starts_piece);
  void add_loop(const geometry::Loop& loop, const geometry::Lattice& lattice);
  void sort_runs();
  void build_levels();
  template <class Triangle>
  bool holds_any(std::size_t level, std::size_t node, const Triangle& triangle) const;

  std::vector<geometry::Vec2> points_;             // by vertex
  std::vector<char> is_left_;                      // by vertex
  std::vector<char> starts_piece_;                 // by vertex
  std::vector<LocalIndex> first_of_loop_;          // vertex; one more at the end
  std::vector<Run> runs_;                          // along a space-filling curve
  std::vector<std::vector<geometry::Box>> levels_; // boxes of runs, then boxes of `fan` boxes each; the last is one box
};

} // namespace trime::generalise
