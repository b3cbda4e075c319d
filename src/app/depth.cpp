// SPDX-License-Identifier: BSD-3-Clause
#include "app/depth.hpp"

#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::app {

namespace {

struct DepthRange {
  std::int64_t numbers = 0, negative = 0; // points
  double least = INFINITY, most = -INFINITY;
};

/// Collective.
DepthRange range_of(const UnsetVector<double>& depth, const comm::Communicator& comm) {
  DepthRange range;
  for (const double value : depth)
    if (std::isfinite(value)) {
      ++range.numbers;
      range.negative += value < 0;
      range.least = std::fmin(range.least, value);
      range.most = std::fmax(range.most, value);
    }
  std::array sums{range.numbers, range.negative};
  comm.sum(sums);
  return {sums[0], sums[1], comm.min(range.least), comm.max(range.most)};
}

/// The place of the first point without a number. Collective.
geometry::Vec2 first_without(const mesh::DistributedMesh& mesh, const comm::Communicator& comm) {
  const auto bad = std::ranges::find_if(*mesh.depth, [](double value) { return !std::isfinite(value); });
  const GlobalId none = mesh.point_slab.total;
  const GlobalId here = bad == mesh.depth->end() ? none : mesh.point_slab.first + (bad - mesh.depth->begin());
  std::array<double, 2> place{-INFINITY, -INFINITY};
  const GlobalId first = comm.min(here);
  if (here != none && here == first) {
    const geometry::Vec2 p = mesh.points[static_cast<std::size_t>(here - mesh.point_slab.first)];
    place = {p.x, p.y};
  }
  comm.max(place);
  return {place[0], place[1]};
}

} // namespace

void add_depth(const DistanceFormula& formula, meshing::MeshResult& result, const comm::Communicator& comm, Log& log) {
  mesh::DistributedMesh& mesh = result.mesh;
  UnsetVector<double>& depth = mesh.depth.emplace();
  depth.resize(mesh.points.size());
  constexpr std::ptrdiff_t chunk = 256; // points per turn of a thread
  thread_loop(std::ssize(depth), chunk, [&](std::ptrdiff_t item, int) {
    const auto k = static_cast<std::size_t>(item);
    depth[k] = formula.evaluate(mesh.points[k].x, mesh.points[k].y);
  });
  const DepthRange range = range_of(depth, comm);
  const std::int64_t expected = mesh.point_slab.total;
  result.checks.push_back({"depths", static_cast<double>(expected), static_cast<double>(range.numbers),
                           range.numbers == expected,
                           fmt::format("points whose depth is a number; 'depth = {}' in [output] must be one at every "
                                       "point of the mesh",
                                       formula.text())});
  if (range.numbers < expected)
    log.warning("{}: '{}' is not a number at {} of {} points of the mesh, the first one at {}", formula.where(),
                formula.text(), expected - range.numbers, expected, Place(first_without(mesh, comm), 6));
  if (range.numbers > 0)
    log.summary("depths from {:.6g} to {:.6g}; {} of {} points have a negative depth", range.least, range.most,
                range.negative, expected);
}

} // namespace trime::app
