// SPDX-License-Identifier: BSD-3-Clause
#include "app/boundary_check.hpp"

#include "trime/io/point_lookup.hpp"

#include <algorithm>
#include <limits>

namespace trime::app {

mesh::Checks check_boundary_distance(const mesh::DistributedMesh& mesh, const geometry::RegionShape& shape,
                                     const comm::Communicator& comm) {
  std::vector<GlobalId> wanted;
  for (const auto& facet : mesh.facets)
    wanted.insert(wanted.end(), facet.begin(), facet.end());
  const io::PointLookup points(mesh, std::move(wanted), comm);
  double at_vertices = 0, at_middles = 0, smallest = std::numeric_limits<double>::infinity();
  for (const auto& [first, second] : mesh.facets) {
    const io::MeshPoint &a = points[first], &b = points[second];
    const geometry::Vec2 end = shape.frame().periods().nearest_image(b.position, a.position);
    const double size = 0.5 * (a.size + b.size);
    smallest = std::min(smallest, a.size);
    at_vertices = std::max(at_vertices, shape.distance_to_boundary(a.position) / a.size);
    at_middles = std::max(at_middles, shape.distance_to_boundary(0.5 * (a.position + end)) / size);
  }
  at_vertices = comm.max(at_vertices);
  at_middles = comm.max(at_middles);
  // An arc of length h between two of its points strays from their middle by h/2 at most; sites spread by quantiles and
  // insertion may lie a little more than h apart.
  constexpr double middle_limit = 0.75;
  // Sites lie on the lattice: in a container far larger than the shape its step is what limits them.
  const double vertex_limit = std::max(1e-6, shape.frame().step() / comm.min(smallest));
  return {{"boundary_vertex_distance", vertex_limit, at_vertices, at_vertices <= vertex_limit,
           "largest distance of a boundary vertex from the shape's boundary, over h (at most)"},
          {"boundary_edge_distance", middle_limit, at_middles, at_middles <= middle_limit,
           "largest distance of the middle of a boundary edge from the shape's boundary, over h (at most)"}};
}

} // namespace trime::app
