// SPDX-License-Identifier: BSD-3-Clause
// A mesh handed over to a solver on the same ranks: what a rank needs for its rows of a matrix, in plain arrays. No
// file lies between.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace trime::handover {

/// Which triangles of other ranks a local mesh holds beside those that its rank owns.
enum class Overlap {
  none,     ///< none: what is summed up at ghosts must travel to their owners, see add_to_owners
  triangles ///< all that touch an owned point: an owned point has all of its triangles
};

/// @brief Another rank that holds points in common with this one. Both list them in the same order.
struct Neighbour {
  int rank = 0;
  std::vector<LocalIndex> send; ///< owned points that are ghosts there, ascending
  LocalIndex first_ghost = 0;   ///< its points here are the local points from this one on ...
  LocalIndex ghosts = 0;        ///< ... and so many
};

/// @brief One rank's part of a mesh. Each point, triangle and boundary edge of the mesh is owned by exactly one rank;
/// the parts may be empty. Local points are the owned ones from 0, then the ghosts, by ascending global id in both.
/// So the ghosts of a neighbour follow each other. Coordinates are those of the container. In a periodic one a
/// triangle across the border has vertices on both sides: geometry::Periods::nearest_image brings them together.
struct LocalMesh {
  GlobalId first_point = 0;       ///< global id of local point 0
  GlobalId total_points = 0;      ///< of all ranks
  GlobalId total_triangles = 0;   ///< of all ranks
  LocalIndex owned_points = 0;    ///< local points before the first ghost
  LocalIndex owned_triangles = 0; ///< triangles before the first one of another rank
  LocalIndex owned_facets = 0;    ///< facets before the first one of another rank

  // Per local point.
  std::vector<geometry::Vec2> points; ///< [owned + ghosts], length unit of the container
  std::vector<std::int32_t> boundary; ///< [owned + ghosts], 0 inside, else tag of the boundary loop

  // Per ghost.
  std::vector<GlobalId> ghost_ids; ///< ascending
  std::vector<int> ghost_owners;   ///< ranks, so ascending too

  // Per local triangle: those that this rank owns, then those of other ranks, by ascending global id in both.
  std::vector<std::array<LocalIndex, 3>> triangles; ///< local points, counter-clockwise, lowest global id first
  std::vector<GlobalId> triangle_ids;
  std::vector<std::int32_t> regions; ///< from 1; empty: 1 everywhere

  // Per facet of a local triangle: an edge of the boundary, the interior on the left of first -> second.
  std::vector<std::array<LocalIndex, 2>> facets; ///< local points
  std::vector<LocalIndex> facet_triangles;       ///< the local triangle that it belongs to; the same rank owns both
  std::vector<std::int32_t> facet_tags;          ///< of its loop
  std::vector<std::int32_t> facet_parts;         ///< part of the shape that it follows: index into Boundary::part_names

  std::vector<Neighbour> neighbours; ///< by ascending rank

  /// Global id of a local point.
  GlobalId global_id(LocalIndex point) const {
    return point < owned_points ? first_point + point : ghost_ids[at(point - owned_points)];
  }
};

/// @brief The part of a mesh that this rank owns, and what it needs of other ranks. Owned are the points of its slab,
/// the triangles whose lowest vertex is owned, and the facets of these triangles. The mesh may come from a Mesher or
/// from io::read_mesh; it is not needed afterwards.
/// @param mesh whole, over all ranks of `comm`
/// @throws InternalError on all ranks if a facet belongs to no triangle
/// @note Collective. Seven sparse exchanges and a list of one number per rank; O(n log n) in what the rank holds.
/// Memory: 20 bytes a point and 24 a triangle, 40 a triangle more while it is made; up to twice that as lists grow.
LocalMesh make_local_mesh(const comm::Communicator& comm, const mesh::DistributedMesh& mesh,
                          Overlap overlap = Overlap::triangles);

} // namespace trime::handover
