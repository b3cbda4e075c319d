// SPDX-License-Identifier: BSD-3-Clause
// Measures the quality of a mesh and checks it, from its arrays alone.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/polygon/loop_summary.hpp"
#include "trime/refinement/refine.hpp"

#include <cstdint>
#include <vector>

namespace trime::refinement {

/// Numbers that the mesh must have.
struct ExpectedCounts {
  std::int64_t points = 0, triangles = 0, facets = 0;
  std::int64_t euler_characteristic = 0;
  std::int64_t corners = 0;      ///< points on the boundary that are fixed
  std::int64_t fixed_inside = 0; ///< fixed points inside
  std::int64_t interfaces = 0;   ///< edges between triangles of different regions
};

/// Quality, checks and loops of a mesh, computed from its arrays.
struct Inspection {
  mesh::QualitySummary quality;
  mesh::Checks checks;
  std::vector<polygon::LoopSummary> loops;
  std::vector<RegionSum> regions; ///< as in Refined
};

/// @brief Joins the triangles of a mesh again, measures them, and counts what the mesh consists of. Sets `alpha` and
/// `beta` of the mesh. The size in the middle of an edge is the mean of the sizes of its ends. Exact where the checks
/// of a run are exact. Collective. Cost: O(n log n) for n points on this rank, and O(boundary edges of all ranks).
/// @pre each triangle is on the rank that owns its lowest vertex
Inspection inspect(const comm::Communicator& comm, const geometry::Frame& frame, const ExpectedCounts& expected,
                   mesh::DistributedMesh& mesh);

} // namespace trime::refinement
