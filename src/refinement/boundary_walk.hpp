// SPDX-License-Identifier: BSD-3-Clause
// Follows the boundary edges of a mesh: loops with their lengths, the area that they enclose, and sharp corners.
#pragma once

#include "certificate/boundary_proof.hpp"
#include "extraction/mesh_quality.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/polygon/loop_summary.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::refinement {

/// A boundary edge with the places of its ends; the interior lies on its left.
struct PlacedFacet {
  GlobalId first, second;
  geometry::Vec2 a, b; ///< in the container
  std::int32_t tag, part;
};

/// The loops that the boundary edges of a mesh form, with their faults.
struct BoundaryWalk {
  std::vector<polygon::LoopSummary> loops; ///< ordered by tag; `parts` are left empty
  certificate::ExactArea area;             ///< inside the loops
  std::int64_t irregular = 0; ///< boundary points at which not exactly one edge begins, and edges that end nowhere
  std::int64_t changes = 0;   ///< points at which the tag changes
  std::int64_t tags = 0;      ///< number of different tags
  std::vector<extraction::SharpCorners::Corner> corners; ///< all corners, with the angle inside
};

/// @brief Follows the edges. Cost: O(n log n). The result does not depend on the order of the edges.
/// @param facets all boundary edges of the mesh
/// @param corners ids of the points on the boundary that are corners, ascending
BoundaryWalk walk_along(std::vector<PlacedFacet> facets, std::span<const GlobalId> corners,
                        const geometry::Frame& frame);

} // namespace trime::refinement
