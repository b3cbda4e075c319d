// SPDX-License-Identifier: BSD-3-Clause
// The problem that the two solvers solve: -Laplace(u) = f in a plate with a round hole. On the part "plate" of the
// boundary u is given, on the part "hole" its slope along the normal.
#pragma once

#include <trime/comm/communicator.hpp>
#include <trime/core/error.hpp>
#include <trime/handover/local_mesh.hpp>
#include <trime/meshing/make_mesh.hpp>
#include <trime/shape/region_shape.hpp>
#include <trime/sizing/size_field.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace plate {

using trime::geometry::Vec2;

/// The exact u, its gradient and f.
inline double solution(Vec2 p) {
  return std::sin(2 * p.x) * std::exp(p.y);
}
inline Vec2 gradient(Vec2 p) {
  return std::exp(p.y) * Vec2{2 * std::cos(2 * p.x), std::sin(2 * p.x)};
}
inline double source(Vec2 p) {
  return 3 * solution(p);
}

inline trime::shape::RegionShape shape() {
  using trime::shape::Part;
  const trime::geometry::Frame frame({{0, 0}, {1, 1}});
  return {{Part::rectangle("plate", {{0.05, 0.05}, {0.95, 0.95}}, frame), Part::circle("hole", {0.5, 0.5}, 0.2, frame)},
          "difference(plate, hole)",
          frame};
}

/// Returns the value of LocalMesh::facet_parts for a name.
inline int part_number(const trime::shape::RegionShape& shape, const std::string& name) {
  const std::vector<std::string>& names = shape.boundary().part_names;
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Makes a mesh of about this number of points, and returns this rank's part. Collective.
inline trime::handover::LocalMesh mesh(const trime::comm::Communicator& comm, const trime::shape::RegionShape& shape,
                                       trime::GlobalId points, trime::handover::Overlap overlap) {
  trime::meshing::MeshOptions options;
  options.points = points;
  trime::Log log(trime::LogLevel::warning, comm.is_root());
  const trime::meshing::MeshResult result = make_mesh(comm, shape, trime::sizing::UniformSize(), options, log);
  if (!is_complete(result)) // the same on all ranks
    throw trime::GeometryError("a check of the mesh failed: solve on another number of points");
  return make_local_mesh(comm, result.mesh, overlap);
}

} // namespace plate
