// SPDX-License-Identifier: BSD-3-Clause
// The proof that ends every run. It uses Delaunay stars, boundary edges, shape and arrays, but no code that made them.
#pragma once

#include "decomposition/numbering.hpp"
#include "sites/fan.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"

namespace trime::certificate {

/// The input that the mesh must represent.
struct Expectation {
  const geometry::Boundary& shape; ///< the boundary as it was given
  const geometry::Boundary&
      meshed; ///< the boundary that was meshed: with fixed points as corners, simplified to the resolution of h
  const sizing::SizeField& asked; ///< size before it was lowered; features of the boundary are compared with it
  double side;                    ///< longer side of the container
  double coarseness = 1;          ///< h for which the boundary was simplified, divided by h of the mesh
  double within = 0.5; ///< largest distance by which simplification may have moved the boundary, in units of that h
  bool topology_changed =
      false; ///< whether a warning has said that the mesh has other numbers of components or holes than `shape`
  double corner_angle = 30; ///< [degrees] where `meshed` turns by more than this, a vertex is expected
};

/// @brief Makes the certificate. With exact integers it checks that the mesh is a manifold of positively oriented
/// triangles with the right Euler characteristic and area, that it is Delaunay, and that it contains all boundary
/// edges, corners and fixed points. It checks that all stars agree with each other and with `mesh`, the arrays that
/// will be written. Then it compares the boundary of the mesh with that of the shape, see prove_boundary. Collective.
/// Cost: O(points + pieces log(pieces)).
mesh::Checks certify(const sites::StageView& view, const decomposition::Numbering& numbering,
                     const Expectation& expectation, const mesh::DistributedMesh& mesh);

} // namespace trime::certificate
