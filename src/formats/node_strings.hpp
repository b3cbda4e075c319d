// SPDX-License-Identifier: BSD-3-Clause
// Divides the boundary into node strings (a term of ocean models): sequences of points, one for each run of edges with
// the same label.
#pragma once

#include "formats/exchange_mesh.hpp"

namespace trime::formats {

struct NodeString {
  std::int64_t label = 0;
  bool is_closed = false;       ///< true for a whole loop; its first point is not repeated at the end
  bool is_island = false;       ///< true if the loop surrounds a hole
  std::vector<GlobalId> points; ///< points in order; the mesh lies on their left
};

/// Returns the node strings on rank 0, ordered by the lowest point of their loops; returns an empty list on other
/// ranks. Cost: O(edges log edges) on rank 0. Collective.
std::vector<NodeString> node_strings(const ExchangeMesh& mesh);

/// A loop of the boundary.
struct BoundaryRing {
  bool is_island = false;           ///< true if it surrounds a hole
  std::vector<GlobalId> points;     ///< in order, the mesh on their left; begins with the point of the lowest x + y
  std::vector<std::int64_t> labels; ///< label of the edge from each point to the next one
};

/// Returns the rings on rank 0, those around holes behind the others, otherwise ordered by their lowest points; returns
/// an empty list on other ranks. Cost: O(edges log edges) on rank 0. Collective.
std::vector<BoundaryRing> boundary_rings(const ExchangeMesh& mesh);

/// Pairs of points on both sides of a path of a curve that is split.
struct PairString {
  std::int32_t curve = 0;
  std::vector<std::array<GlobalId, 2>> pairs; ///< left and right; a ring has its first pair at the end, too
};

/// Returns the paths on rank 0, in the order of the mesh file; returns an empty list on other ranks. Collective.
std::vector<PairString> pair_strings(const ExchangeMesh& mesh);

} // namespace trime::formats
