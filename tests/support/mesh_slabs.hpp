// SPDX-License-Identifier: BSD-3-Clause
// Makes a small mesh and distributes it unevenly over any number of ranks; about a third of the ranks get nothing.
#pragma once

#include "core/random.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/mesh/distributed_mesh.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace trime::test {

/// Divides `total` rows unevenly: about a third of the ranks get nothing.
inline mesh::Slab share(const comm::Communicator& comm, std::int64_t total, std::uint64_t seed, std::int64_t& rows) {
  std::vector<std::int64_t> weights;
  for (int rank = 0; rank < comm.size(); ++rank) {
    const std::uint64_t bits = random_bits(seed, RandomPurpose::test, rank, comm.size());
    weights.push_back(bits % 3 == 0 ? 0 : static_cast<std::int64_t>(bits % 1000));
  }
  weights[static_cast<std::size_t>(seed) % weights.size()] += 1;
  std::int64_t sum = 0, before = 0;
  for (std::size_t rank = 0; rank < weights.size(); ++rank) {
    sum += weights[rank];
    before += static_cast<int>(rank) < comm.rank() ? weights[rank] : 0;
  }
  const std::int64_t first = total * before / sum;
  rows = total * (before + weights[static_cast<std::size_t>(comm.rank())]) / sum - first;
  return {first, total};
}

/// Returns the rows of one slab from an array of the whole mesh.
template <class Vector>
Vector cut(const Vector& whole, const mesh::Slab& slab, std::int64_t rows) {
  const auto first = whole.begin() + static_cast<std::ptrdiff_t>(slab.first);
  return Vector(first, first + static_cast<std::ptrdiff_t>(rows));
}

/// Returns the mesh of a square of n x n cells, each cut into two triangles, without the middle cell. It has one outer
/// loop with tag 1, and a hole with tag 2. Each caller gets the whole mesh.
/// @pre n is odd, n >= 3
inline mesh::DistributedMesh holed_square(int n) {
  mesh::DistributedMesh mesh;
  const auto id = [n](int column, int row) { return static_cast<GlobalId>(row * (n + 1) + column); };
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= n; ++column) {
      mesh.points.push_back({column / (n + 0.1), row / (n + 0.3)});
      mesh.size.push_back(1.0F / static_cast<float>(n));
      mesh.fixed.push_back((column == 0 || column == n) && (row == 0 || row == n));
    }
  std::map<std::pair<GlobalId, GlobalId>, int> edges;
  std::vector<std::array<GlobalId, 3>> triangles;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      if (row == n / 2 && column == n / 2)
        continue;
      const GlobalId a = id(column, row), b = id(column + 1, row), c = id(column + 1, row + 1), d = id(column, row + 1);
      for (const std::array<GlobalId, 3>& t : {std::array{a, b, c}, std::array{a, c, d}}) {
        triangles.push_back(t);
        for (std::size_t k = 0; k < 3; ++k)
          edges[{t[k], t[(k + 1) % 3]}] = 1;
      }
    }
  const auto is_outer = [n](GlobalId p) { return p % (n + 1) % n == 0 || p / (n + 1) % n == 0; };
  for (const auto& [edge, one] : edges)
    if (!edges.contains({edge.second, edge.first})) {
      mesh.facets.push_back({edge.first, edge.second});
      mesh.facet_tags.push_back(is_outer(edge.first) ? 1 : 2);
      mesh.facet_parts.push_back(is_outer(edge.first) ? 1 : 0);
      mesh.facet_sizes.push_back(1);
    }
  mesh.boundary.resize(mesh.points.size(), 0);
  for (std::size_t k = 0; k < mesh.facets.size(); ++k)
    mesh.boundary[static_cast<std::size_t>(mesh.facets[k][0])] = mesh.facet_tags[k];
  assign_triangles(mesh, triangles);
  mesh.alpha.assign(mesh.triangles.size(), 1.2F);
  mesh.beta.assign(mesh.triangles.size(), 1.4F);
  mesh.region.assign(mesh.triangles.size(), 1);
  mesh.point_slab.total = static_cast<GlobalId>(mesh.points.size());
  mesh.triangle_slab.total = static_cast<GlobalId>(mesh.triangles.size());
  mesh.facet_slab.total = static_cast<GlobalId>(mesh.facets.size());
  return mesh;
}

/// Returns this rank's part of a whole mesh. Different seeds give different divisions.
inline mesh::DistributedMesh slabs_of(const mesh::DistributedMesh& whole, const comm::Communicator& comm,
                                      std::uint64_t seed) {
  mesh::DistributedMesh mesh;
  std::int64_t points = 0, triangles = 0, facets = 0;
  mesh.point_slab = share(comm, whole.point_slab.total, seed, points);
  mesh.triangle_slab = share(comm, whole.triangle_slab.total, seed + 10, triangles);
  mesh.facet_slab = share(comm, whole.facet_slab.total, seed + 20, facets);
  mesh.points = cut(whole.points, mesh.point_slab, points);
  mesh.boundary = cut(whole.boundary, mesh.point_slab, points);
  mesh.size = cut(whole.size, mesh.point_slab, points);
  mesh.fixed = cut(whole.fixed, mesh.point_slab, points);
  assign_triangles(mesh, cut(global_triangles(whole), mesh.triangle_slab, triangles));
  mesh.alpha = cut(whole.alpha, mesh.triangle_slab, triangles);
  mesh.beta = cut(whole.beta, mesh.triangle_slab, triangles);
  mesh.region = cut(whole.region, mesh.triangle_slab, triangles);
  mesh.facets = cut(whole.facets, mesh.facet_slab, facets);
  mesh.facet_tags = cut(whole.facet_tags, mesh.facet_slab, facets);
  mesh.facet_parts = cut(whole.facet_parts, mesh.facet_slab, facets);
  mesh.facet_sizes = cut(whole.facet_sizes, mesh.facet_slab, facets);
  return mesh;
}

} // namespace trime::test
