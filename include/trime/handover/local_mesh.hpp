// SPDX-License-Identifier: BSD-3-Clause
// Gives the mesh in memory to a solver on the same ranks: arrays with everything that a rank needs for its rows of a
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
  none, ///< no triangles of other ranks: the sums that a rank computes at its ghosts must be sent to the owners, see
        ///< add_to_owners
  triangles ///< all triangles that touch an owned point, so that all triangles around an owned point are known, and
            ///< both triangles of each edge that ends there
};

/// @brief Another rank that shares points with this one. Both ranks list the shared points in the same order.
struct Neighbour {
  int rank = 0;
  std::vector<LocalIndex> send; ///< owned points of this rank that are ghosts there, ascending
  LocalIndex first_ghost = 0;   ///< its points here are the local points from first_ghost ...
  LocalIndex ghosts = 0;        ///< ... to first_ghost + ghosts - 1
};

/// @brief One rank's part of a mesh. Each point, triangle and labelled edge of the mesh is owned by exactly one rank; a
/// rank may own none. Local points are numbered from 0: first the owned points, then the ghosts; both have ascending
/// global ids, so the ghosts of a neighbour are consecutive. Coordinates are those of the container. In a periodic
/// container a triangle across the border has vertices on both sides of the container; geometry::Periods::nearest_image
/// brings them together.
struct LocalMesh {
  GlobalId first_point = 0;       ///< global id of local point 0
  GlobalId total_points = 0;      ///< points of all ranks
  GlobalId total_triangles = 0;   ///< triangles of all ranks
  LocalIndex owned_points = 0;    ///< number of owned points; ghosts follow them
  LocalIndex owned_triangles = 0; ///< number of owned triangles; triangles of other ranks follow them
  LocalIndex owned_facets = 0;    ///< number of owned facets; facets of other ranks follow them
  LocalIndex owned_curve_edges = 0, owned_interfaces = 0; ///< number of owned edges inside; the others follow them

  // Arrays with one entry for each local point.
  std::vector<geometry::Vec2> points; ///< [owned + ghosts], length unit of the container
  std::vector<std::int32_t> boundary; ///< [owned + ghosts], tag of the boundary loop; 0 inside

  // Arrays with one entry for each ghost.
  std::vector<GlobalId> ghost_ids; ///< ascending
  std::vector<int> ghost_owners;   ///< ranks that own the ghosts, ascending because ranks own consecutive ids

  // Arrays with one entry for each local triangle: first the triangles of this rank, then triangles of other ranks;
  // both have ascending global ids.
  std::vector<std::array<LocalIndex, 3>> triangles; ///< local point indices, counter-clockwise, lowest global id first
  std::vector<GlobalId> triangle_ids;
  std::vector<std::int32_t> regions; ///< region of each triangle, from 1; empty: 1 everywhere

  // Arrays with one entry for each facet of a local triangle. A facet is an edge on the boundary with the interior on
  // the left of first -> second.
  std::vector<std::array<LocalIndex, 2>> facets; ///< local point indices
  std::vector<LocalIndex> facet_triangles; ///< the local triangle to which the facet belongs; the same rank owns both
  std::vector<std::int32_t> facet_tags;    ///< tag of the boundary loop
  std::vector<std::int32_t> facet_parts; ///< part of the shape that the facet follows: index into Boundary::part_names

  // Arrays with one entry for each edge on a curve, and for each edge between regions, that is a side of a local
  // triangle. A rank owns the edge if it owns the triangle on the left. A rank may hold one of the two triangles only:
  // always with Overlap::none if they have different owners; with Overlap::triangles only where both ends of the edge
  // are ghosts. The other triangle is then -1.
  std::vector<std::array<LocalIndex, 2>> curve_edges;     ///< local point indices, in the direction of the curve
  std::vector<std::array<LocalIndex, 2>> curve_triangles; ///< local triangles on the left and right, or -1
  std::vector<std::int32_t> curve_numbers;                ///< curve: index into geometry::InnerCurves::names
  std::vector<std::array<LocalIndex, 2>> interfaces;      ///< local point indices; the lower region lies on the left
  std::vector<std::array<LocalIndex, 2>> interface_triangles; ///< as curve_triangles
  std::vector<std::array<std::int32_t, 2>> interface_regions; ///< regions on the left and on the right, from 1
  std::vector<std::int32_t> interface_pairs;                  ///< pair of regions: index into geometry::Regions::pairs
  std::vector<std::int32_t> interface_curves; ///< curve on which the edge lies, which also lists it; -1: none

  // Arrays with one entry for each pair of points on a split curve, if this rank owns one of the two points, as in
  // DistributedMesh. The points have global ids, since the other one need not be a ghost.
  std::vector<std::array<GlobalId, 2>> split_pairs; ///< on the left and on the right side of the curve
  std::vector<std::int32_t> split_curves;           ///< curve: index into geometry::InnerCurves::names
  std::vector<std::int32_t> split_paths;            ///< path of the pair; its pairs are listed in order
  std::vector<GlobalId> split_rows;                 ///< number of the pair in the list of all pairs, ascending

  std::vector<Neighbour> neighbours; ///< ordered by rank

  /// Returns the global id of a local point.
  GlobalId global_id(LocalIndex point) const {
    return point < owned_points ? first_point + point : ghost_ids[at(point - owned_points)];
  }
};

/// @brief Returns the part of a mesh that this rank owns, with the points and triangles that it needs from other ranks.
/// A rank owns a consecutive range of points, the triangles whose lowest vertex it owns, and the facets of these
/// triangles. The mesh may come from a Mesher or from io::read_mesh; it is not needed afterwards.
/// @param mesh the whole mesh, distributed over all ranks of `comm`
/// @throws InternalError on all ranks if a facet belongs to no triangle, or an edge inside not to two
/// @note Collective. Makes seven sparse exchanges, two more for curves, two for interfaces and one for split curves,
/// and gathers one number per rank. Takes O(n log n) time for n points on this rank. Memory: 20 bytes per point and 24
/// per triangle; while it is made, 40 more per triangle. Because vectors grow by doubling, it may need twice as much.
LocalMesh make_local_mesh(const comm::Communicator& comm, const mesh::DistributedMesh& mesh,
                          Overlap overlap = Overlap::triangles);

/// @brief Sets the values of each ghost to those at its owner, bit for bit.
/// @param values [local points x components], the components of a point next to each other; only values of ghosts
/// change
/// @note Collective. Each rank sends one message to each neighbour and receives one from each; it waits for no other
/// rank. Cost: O(shared points).
void update_ghosts(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

/// @brief Adds the values of all ghosts to the values at their owners, one neighbour after the other in the order of
/// their ranks. The values of the ghosts stay. The last bits of the sum depend on the number of ranks.
/// @param values [local points x components], the components of a point next to each other; only values of owned points
/// change
/// @note Collective. Sends the same numbers of messages as update_ghosts.
void add_to_owners(const comm::Communicator& comm, const LocalMesh& mesh, std::span<double> values, int components = 1);

} // namespace trime::handover
