// SPDX-License-Identifier: BSD-3-Clause
// Makes a small mesh and distributes it unevenly over any number of ranks; about a third of the ranks get nothing.
#pragma once

#include "core/random.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
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

/// @brief Returns a holed square of three regions, which meet at a point: region 1 on the left, 2 and 3 at the bottom
/// and at the top of the rest. Curve 0 follows the interface between the regions 1 and 2 downwards, and curve 1
/// consists of edges inside region 1. Each caller gets the whole mesh.
inline mesh::DistributedMesh divided_square(int n) {
  mesh::DistributedMesh mesh = holed_square(n);
  std::map<std::array<GlobalId, 2>, std::int32_t> region_of; // region on the left of a side
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<GlobalId, 3> ids = mesh.triangle_ids(t);
    geometry::Vec2 sum{0, 0};
    for (const GlobalId id : ids)
      sum = sum + mesh.points[static_cast<std::size_t>(id)];
    mesh.region[t] = sum.x < 1.2 ? 1 : sum.y < 1.5 ? 2 : 3;
    for (std::size_t k = 0; k < 3; ++k)
      region_of[{ids[k], ids[(k + 1) % 3]}] = mesh.region[t];
  }
  std::map<std::array<GlobalId, 2>, std::int32_t> curves; // by ends, the lower one first
  for (GlobalId row = 1; row < n; ++row)
    curves[{row * (n + 1), row * (n + 1) + 1}] = 1;
  std::map<std::array<GlobalId, 2>, std::array<GlobalId, 2>> interfaces; // by ends, the lower one first
  for (const auto& [side, left] : region_of) {
    const auto other = region_of.find({side[1], side[0]});
    if (other == region_of.end() || left >= other->second)
      continue;
    const std::array<GlobalId, 2> ends{std::min(side[0], side[1]), std::max(side[0], side[1])};
    interfaces[ends] = side;
    if (left == 1 && other->second == 2)
      curves[ends] = 0;
  }
  for (const auto& [ends, side] : interfaces) {
    const std::int32_t left = region_of[side], right = region_of[{side[1], side[0]}];
    mesh.interfaces.push_back(side);
    mesh.interface_regions.push_back({left, right});
    mesh.interface_pairs.push_back(left + right - 3);
    mesh.interface_curves.push_back(curves.contains(ends) ? 0 : -1);
  }
  for (const auto& [ends, number] : curves) {
    mesh.curve_edges.push_back(number == 0 ? std::array{ends[1], ends[0]} : ends);
    mesh.curve_numbers.push_back(number);
  }
  mesh.curve_slab.total = static_cast<GlobalId>(mesh.curve_edges.size());
  mesh.interface_slab.total = static_cast<GlobalId>(mesh.interfaces.size());
  return mesh;
}
/// The regions of the divided square. The pairs of regions share interfaces.
inline geometry::Regions three_regions() {
  return {{"rest", "rock", "soil"}, {{0, 1}, {0, 2}, {1, 2}}};
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
  std::int64_t curve_edges = 0, interfaces = 0, pairs = 0;
  mesh.split_slab = share(comm, whole.split_slab.total, seed + 50, pairs);
  mesh.split_pairs = cut(whole.split_pairs, mesh.split_slab, pairs);
  mesh.split_curves = cut(whole.split_curves, mesh.split_slab, pairs);
  mesh.split_paths = cut(whole.split_paths, mesh.split_slab, pairs);
  mesh.curve_slab = share(comm, whole.curve_slab.total, seed + 30, curve_edges);
  mesh.interface_slab = share(comm, whole.interface_slab.total, seed + 40, interfaces);
  mesh.curve_edges = cut(whole.curve_edges, mesh.curve_slab, curve_edges);
  mesh.curve_numbers = cut(whole.curve_numbers, mesh.curve_slab, curve_edges);
  mesh.interfaces = cut(whole.interfaces, mesh.interface_slab, interfaces);
  mesh.interface_regions = cut(whole.interface_regions, mesh.interface_slab, interfaces);
  mesh.interface_pairs = cut(whole.interface_pairs, mesh.interface_slab, interfaces);
  mesh.interface_curves = cut(whole.interface_curves, mesh.interface_slab, interfaces);
  return mesh;
}

} // namespace trime::test
