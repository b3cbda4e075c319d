// SPDX-License-Identifier: BSD-3-Clause
#include "trime/mesh/distributed_mesh.hpp"

#include "trime/core/random.hpp"

#include <bit>

namespace trime::mesh {

std::uint64_t partial_hash(const DistributedMesh& mesh) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const std::uint64_t id = static_cast<std::uint64_t>(mesh.point_slab.first) + i;
    // Adding 0.0 turns -0.0 into 0.0: equal coordinates, equal hash.
    const std::uint64_t x = std::bit_cast<std::uint64_t>(mesh.points[i].x + 0.0);
    const std::uint64_t y = std::bit_cast<std::uint64_t>(mesh.points[i].y + 0.0);
    sum += mix_bits(mix_bits(mix_bits(2 * id) ^ x) ^ y);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint64_t h = mix_bits(2 * (static_cast<std::uint64_t>(mesh.triangle_slab.first) + t) + 1);
    for (const GlobalId vertex : mesh.triangles[t])
      h = mix_bits(h ^ static_cast<std::uint64_t>(vertex));
    sum += h;
  }
  return sum;
}

} // namespace trime::mesh
