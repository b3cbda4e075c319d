// SPDX-License-Identifier: BSD-3-Clause
// A triangulation of a shape with its lines, in which edges can be contracted.
#pragma once

#include "generalise/region_map.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/region_loss.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace trime::generalise {

/// @brief Triangles with regions. The lines are the edges between different regions and the edges on curves.
///
/// A contraction moves a vertex to one of its neighbours. It must turn no triangle over, and the two vertices must have
/// no common neighbours but those of the two triangles that go; so the plane stays covered once.
class LineMesh {
public:
  /// A line along an edge.
  struct Line {
    LocalIndex from, to; ///< along its curve, or with the lower region on the left
    int left, right;
    int curve; ///< -1: an interface only
    bool operator==(const Line&) const = default;
  };

  LineMesh(const RegionMap& map, std::span<const std::array<int, 2>> pairs);

  /// Moves the vertex `from` to `to`, its neighbour, if it may. Returns whether it did.
  bool contract(LocalIndex from, LocalIndex to);
  /// @brief Lets the longest edge of a triangle lead through the third corner, if lines lead along all three edges and
  /// that corner is nearer to the longest edge than `reach`. The triangle then belongs to the region beyond that edge.
  /// Returns whether it did.
  bool flatten(LocalIndex triangle, double reach);
  /// Returns whether a contraction has changed a line at the vertex.
  bool is_changed(LocalIndex v) const { return is_changed_[at(v)] != 0; }
  bool is_edge(LocalIndex a, LocalIndex b) const;
  bool is_line(LocalIndex a, LocalIndex b) const;
  /// Returns the neighbours of a vertex in ascending order.
  std::vector<LocalIndex> neighbours(LocalIndex v) const;
  /// Returns the number of edges of lines at a vertex, with those of the boundary.
  int degree(LocalIndex v) const;
  bool has_curve(LocalIndex v) const;
  /// Returns whether lines at the two vertices have about the same direction, so that they follow each other.
  bool follow(LocalIndex a, LocalIndex b) const;
  /// Returns all lines inside the shape, in ascending order of their ends.
  std::vector<Line> lines() const;
  /// Returns the region on the left of an edge from a to b.
  int left_of(LocalIndex a, LocalIndex b) const;
  const std::vector<geometry::RegionLoss>& losses() const { return losses_; }

private:
  using Ends = std::pair<LocalIndex, LocalIndex>;
  struct Triangle {
    std::array<LocalIndex, 3> corners;
    int region;
    bool has(LocalIndex v) const { return corners[0] == v || corners[1] == v || corners[2] == v; }
  };

  LocalIndex triangle_beside(LocalIndex a, LocalIndex b) const;
  int curve_on(LocalIndex a, LocalIndex b) const;
  bool keeps_orientation(LocalIndex from, LocalIndex to) const;
  bool may_merge(LocalIndex from, LocalIndex to, LocalIndex apex) const;
  bool keeps_regions(LocalIndex from, LocalIndex to) const;
  double area(const Triangle& t) const;
  void take_through(LocalIndex a, LocalIndex b, LocalIndex apex);
  void note_losses(const std::map<int, double>& gains, LocalIndex from);
  void move_curves(LocalIndex from, LocalIndex to);

  const Triangulation& mesh_;
  std::span<const std::array<int, 2>> pairs_;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<LocalIndex>> triangles_of_; // by vertex
  std::vector<char> is_changed_;                      // by vertex
  std::map<Ends, int> curves_;                        // along each curve: its number
  std::map<int, LocalIndex> edges_of_curve_, triangles_of_region_;
  std::vector<geometry::RegionLoss> losses_;
};

} // namespace trime::generalise
