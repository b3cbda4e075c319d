// SPDX-License-Identifier: BSD-3-Clause
// The proof that ends every run. It uses stars, chords, shape and arrays, but none of the code that made them.
#pragma once

#include "decomposition/numbering.hpp"
#include "sites/fan.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

namespace trime::certificate {

/// The input that the mesh must represent.
struct Expectation {
  const geometry::Boundary& shape;  ///< as it was given
  const geometry::Boundary& meshed; ///< as it was laid out: with fixed points as corners, at the resolution of h
  const sizing::SizeField& asked;   ///< h before it was lowered: what the features of the boundary are judged by
  double side;                      ///< longer side of the container
  double coarseness = 1;            ///< the h for which the boundary was simplified, over that of the mesh
  double within = 0.5;              ///< [that h] so far it may have moved
  bool topology_changed = false;    ///< a warning has said that components or holes are not those of `shape`
  double corner_angle = 30;         ///< [degrees] where `meshed` turns by more, a vertex is expected
};

/// @brief Makes the certificate. With exact integers it checks that the mesh is a manifold of positive triangles with
/// the right Euler characteristic and area, and that it is Delaunay and has all chords, corners and fixed points. It
/// checks that all stars agree with each other and with `mesh`, the arrays that will be written. Then it compares the
/// boundary of the mesh with that of the shape, see prove_boundary. Collective. O(points + pieces log(pieces))
mesh::Checks certify(const sites::StageView& view, const decomposition::Numbering& numbering,
                     const Expectation& expectation, const mesh::DistributedMesh& mesh);

} // namespace trime::certificate
