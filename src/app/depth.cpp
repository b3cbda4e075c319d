// SPDX-License-Identifier: BSD-3-Clause
#include "app/depth.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::app {

void add_depth(const DistanceFormula& formula, meshing::MeshResult& result, const comm::Communicator& comm) {
  mesh::DistributedMesh& mesh = result.mesh;
  UnsetVector<double>& depth = mesh.depth.emplace();
  depth.resize(mesh.points.size());
  constexpr std::ptrdiff_t chunk = 256; // points per turn of a thread
  thread_loop(std::ssize(depth), chunk, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    depth[k] = formula.evaluate(mesh.points[k].x, mesh.points[k].y);
  });
  const auto numbers = std::ranges::count_if(depth, [](double value) { return std::isfinite(value); });
  const std::int64_t found = comm.sum(std::int64_t{numbers}), expected = mesh.point_slab.total;
  result.checks.push_back({"depths", static_cast<double>(expected), static_cast<double>(found), found == expected,
                           fmt::format("points whose depth is a number; 'depth = {}' in [output] must be one at every "
                                       "point of the mesh",
                                       formula.text())});
}

} // namespace trime::app
