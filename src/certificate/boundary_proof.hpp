// SPDX-License-Identifier: BSD-3-Clause
// The part of the certificate that compares the boundary of the mesh with the boundary of the shape: vertices lie on
// the curve, boundary edges lie near it, cycles of boundary edges correspond to loops, and the areas agree.
#pragma once

#include "polygon/polygon.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/mesh/distributed_mesh.hpp"
#include "trime/mesh/quality.hpp"
#include "trime/sizing/size_field.hpp"

#include <array>
#include <cstdint>

namespace trime::certificate {

__extension__ using Int128 = __int128;

/// Twice an area in squared lattice steps. It is an integer, which ranks exchange in three parts of 40 bits and a
/// remainder.
struct ExactArea {
  Int128 twice = 0;

  /// Adds the exact area of a triangle. @pre the vertices lie on the lattice
  void add_triangle(geometry::Vec2 p, geometry::Vec2 q, geometry::Vec2 r, const geometry::Lattice& lattice) {
    const Int128 ux = lattice.steps(q.x - p.x), uy = lattice.steps(q.y - p.y);
    const Int128 vx = lattice.steps(r.x - p.x), vy = lattice.steps(r.y - p.y);
    twice += ux * vy - uy * vx;
  }
  /// Adds any area, rounded to half a squared lattice step, which is at most 2^-86 of the area of the container.
  void add(double area, const geometry::Lattice& lattice) {
    twice += static_cast<Int128>(2 * area * lattice.inverse_step() * lattice.inverse_step());
  }
  void add(const ExactArea& other) { twice += other.twice; }

  std::array<std::int64_t, 3> split() const {
    constexpr Int128 mask = (Int128{1} << 40) - 1;
    return {static_cast<std::int64_t>(twice & mask), static_cast<std::int64_t>((twice >> 40) & mask),
            static_cast<std::int64_t>(twice >> 80)};
  }
  static ExactArea join(const std::array<std::int64_t, 3>& parts) {
    return {(Int128{parts[2]} << 80) + (Int128{parts[1]} << 40) + parts[0]};
  }
  double value(const geometry::Lattice& lattice) const {
    return 0.5 * static_cast<double>(twice) * lattice.step() * lattice.step();
  }
};

/// The data with which the boundary of a mesh is compared. All data are the same on every rank.
struct BoundaryTruth {
  const geometry::Boundary& shape;     ///< the boundary as it was given
  const geometry::Boundary& meshed;    ///< the boundary that was meshed, with fixed points as corners
  const polygon::BoundarySites& sites; ///< vertices of the mesh on `meshed`
  const sizing::SizeField& size;       ///< h of the mesh
  const sizing::SizeField&
      asked; ///< size before it was lowered; distances from boundary edges to left-out corners are compared with it
  const geometry::Lattice& lattice;
  double side;           ///< longer side of the container
  double mesh_area;      ///< area of all triangles
  double coarseness = 1; ///< h for which the boundary was simplified, divided by h of the mesh
  double within = 0.5;   ///< largest distance by which simplification may have moved the boundary, in units of that h
};

/// @brief Makes nine checks from the arrays of the mesh that will be written, the given boundary and the meshed
/// boundary. Each rank checks its share of the sites and of the pieces. Every rank holds trees over all pieces, which
/// take 60 bytes per piece. Cost: O(pieces + (sites + points of the rank) log(pieces) / ranks). count_cycles describes
/// the cost for boundary edges.
/// @note Collective.
/// @throws the errors of a user's size field, on all ranks together
mesh::Checks prove_boundary(const BoundaryTruth& truth, const mesh::DistributedMesh& mesh,
                            const comm::Communicator& comm);

} // namespace trime::certificate
