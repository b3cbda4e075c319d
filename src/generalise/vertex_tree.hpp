// SPDX-License-Identifier: BSD-3-Clause
// Finds whether a triangle contains vertices of curves, while vertices are removed one by one.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trime::generalise {

/// @brief The nodes of a boundary and some other points, in a tree of boxes around sequences of consecutive nodes.
///
/// Suppose that a vertex of simple closed polygons is removed, and that the closed triangle of it and its neighbours
/// contains no other vertex. Then the polygons stay simple, and each point outside of the triangle stays on its side.
/// The reason: an edge that crosses the new one would have to end in the triangle, or to cross an old edge. Unlike in
/// geometry::BoxTree, a search skips boxes next to a slanted triangle, and ends at the first vertex found.
class VertexTree {
public:
  /// Builds the tree. Nodes are the ends of all pieces and points of arcs, as in CurveMap. Cost: O(n log n).
  /// @param points points of the coordinate lattice that are not nodes
  VertexTree(const geometry::Boundary& boundary, const geometry::Lattice& lattice,
             std::span<const geometry::Vec2> points);

  /// Returns the numbers of the vertices at which the pieces of a loop start.
  std::vector<LocalIndex> starts_of_loop(std::size_t loop) const;

  /// Returns whether the closed triangle contains no remaining vertex except its corners. Exact. Cost: O(log n) for a
  /// small triangle.
  bool is_empty(std::array<LocalIndex, 3> corners) const;
  /// Returns whether the closed triangle contains no remaining vertex except at its corners. Exact.
  bool is_empty_at(std::array<geometry::Vec2, 3> corners) const;
  /// Returns whether no remaining vertex but `from` lies next to the segment, on the other side than `from`: in the
  /// triangle over the segment with this height, whose apex is opposite to `from`.
  /// @pre `from` remains
  bool has_room(const geometry::Segment& segment, LocalIndex from, double height);
  void remove(LocalIndex vertex) { is_left_[at(vertex)] = 0; }
  void restore(LocalIndex vertex) { is_left_[at(vertex)] = 1; }

private:
  /// A sequence of consecutive vertices.
  struct Run {
    LocalIndex begin, end;
  };
  void add(geometry::Vec2 p, bool starts_piece);
  void add_loop(const geometry::Loop& loop, const geometry::Lattice& lattice);
  void sort_runs();
  void build_levels();
  bool is_empty(std::array<LocalIndex, 3> corners, std::array<geometry::Vec2, 3> places) const;
  template <class Triangle>
  bool holds_any(std::size_t level, std::size_t node, const Triangle& triangle) const;

  geometry::Lattice lattice_;
  std::vector<geometry::Vec2> points_;    // by vertex
  std::vector<char> is_left_;             // by vertex
  std::vector<char> starts_piece_;        // by vertex
  std::vector<LocalIndex> first_of_loop_; // first vertex of each loop; the last entry is the end
  std::vector<Run> runs_;                 // along a space-filling curve
  std::vector<std::vector<geometry::Box>>
      levels_; // boxes of runs, then boxes of `fan` boxes each; the last level is one box
};

} // namespace trime::generalise
