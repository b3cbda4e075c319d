// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/split_edges.hpp"

#include "comm/agree.hpp"

#include <algorithm>

namespace trime::splitting {

bool SplitEdges::has_point(GlobalId id) const {
  return std::binary_search(points.begin(), points.end(), id);
}

SplitEdges split_edges(const comm::Communicator& comm, const mesh::DistributedMesh& mesh,
                       const std::vector<geometry::CurveKind>& kinds) {
  std::vector<SplitEdge> here;
  for (std::size_t k = 0; k < mesh.curve_edges.size(); ++k)
    if (const std::int32_t curve = mesh.curve_numbers[k]; kinds.at(static_cast<std::size_t>(curve)).split)
      here.push_back({mesh.curve_edges[k], curve});
  SplitEdges edges;
  edges.first = static_cast<std::size_t>(comm.exclusive_scan(std::ssize(here)));
  edges.last = edges.first + here.size();
  edges.all = comm::gather_everywhere(comm, std::move(here));
  for (const SplitEdge& edge : edges.all)
    edges.points.insert(edges.points.end(), edge.ends.begin(), edge.ends.end());
  std::sort(edges.points.begin(), edges.points.end());
  edges.points.erase(std::unique(edges.points.begin(), edges.points.end()), edges.points.end());
  return edges;
}

} // namespace trime::splitting
