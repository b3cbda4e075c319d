// SPDX-License-Identifier: BSD-3-Clause
// The boundary as strings of points, one for each run of edges with one label: what ocean models call node strings.
#pragma once

#include "formats/exchange_mesh.hpp"

namespace trime::formats {

struct NodeString {
  std::int64_t label = 0;
  bool is_closed = false;       ///< a whole loop: the first point is not repeated
  bool is_island = false;       ///< of a loop around a hole
  std::vector<GlobalId> points; ///< the mesh on the left
};

/// On rank 0, by the lowest point of their loops; empty elsewhere. O(edges log edges) there. Collective.
std::vector<NodeString> node_strings(const ExchangeMesh& mesh);

} // namespace trime::formats
