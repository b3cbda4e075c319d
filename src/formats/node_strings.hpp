// SPDX-License-Identifier: BSD-3-Clause
// Divides the boundary into node strings, as ocean models call them: sequences of points, one for each run of edges
// with one label.
#pragma once

#include "formats/exchange_mesh.hpp"

namespace trime::formats {

struct NodeString {
  std::int64_t label = 0;
  bool is_closed = false;       ///< true for a whole loop, whose first point is not repeated
  bool is_island = false;       ///< true if its loop surrounds a hole
  std::vector<GlobalId> points; ///< points in order, with the mesh on their left
};

/// Returns the node strings on rank 0, ordered by the lowest point of their loops, and an empty list on other ranks.
/// O(edges log edges) on rank 0. Collective.
std::vector<NodeString> node_strings(const ExchangeMesh& mesh);

} // namespace trime::formats
