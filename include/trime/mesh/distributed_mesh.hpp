// SPDX-License-Identifier: BSD-3-Clause
// The finished mesh as it lies on the ranks: contiguous slabs of points, triangles and boundary edges in the canonical
// global order (points along the Hilbert curve, triangles and edges by their lowest vertex). Plain data.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace trime::mesh {

/// Contiguous range of a global array that one rank holds.
struct Slab {
  GlobalId first = 0; ///< global index of the first item here
  GlobalId total = 0; ///< items on all ranks
};

/// @brief One rank's part of the mesh; the parts follow each other in rank order and may be empty.
struct DistributedMesh {
  Slab point_slab, triangle_slab, facet_slab;

  // Per point of the slab.
  std::vector<geometry::Vec2> points;
  std::vector<std::int32_t> boundary; ///< 0 inside, else tag of the boundary loop
  std::vector<float> size;            ///< h at the point
  std::vector<std::uint8_t> fixed;    ///< 1 for corners and the user's fixed points

  // Per triangle: vertices counter-clockwise, lowest global id first.
  std::vector<std::array<GlobalId, 3>> triangles;
  std::vector<float> alpha, beta;
  std::vector<std::int32_t> region;

  // Per boundary edge, interior on the left of first -> second.
  std::vector<std::array<GlobalId, 2>> facets;
  std::vector<std::int32_t> facet_tags;  ///< of its loop
  std::vector<std::int32_t> facet_parts; ///< which part of the shape it follows: index into Boundary::part_names

  /// Hash of points and triangles over all ranks, independent of how they are distributed.
  std::uint64_t hash = 0;
};

/// @brief This rank's share of the hash: a sum (mod 2^64) of one term per point and per triangle, so that the sum over
/// ranks depends on the mesh alone. O(points + triangles).
std::uint64_t partial_hash(const DistributedMesh& mesh);

} // namespace trime::mesh
