// SPDX-License-Identifier: BSD-3-Clause
// Divides each triangle of a mesh into four, on all ranks. The new vertices lie in the middles of the edges and, on the
// boundary, on the curves of the shape.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/polygon/loop_summary.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace trime::refinement {

/// Where a refined mesh lies.
struct Surroundings {
  geometry::Frame frame;                      ///< the container of the mesh; all points lie on its lattice
  const geometry::Boundary* curves = nullptr; ///< the boundary of the shape, the same on every rank; null: the boundary
                                              ///< edges are taken for the shape
  /// Limits that the run has promised, and that the refined mesh must keep, too.
  std::optional<double> worst_alpha{};
  bool limits_edges = false; ///< whether there is a check of the longest edge
};

/// Numbers of the new vertices on the boundary.
struct BoundaryMiddles {
  std::int64_t on_curve = 0;   ///< at half the length of the curve between the ends of the edge
  std::int64_t near_curve = 0; ///< as far from there as the ends of the edge are from the curve on average
  std::int64_t straight = 0;   ///< in the middle of the edge, because no curve between its ends is known
  std::int64_t refused = 0;    ///< in the middle of the edge, because the triangles would be worse on the curve
};

/// The triangles of a region.
struct RegionSum {
  std::int64_t triangles = 0;
  double area = 0;
};

/// The refined mesh.
struct Refined {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
  std::vector<polygon::LoopSummary> loops; ///< the loops of its boundary, ordered by tag; `parts` are left empty
  BoundaryMiddles middles;
  mesh::Checks checks;            ///< checks of the arrays: triangles, edges, points, loops, interfaces and area
  std::vector<RegionSum> regions; ///< sums of region 1, 2, ... up to the last one with a triangle
};

/// @brief Divides each triangle into four, and each boundary edge into two. The vertices of the mesh stay, bit for bit.
/// The vertex on an inner edge lies in its middle, rounded to the lattice. The vertex on a boundary edge lies on the
/// curve of the shape, at half its length between the ends of the edge, if that is possible. It lies in the middle of
/// the edge if a triangle would become bad there, or an edge would not be Delaunay. Target edge lengths are halved.
/// Regions, tags and parts are those of the divided triangles and edges; edges on curves and between regions are
/// divided in their middles, too, and keep their direction.
///
/// The new points are numbered in the order of the old ones; each old point is followed by the new points on the edges
/// from it to points with higher numbers, in the order of these. The result does not depend on the number of ranks.
/// A triangle with an angle above 90 degrees is divided from that corner.
/// @param mesh of a Mesher or of io::read_mesh, distributed over the ranks of `comm`
/// @throws ConfigError on all ranks if a rank would hold more points or triangles than a LocalIndex can count
/// @note Collective. Cost: O(n log n) for n points on this rank, and O(boundary edges of all ranks). Memory: about six
/// times that of the mesh.
Refined refine(const comm::Communicator& comm, const mesh::DistributedMesh& mesh, const Surroundings& surroundings);

} // namespace trime::refinement
