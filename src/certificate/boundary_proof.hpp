// SPDX-License-Identifier: BSD-3-Clause
// The part of the certificate that compares the boundary of the mesh with that of the shape: vertices on the curve,
// chords beside it, cycles of facets as its loops, and the area between them.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/validity.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace trime::certificate {

/// What the boundary of a mesh is held against. All of it is replicated.
struct BoundaryTruth {
  const geometry::Boundary& shape;     ///< as it was given
  const geometry::Boundary& meshed;    ///< as it was laid out: with fixed points as corners
  const polygon::BoundarySites& sites; ///< on `meshed`, the vertices of the mesh's boundary
  const sizing::SizeField& size;       ///< h of the mesh
  const sizing::SizeField& asked; ///< the same before it was lowered: chords may leave out corners by shares of this
  const geometry::Lattice& lattice;
  double side;           ///< longer side of the container
  double mesh_area;      ///< of all triangles
  double coarseness = 1; ///< the h for which the boundary was simplified, over that of the mesh
  double within = 0.5;   ///< [that h] so far it may have moved
};

/// @brief Nine checks, all from the arrays of the mesh that will be written, the shape, and what it was laid out as.
/// O((sites + pieces) log(pieces)) on each rank; rank 0 holds all facets, 24 bytes each. @note Collective.
mesh::Checks prove_boundary(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh,
                            const comm::Communicator& comm);

/// A facet with its tag.
struct TaggedFacet {
  GlobalId first, second;
  std::int64_t tag;
};

/// What facets make when each is followed to the one that starts where it ends.
struct CycleCounts {
  std::int64_t irregular = 0; ///< ends of facets that are not the start of exactly one and the end of exactly one
  std::int64_t cycles = 0;    ///< closed ones
  std::int64_t foreign =
      0; ///< facets with another tag than the first facet of their cycle, or in a second one of a tag
};
/// Serial, O(facets log facets).
CycleCounts count_cycles(std::vector<TaggedFacet> facets);

} // namespace trime::certificate
