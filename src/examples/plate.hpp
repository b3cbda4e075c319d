// SPDX-License-Identifier: BSD-3-Clause
// The problem that 04_solver and 07_petsc solve: -Laplace(u) = f in a plate with a round hole. On the boundary part
// "plate" the values of u are given (Dirichlet), on the boundary part "hole" its normal derivative (Neumann).
#pragma once

#include <trime/trime.hpp>

#include <cmath>

namespace plate {

using trime::Vec2;

/// The exact solution u, its gradient and the right-hand side f.
inline double solution(Vec2 p) {
  return std::sin(2 * p.x) * std::exp(p.y);
}
inline Vec2 gradient(Vec2 p) {
  return std::exp(p.y) * Vec2{2 * std::cos(2 * p.x), std::sin(2 * p.x)};
}
inline double source(Vec2 p) {
  return 3 * solution(p);
}

/// Returns this rank's part of a mesh with about `points` points. Collective.
inline trime::LocalMesh mesh(MPI_Comm comm, trime::GlobalId points, trime::handover::Overlap overlap) {
  auto shape = trime::rectangle("plate", {0.05, 0.05}, {0.95, 0.95}) - trime::circle("hole", {0.5, 0.5}, 0.2);
  auto mesh = trime::make_mesh(comm, shape, {.points = points});
  if (!mesh.certified()) // all ranks get the same result
    throw trime::GeometryError("a check of the mesh failed: solve on another number of points");
  return mesh.local(overlap);
}

} // namespace plate
