// SPDX-License-Identifier: BSD-3-Clause
// The finished mesh as it lies on the ranks: contiguous slabs of points, triangles and facets in the canonical global
// order. Points lie along the Hilbert curve; triangles and facets go by their lowest vertex. Plain data.
#pragma once

#include "trime/core/types.hpp"
#include "trime/core/unset_vector.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace trime::mesh {

/// Contiguous range of a global array that one rank holds.
struct Slab {
  GlobalId first = 0; ///< global index of the first item here
  GlobalId total = 0; ///< items on all ranks
};

/// @brief One rank's part of the mesh; the parts follow each other in rank order and may be empty. Triangles name their
/// vertices by numbers of this rank, which take half the memory of global ids: the points of the slab from 0, then
/// those of other ranks. 25 bytes a point, 20 a triangle.
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

  /// Global ids of the vertices that other ranks hold, ascending: the first is vertex points.size().
  std::vector<GlobalId> foreign;

  // Per facet, interior on the left of first -> second.
  std::vector<std::array<GlobalId, 2>> facets;
  std::vector<std::int32_t> facet_tags;  ///< of its loop
  std::vector<std::int32_t> facet_parts; ///< which part of the shape it follows: index into Boundary::part_names
  std::vector<float> facet_sizes;        ///< h at its middle as it was asked for; that of the points may be lower

  /// Hash of points and triangles over all ranks, independent of how they are distributed.
  std::uint64_t hash = 0;

  GlobalId global_id(LocalIndex vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return v < points.size() ? point_slab.first + vertex : foreign[v - points.size()];
  }
  /// Global ids of the vertices of triangle t of the slab.
  std::array<GlobalId, 3> triangle_ids(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return {global_id(a), global_id(b), global_id(c)};
  }
};

/// @brief Sets `triangles` and `foreign` from global ids. @pre `points` and `point_slab` are set. O(n log n)
void assign_triangles(DistributedMesh& mesh, std::span<const std::array<GlobalId, 3>> ids);
/// The triangles of the slab by global ids: 24 bytes each.
std::vector<std::array<GlobalId, 3>> global_triangles(const DistributedMesh& mesh);

/// @brief This rank's share of the hash: a sum (mod 2^64) of one term per point and per triangle, so that the sum over
/// ranks depends on the mesh alone. O(points + triangles); threads.
std::uint64_t partial_hash(const DistributedMesh& mesh);

} // namespace trime::mesh
