// SPDX-License-Identifier: BSD-3-Clause
// Splits curves of a finished mesh: cracks, walls and weirs. The points on them become pairs, and both sides of their
// edges become boundary edges. This is the last step before the mesh is handed over: the triangulation, its stars and
// the certificate are those of the mesh in one piece, so that no other module has to know that points may be doubled.
#pragma once

#include "splitting/split_loops.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/polygon/loop_summary.hpp"
#include "trime/sizing/size_field.hpp"

#include <vector>

namespace trime::splitting {

/// Holds what the mesh was made of, as far as the split needs it.
struct SplitInput {
  const std::vector<geometry::CurveKind>& kinds;  ///< kinds of the curves, by their numbers
  std::int32_t parts;                             ///< number of parts of the shape
  const sizing::SizeField& asked;                 ///< the size that is stored for facets
  const std::vector<polygon::LoopSummary>& loops; ///< loops of the boundary before the split
};

/// Returns whether any curve is to be split.
bool any_split(const std::vector<geometry::CurveKind>& kinds);

/// @brief Splits the mesh. A point where k split edges meet gets k copies, and one more if it lies on the boundary; a
/// single end inside stays one point. All copies have the values of the point. They follow it in the order of points,
/// so the ids of points change, but the order of points and triangles does not, and all stay on their ranks. The result
/// does not depend on the number of ranks. Edges of split curves are no longer among the edges of curves and
/// interfaces. Cost: O(points + triangles), and O(points on split curves + facets) on every rank. Collective.
/// @throws GeometryError on all ranks together if the size at an edge is not positive and finite
SplitLoops split_curves(const comm::Communicator& comm, const SplitInput& input, mesh::DistributedMesh& mesh);

/// Returns the check that points, edges and triangles have the Euler characteristic of their boundary loops.
/// Collective.
mesh::Check split_check(const mesh::DistributedMesh& mesh, const std::vector<polygon::LoopSummary>& loops);

} // namespace trime::splitting
