// SPDX-License-Identifier: BSD-3-Clause
// The finished mesh, distributed over the ranks: contiguous slabs of points, triangles and facets in the canonical
// global order. Points are ordered along the Hilbert curve, triangles and facets by their lowest vertex. Plain data.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// The contiguous range of a global array that one rank holds.
struct Slab {
  GlobalId first = 0; ///< global index of the first item here
  GlobalId total = 0; ///< items on all ranks
};

/// @brief One rank's part of the mesh. The parts follow each other in rank order and may be empty. Triangles refer to
/// their vertices by local indices, which take half the memory of global ids: first the points of the slab, from 0,
/// then points of other ranks. Memory: 25 bytes per point and 20 per triangle.
struct DistributedMesh {
  Slab point_slab, triangle_slab, facet_slab;

  // Per point of the slab.
  UnsetVector<geometry::Vec2> points;
  UnsetVector<std::int32_t> boundary; ///< 0 inside, else tag of the boundary loop
  UnsetVector<float> size;            ///< h at the point
  UnsetVector<std::uint8_t> fixed;    ///< 1 for corners and the user's fixed points

  // Per triangle: vertices counter-clockwise, lowest global id first. See global_id and triangle_ids.
  UnsetVector<std::array<LocalIndex, 3>> triangles;
  UnsetVector<float> alpha, beta;
  std::vector<std::int32_t> region; ///< empty: 1 everywhere

  /// Global ids of the vertices that other ranks hold, ascending: the first has the local index points.size().
  std::vector<GlobalId> foreign;

  // Per facet, interior on the left of first -> second.
  std::vector<std::array<GlobalId, 2>> facets;
  std::vector<std::int32_t> facet_tags;  ///< tag of its loop
  std::vector<std::int32_t> facet_parts; ///< part of the shape that it follows: index into Boundary::part_names
  std::vector<float> facet_sizes;        ///< h at its middle as it was asked for; `size` of the points may be lower

  /// Hash of points and triangles over all ranks, independent of how they are distributed.
  std::uint64_t hash = 0;

  GlobalId global_id(LocalIndex vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return v < points.size() ? point_slab.first + vertex : foreign[v - points.size()];
  }
  /// Returns the global ids of the vertices of triangle t of the slab.
  std::array<GlobalId, 3> triangle_ids(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return {global_id(a), global_id(b), global_id(c)};
  }
};

/// @brief Sets `triangles` and `foreign` from global ids. @pre `points` and `point_slab` are set. O(n log n)
void assign_triangles(DistributedMesh& mesh, std::span<const std::array<GlobalId, 3>> ids);
/// Returns the triangles of the slab by global ids: 24 bytes each.
std::vector<std::array<GlobalId, 3>> global_triangles(const DistributedMesh& mesh);

/// @brief Returns this rank's share of the hash: a sum (mod 2^64) of one term per point and per triangle, so that the
/// sum over ranks depends on the mesh alone. O(points + triangles), by all threads.
std::uint64_t partial_hash(const DistributedMesh& mesh);

} // namespace trime::mesh
