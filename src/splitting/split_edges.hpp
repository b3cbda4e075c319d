// SPDX-License-Identifier: BSD-3-Clause
// The edges of a finished mesh that lie on curves to be split, and the points at their ends. Every rank knows all of
// them, as it knows all chords of curves while the mesh is made.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace trime::splitting {

/// An edge on a curve that is split, in the direction of the curve.
struct SplitEdge {
  std::array<GlobalId, 2> ends;
  std::int32_t curve;
};

/// Where the edges of this rank begin and end in the list of all edges.
struct SplitEdges {
  std::vector<SplitEdge> all; ///< in the order of DistributedMesh::curve_edges
  std::size_t first = 0, last = 0;
  std::vector<GlobalId> points; ///< ends of the edges, each once, ascending

  bool has_point(GlobalId id) const;
};

/// Returns by local vertex whether it is one of the points, for the points of this rank and then for
/// DistributedMesh::foreign.
std::vector<char> split_vertices(const mesh::DistributedMesh& mesh, const SplitEdges& edges);

/// Lists the edges on curves that are split. Cost: O(edges log edges). Collective.
SplitEdges split_edges(const comm::Communicator& comm, const mesh::DistributedMesh& mesh,
                       const std::vector<geometry::CurveKind>& kinds);

} // namespace trime::splitting
