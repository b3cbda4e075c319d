// SPDX-License-Identifier: BSD-3-Clause
// Makes the arrays of the mesh from certified stars, with triangles in canonical order, and measures their quality.
#pragma once

#include "decomposition/numbering.hpp"
#include "polygon/region_finder.hpp"
#include "sites/fan.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

namespace trime::extraction {

/// The mesh in canonical numbering, with its quality.
struct Extraction {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
};
/// Makes the arrays of the mesh. Cost: O(points), by all threads. Collective.
/// @pre the stars of all sites are certain, and bins and halo are up to date
/// @throws GeometryError on all ranks together if the size at an edge is not positive and finite
/// @param asked the size before it was lowered near the boundary; its values are stored for the facets
/// @param regions of the polygon of the view
Extraction extract_mesh(const sites::StageView& view, const decomposition::Numbering& numbering,
                        const sizing::SizeField& asked, const polygon::RegionFinder& regions);

/// @brief Sets the positions of the triangles, facets and edges of this rank among those of all ranks, and the hash,
/// which depends on them. Collective.
/// @pre `point_slab` is set
void place_among_all(const comm::Communicator& comm, mesh::DistributedMesh& mesh);

/// Checks that no triangle has an alpha above `most`, except next to corners below 60 degrees.
mesh::Check worst_alpha_check(const mesh::QualitySummary& quality, double most);

/// Returns the check that no edge is much longer than the size asks for at its middle: then the points have missed a
/// place with small sizes.
mesh::Check longest_edge_check(const mesh::QualitySummary& quality);

/// Returns the check that no edge is shorter than the user allows.
mesh::Check shortest_edge_check(const mesh::QualitySummary& quality, double least);

} // namespace trime::extraction
