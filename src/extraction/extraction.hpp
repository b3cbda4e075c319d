// SPDX-License-Identifier: BSD-3-Clause
// From certified stars to the arrays that are written, triangles in canonical order, and their quality.
#pragma once

#include "decomposition/numbering.hpp"
#include "sites/fan.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

namespace trime::extraction {

/// The mesh in canonical numbering, with its quality.
struct Extraction {
  mesh::DistributedMesh mesh;
  mesh::QualitySummary quality;
};
/// @pre stars of all sites are certain, bins and halo fresh. O(points), by all threads.
/// @throws GeometryError on all ranks together if the size at an edge is not positive and finite. Collective.
/// @param asked h before it was lowered, for the facets
Extraction extract_mesh(const sites::StageView& view, const decomposition::Numbering& numbering,
                        const sizing::SizeField& asked);

/// No triangle may be worse than `most`, except next to corners below 60 degrees.
mesh::Check worst_alpha_check(const mesh::QualitySummary& quality, double most);

} // namespace trime::extraction
