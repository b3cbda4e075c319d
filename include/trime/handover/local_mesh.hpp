// SPDX-License-Identifier: BSD-3-Clause
// The mesh in memory for a solver on the same ranks: plain arrays with everything that a rank needs for its rows of a
// matrix, and the exchange of values between owners and ghosts. No file is written.
#pragma once

#include "trime/comm/communicator.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::handover {

/// Which triangles of other ranks a local mesh holds in addition to its own.
enum class Overlap {
  none,     ///< no triangles: sums at ghosts must be sent to their owners, see add_to_owners
  triangles ///< all triangles that touch an owned point, so that an owned point has all of its triangles
};

/// @brief Another rank that shares points with this one. Both ranks list the shared points in the same order.
struct Neighbour {
  int rank = 0;
  std::vector<LocalIndex> send; ///< owned points of this rank that are ghosts there, ascending
  LocalIndex first_ghost = 0;   ///< its points are the local points from first_ghost ...
  LocalIndex ghosts = 0;        ///< ... to first_ghost + ghosts - 1
};

/// @brief One rank's part of a mesh. Each point, triangle and boundary edge of the mesh is owned by exactly one rank;
/// the parts may be empty. Local points are the owned points from 0, then the ghosts; both have ascending global ids.
/// So the ghosts of a neighbour are consecutive. Coordinates are those of the container. In a periodic container a
/// triangle across the border has vertices on both sides; geometry::Periods::nearest_image brings them together.
struct LocalMesh {
  GlobalId first_point = 0;       ///< global id of local point 0
  GlobalId total_points = 0;      ///< points of all ranks
  GlobalId total_triangles = 0;   ///< triangles of all ranks
  LocalIndex owned_points = 0;    ///< local points before the first ghost
  LocalIndex owned_triangles = 0; ///< triangles before the first one of another rank
  LocalIndex owned_facets = 0;    ///< facets before the first one of another rank

  // Per local point.
  std::vector<geometry::Vec2> points; ///< [owned + ghosts], length unit of the container
  std::vector<std::int32_t> boundary; ///< [owned + ghosts], 0 inside, else tag of the boundary loop

  // Per ghost.
  std::vector<GlobalId> ghost_ids; ///< ascending
  std::vector<int> ghost_owners;   ///< ranks, so ascending too

  // Per local triangle: first the triangles of this rank, then those of other ranks; both have ascending global ids.
  std::vector<std::array<LocalIndex, 3>> triangles; ///< local points, counter-clockwise, lowest global id first
  std::vector<GlobalId> triangle_ids;
  std::vector<std::int32_t> regions; ///< region of each triangle, from 1; empty: 1 everywhere

  // Per facet of a local triangle. A facet is an edge on the boundary with the interior on the left of first -> second.
  std::vector<std::array<LocalIndex, 2>> facets; ///< local points
  std::vector<LocalIndex> facet_triangles; ///< the local triangle that the facet belongs to; the same rank owns both
  std::vector<std::int32_t> facet_tags;    ///< tag of the loop
  std::vector<std::int32_t> facet_parts; ///< part of the shape that the facet follows: index into Boundary::part_names

  std::vector<Neighbour> neighbours; ///< ordered by rank

  /// Returns the global id of a local point.
  GlobalId global_id(LocalIndex point) const {
    return point < owned_points ? first_point + point : ghost_ids[at(point - owned_points)];
  }
};

/// @brief Returns the part of a mesh that this rank owns, with the points and triangles that it needs from other ranks.
/// A rank owns the points of its slab, the triangles whose lowest vertex it owns, and the facets of these triangles.
/// The mesh may come from a Mesher or from io::read_mesh; it is not needed afterwards.
/// @param mesh whole, over all ranks of `comm`
/// @throws InternalError on all ranks if a facet belongs to no triangle
/// @note Collective. Makes seven sparse exchanges and a list of one number per rank; takes O(n log n) time in the size
/// of the part. Memory: 20 bytes per point and 24 per triangle, and 40 more per triangle while it is made; up to twice
/// that because lists grow.
LocalMesh make_local_mesh(const comm::Communicator& comm, const mesh::DistributedMesh& mesh,
                          Overlap overlap = Overlap::triangles);

/// @brief Gives each ghost the values of its owner, bit for bit.
/// @param values [local points x components], the components of a point side by side; only those of ghosts change
/// @note Collective. Each rank sends one message to each neighbour and receives one from each; it waits for no other
/// rank. O(shared points).
void update_ghosts(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

/// @brief Adds the values of all ghosts to the values of their owners, one neighbour after the other in the order of
/// their ranks. The ghosts keep their values. The last bits of the sum depend on the number of ranks.
/// @param values [local points x components], as above; only those of owned points change
/// @note Collective, as update_ghosts.
void add_to_owners(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

} // namespace trime::handover
