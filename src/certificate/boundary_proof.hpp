// SPDX-License-Identifier: BSD-3-Clause
// The part of the certificate that compares the boundary of the mesh with the boundary of the shape: vertices lie on
// the curve, chords lie near it, cycles of facets are its loops, and the areas agree.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/validity.hpp"
#include "trime/sizing/size_field.hpp"

namespace trime::certificate {

/// The data with which the boundary of a mesh is compared. All of it is replicated.
struct BoundaryTruth {
  const geometry::Boundary& shape;     ///< the boundary as it was given
  const geometry::Boundary& meshed;    ///< the boundary as it was laid out: with fixed points as corners
  const polygon::BoundarySites& sites; ///< vertices of the mesh on `meshed`
  const sizing::SizeField& size;       ///< h of the mesh
  const sizing::SizeField&
      asked; ///< h before it was lowered: the distance of chords from left-out corners is measured by it
  const geometry::Lattice& lattice;
  double side;           ///< longer side of the container
  double mesh_area;      ///< area of all triangles
  double coarseness = 1; ///< h for which the boundary was simplified, over h of the mesh
  double within = 0.5;   ///< [that h] how far simplification may have moved the boundary
};

/// @brief Makes nine checks from the arrays of the mesh that will be written, the given boundary and the boundary that
/// was laid out. Each rank checks its share of the sites and of the pieces. Every rank holds trees over all pieces, 60
/// bytes per piece: O(pieces + (sites + points of the rank) log(pieces) / ranks). For facets see count_cycles. @note
/// Collective.
/// @throws the errors of a size field of the user, on all ranks together
mesh::Checks prove_boundary(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh,
                            const comm::Communicator& comm);

} // namespace trime::certificate
