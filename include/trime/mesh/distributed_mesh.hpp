// SPDX-License-Identifier: BSD-3-Clause
// The finished mesh, distributed over the ranks: each rank holds a contiguous range (slab) of points, triangles and
// facets in a global order. Points are ordered along the Hilbert curve, triangles and facets by their lowest vertex.
// Plain data.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/vec2.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trime::mesh {

/// The contiguous range of a global array that one rank holds.
struct Slab {
  GlobalId first = 0; ///< global index of the first item on this rank
  GlobalId total = 0; ///< number of items on all ranks
};

/// @brief One rank's part of the mesh. The parts of the ranks follow each other in rank order; a part may be empty.
/// Triangles store local indices of their vertices, which take half the memory of global ids: the points of the slab
/// are numbered from 0, followed by points of other ranks. Memory: 25 bytes per point and 20 per triangle.
struct DistributedMesh {
  Slab point_slab, triangle_slab, facet_slab, curve_slab, interface_slab, split_slab;

  // Arrays with one entry for each point of the slab.
  UnsetVector<geometry::Vec2> points;
  UnsetVector<std::int32_t> boundary; ///< tag of the boundary loop on which the point lies; 0 inside
  UnsetVector<float> size;            ///< target edge length h at the point
  UnsetVector<std::uint8_t> fixed;    ///< 1 for corners, nodes of curves and the user's fixed points
  /// Depth of the water or of the ground at the point, positive downwards, for coastal models. All ranks have this
  /// array or none has it. It belongs neither to the triangulation nor to the hash.
  std::optional<UnsetVector<double>> depth;

  // Arrays with one entry for each triangle. Vertices are counter-clockwise, the one with the lowest global id first.
  // See global_id and triangle_ids.
  UnsetVector<std::array<LocalIndex, 3>> triangles;
  UnsetVector<float> alpha, beta;
  std::vector<std::int32_t> region; ///< region of each triangle, from 1; empty: 1 for all triangles

  /// Global ids of the vertices that other ranks hold, ascending. The first of them has the local index points.size().
  std::vector<GlobalId> foreign;

  // Arrays with one entry for each facet (edge on the boundary); the interior lies on the left of first -> second.
  std::vector<std::array<GlobalId, 2>> facets;
  std::vector<std::int32_t> facet_tags; ///< tag of the boundary loop of the facet
  /// Part of the shape on whose boundary the facet lies, as an index into Boundary::part_names. Sides of curves that
  /// are split have the number of parts plus the number of the curve.
  std::vector<std::int32_t> facet_parts;
  std::vector<float> facet_sizes; ///< target edge length at the middle of the facet as the user asked for it; `size` of
                                  ///< the points may be lower

  // Arrays with one entry for each edge on a curve inside the shape, in the direction of the curve. These edges have a
  // triangle on each side, and are not facets.
  std::vector<std::array<GlobalId, 2>> curve_edges;
  std::vector<std::int32_t> curve_numbers; ///< curve of the edge, as an index into geometry::InnerCurves::names

  // Arrays with one entry for each edge between triangles of different regions; the region with the lower number lies
  // on the left of first -> second.
  std::vector<std::array<GlobalId, 2>> interfaces;
  std::vector<std::array<std::int32_t, 2>> interface_regions; ///< numbers of the regions on the left and on the right
  std::vector<std::int32_t> interface_pairs;  ///< the pair of regions, as an index into geometry::Regions::pairs
  std::vector<std::int32_t> interface_curves; ///< the curve on which the edge lies, as in curve_numbers; -1: none

  // Arrays with one entry for each pair of points on the two sides of a curve that is split; the points have equal
  // coordinates. The pairs of a path follow each other in the direction of the curve. Pairs need not be held by the
  // rank that holds their points.
  std::vector<std::array<GlobalId, 2>> split_pairs; ///< points on the left and on the right side of the curve
  std::vector<std::int32_t> split_curves;           ///< curve of the pair, as in curve_numbers
  std::vector<std::int32_t> split_paths;            ///< number of its path, from 0; paths are ordered by their curves

  /// Hash of points and triangles over all ranks, which does not depend on how they are distributed.
  std::uint64_t hash = 0;

  GlobalId global_id(LocalIndex vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return v < points.size() ? point_slab.first + vertex : foreign[v - points.size()];
  }
  /// Returns the global ids of the vertices of the t-th triangle of the slab.
  std::array<GlobalId, 3> triangle_ids(std::size_t t) const {
    const auto& [a, b, c] = triangles[t];
    return {global_id(a), global_id(b), global_id(c)};
  }
};

/// @brief Sets `triangles` and `foreign` from the global ids of the vertices of each triangle. Cost: O(n log n).
/// @pre `points` and `point_slab` are set
void assign_triangles(DistributedMesh& mesh, std::span<const std::array<GlobalId, 3>> ids);
/// Returns the triangles of the slab with global ids of their vertices. Memory: 24 bytes per triangle.
std::vector<std::array<GlobalId, 3>> global_triangles(const DistributedMesh& mesh);

/// @brief Returns this rank's share of the hash: a sum (mod 2^64) with one term per point and per triangle. The sum
/// over all ranks depends on the mesh alone. Cost: O(points + triangles), shared by all threads.
std::uint64_t partial_hash(const DistributedMesh& mesh);

} // namespace trime::mesh
