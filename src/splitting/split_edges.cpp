// SPDX-License-Identifier: BSD-3-Clause
#include "splitting/split_edges.hpp"

#include "comm/agree.hpp"

#include <algorithm>

namespace trime::splitting {

bool SplitEdges::has_point(GlobalId id) const {
  return std::binary_search(points.begin(), points.end(), id);
}

std::vector<char> split_vertices(const mesh::DistributedMesh& mesh, const SplitEdges& edges) {
  std::vector<char> is_split(mesh.points.size() + mesh.foreign.size(), 0);
  const GlobalId first = mesh.point_slab.first, end = first + std::ssize(mesh.points);
  for (const GlobalId id : edges.points)
    if (id >= first && id < end)
      is_split[static_cast<std::size_t>(id - first)] = 1;
    else if (const auto found = std::lower_bound(mesh.foreign.begin(), mesh.foreign.end(), id);
             found != mesh.foreign.end() && *found == id)
      is_split[mesh.points.size() + static_cast<std::size_t>(found - mesh.foreign.begin())] = 1;
  return is_split;
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
