// SPDX-License-Identifier: BSD-3-Clause
// The edges of one rank's part of a mesh: each edge once, with its ends and its triangles.
#pragma once

#include "trime/core/types.hpp"
#include "trime/handover/local_mesh.hpp"

#include <array>
#include <vector>

namespace trime::refinement {

/// @brief The edges of all local triangles, in the order of the local index of their lower end, then of the global id
/// of their higher end. The lower end is the one with the lower global id. A rank owns the edges whose lower end it
/// owns; they come first, and their order is the same on any number of ranks.
/// Memory: about 20 bytes per edge and 12 per triangle. Immutable.
class EdgeTable {
public:
  /// Cost: O(triangles), by all threads. @pre the mesh has Overlap::triangles, and outlives this object
  explicit EdgeTable(const handover::LocalMesh& mesh);

  LocalIndex size() const { return first_.back(); }
  LocalIndex owned() const { return first_[at(mesh_.owned_points)]; }
  LocalIndex lower(LocalIndex edge) const { return lower_[at(edge)]; }
  LocalIndex upper(LocalIndex edge) const { return upper_[at(edge)]; }
  /// Returns the number of owned edges whose lower end is a point before this one. @pre the rank owns the point
  LocalIndex before(LocalIndex point) const { return first_[at(point)]; }
  /// Returns the edge between two local points, or -1.
  LocalIndex find(LocalIndex a, LocalIndex b) const;

  /// Returns the edges of a triangle: edge j joins its vertices j and (j + 1) % 3.
  const std::array<LocalIndex, 3>& of_triangle(LocalIndex triangle) const { return edges_[at(triangle)]; }
  /// Returns the triangles of an edge, and -1 where it has fewer than two. If there are more, the second one is -2.
  const std::array<LocalIndex, 2>& triangles(LocalIndex edge) const { return triangles_[at(edge)]; }
  /// Returns which edge of the triangle this one is, from 0 to 2. @pre it is one
  std::size_t place_in(LocalIndex triangle, LocalIndex edge) const {
    const std::array<LocalIndex, 3>& edges = of_triangle(triangle);
    return edges[0] == edge ? 0 : edges[1] == edge ? 1 : 2;
  }

private:
  void list_edges();
  void join_triangles();
  bool is_lower(LocalIndex a, LocalIndex b) const { return mesh_.global_id(a) < mesh_.global_id(b); }

  const handover::LocalMesh& mesh_;
  std::vector<LocalIndex> first_;         // by local point: its first edge; the last entry is the end
  std::vector<LocalIndex> lower_, upper_; // by edge
  std::vector<std::array<LocalIndex, 3>> edges_;
  std::vector<std::array<LocalIndex, 2>> triangles_;
};

} // namespace trime::refinement
