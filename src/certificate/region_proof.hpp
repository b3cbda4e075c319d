// SPDX-License-Identifier: BSD-3-Clause
// The part of the certificate that is about regions: their triangles fill the outline of each region exactly, and the
// interfaces have the right region on each side.
#pragma once

#include "decomposition/numbering.hpp"
#include "polygon/region_finder.hpp"
#include "sites/fan.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

#include <cstdint>
#include <vector>

namespace trime::certificate {

/// The checks, and what they have counted in each region.
struct RegionProof {
  mesh::Checks checks;
  std::vector<std::int64_t> triangles; ///< by region
  std::vector<double> areas;           ///< by region, of its triangles
};

/// @brief Makes three checks. The exact area of the triangles of each region is that of the polygon of its chords. The
/// triangles on both sides of each interface belong to its two regions, and other edges at such vertices have one
/// region on both sides. The arrays have as many triangles of each region as the stars. Since no triangle overlaps
/// another (see certify), equal areas mean that the triangles of a region fill its outline. Memory: 40 bytes per region
/// on each thread. Cost: O(points + chords log chords).
/// @return no checks if there is only one region
/// @note Collective.
RegionProof prove_regions(const sites::StageView& view, const decomposition::Numbering& numbering,
                          const polygon::RegionFinder& regions, const mesh::DistributedMesh& mesh);

} // namespace trime::certificate
