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

} // namespace trime::formats
