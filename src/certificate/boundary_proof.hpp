// SPDX-License-Identifier: BSD-3-Clause
// The part of the certificate that compares the boundary of the mesh with that of the shape: vertices on the curve,
// chords next to it, cycles of facets as its loops, and the area between them.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::certificate {

/// The data that the boundary of a mesh is compared with. All of it is replicated.
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
/// Each rank proves its share of the sites and of the pieces. Trees over all pieces, 60 bytes each, are on every rank:
/// O(pieces + (sites + points of the rank) log(pieces) / ranks). Facets: see count_cycles. @note Collective.
/// @throws what a size field of the user throws, on all ranks together
mesh::Checks prove_boundary(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh,
                            const comm::Communicator& comm);

} // namespace trime::certificate
