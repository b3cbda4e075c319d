// SPDX-License-Identifier: BSD-3-Clause
#include "trime/mesh/distributed_mesh.hpp"

#include "core/random.hpp"
#include "core/thread_loop.hpp"

#include <algorithm>
#include <bit>

namespace trime::mesh {
namespace {

std::uint64_t point_term(const DistributedMesh& mesh, std::size_t i) {
  const std::uint64_t id = static_cast<std::uint64_t>(mesh.point_slab.first) + i;
  // Adding 0.0 turns -0.0 into 0.0: equal coordinates, equal hash.
  const std::uint64_t x = std::bit_cast<std::uint64_t>(mesh.points[i].x + 0.0);
  const std::uint64_t y = std::bit_cast<std::uint64_t>(mesh.points[i].y + 0.0);
  return mix_bits(mix_bits(mix_bits(2 * id) ^ x) ^ y);
}

std::uint64_t triangle_term(const DistributedMesh& mesh, std::size_t t) {
  std::uint64_t h = mix_bits(2 * (static_cast<std::uint64_t>(mesh.triangle_slab.first) + t) + 1);
  for (const GlobalId vertex : mesh.triangle_ids(t))
    h = mix_bits(h ^ static_cast<std::uint64_t>(vertex));
  return h;
}

} // namespace

void assign_triangles(DistributedMesh& mesh, std::span<const std::array<GlobalId, 3>> ids) {
  const GlobalId first = mesh.point_slab.first, end = first + std::ssize(mesh.points);
  const auto is_foreign = [&](GlobalId id) { return id < first || id >= end; };
  mesh.foreign.clear();
  for (const auto& triangle : ids)
    std::copy_if(triangle.begin(), triangle.end(), std::back_inserter(mesh.foreign), is_foreign);
  std::sort(mesh.foreign.begin(), mesh.foreign.end());
  mesh.foreign.erase(std::unique(mesh.foreign.begin(), mesh.foreign.end()), mesh.foreign.end());
  const auto vertex = [&](GlobalId id) {
    if (!is_foreign(id))
      return static_cast<LocalIndex>(id - first);
    const auto found = std::lower_bound(mesh.foreign.begin(), mesh.foreign.end(), id);
    return static_cast<LocalIndex>(std::ssize(mesh.points) + (found - mesh.foreign.begin()));
  };
  mesh.triangles.clear();
  for (const auto& [a, b, c] : ids)
    mesh.triangles.push_back({vertex(a), vertex(b), vertex(c)});
}

std::vector<std::array<GlobalId, 3>> global_triangles(const DistributedMesh& mesh) {
  std::vector<std::array<GlobalId, 3>> ids(mesh.triangles.size());
  for (std::size_t t = 0; t < ids.size(); ++t)
    ids[t] = mesh.triangle_ids(t);
  return ids;
}

std::uint64_t partial_hash(const DistributedMesh& mesh) {
  return thread_sum(mesh.points.size(), [&](std::size_t i) { return point_term(mesh, i); }) +
         thread_sum(mesh.triangles.size(), [&](std::size_t t) { return triangle_term(mesh, t); });
}

} // namespace trime::mesh
