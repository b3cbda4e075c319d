// SPDX-License-Identifier: BSD-3-Clause
// The hash of a mesh belongs to the mesh, not to its distribution.
#include "trime/mesh/distributed_mesh.hpp"

#include <gtest/gtest.h>

namespace trime::mesh {
namespace {

DistributedMesh square_mesh() {
  DistributedMesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 4}, {2, 3, 4}};
  mesh.point_slab = {0, 5};
  mesh.triangle_slab = {0, 4};
  return mesh;
}

TEST(MeshHash, TheSharesOfAnySlabsAddUpToTheWhole) {
  const DistributedMesh whole = square_mesh();
  const std::uint64_t expected = partial_hash(whole);
  for (std::size_t p = 0; p <= whole.points.size(); ++p)
    for (std::size_t t = 0; t <= whole.triangles.size(); ++t) {
      DistributedMesh first, second;
      first.points.assign(whole.points.begin(), whole.points.begin() + static_cast<std::ptrdiff_t>(p));
      second.points.assign(whole.points.begin() + static_cast<std::ptrdiff_t>(p), whole.points.end());
      second.point_slab.first = static_cast<GlobalId>(p);
      second.triangle_slab.first = static_cast<GlobalId>(t);
      const auto ids = global_triangles(whole);
      assign_triangles(first, std::span(ids).first(t));
      assign_triangles(second, std::span(ids).subspan(t));
      EXPECT_EQ(partial_hash(first) + partial_hash(second), expected);
    }
}

TEST(DistributedMesh, VerticesOfOtherRanksComeAfterThePoints) {
  DistributedMesh mesh;
  mesh.points = {{0, 0}, {1, 0}};
  mesh.point_slab = {GlobalId{1} << 40, GlobalId{1} << 41};
  const GlobalId first = mesh.point_slab.first;
  const std::vector<std::array<GlobalId, 3>> ids{{3, first, first + 1}, {first, first + 7, 3}, {3, 2, first + 7}};
  assign_triangles(mesh, ids);
  EXPECT_EQ(mesh.foreign, (std::vector<GlobalId>{2, 3, first + 7}));
  EXPECT_EQ(mesh.triangles[1], (std::array<LocalIndex, 3>{0, 4, 3}));
  EXPECT_EQ(global_triangles(mesh), ids);
}

TEST(MeshHash, SeesEveryChangeButTheSignOfZero) {
  const std::uint64_t expected = partial_hash(square_mesh());
  DistributedMesh mesh = square_mesh();
  mesh.points[0].x = -0.0;
  EXPECT_EQ(partial_hash(mesh), expected);
  mesh.points[4].x += 1e-16;
  EXPECT_NE(partial_hash(mesh), expected);
  mesh = square_mesh();
  std::swap(mesh.points[0], mesh.points[1]);
  EXPECT_NE(partial_hash(mesh), expected);
  mesh = square_mesh();
  std::swap(mesh.triangles[0], mesh.triangles[1]);
  EXPECT_NE(partial_hash(mesh), expected);
  mesh = square_mesh();
  mesh.triangles[0] = {1, 4, 0};
  EXPECT_NE(partial_hash(mesh), expected);
  mesh = square_mesh();
  std::swap(mesh.points[0].x, mesh.points[1].x); // the coordinates of two points exchanged
  EXPECT_NE(partial_hash(mesh), expected);
}

} // namespace
} // namespace trime::mesh
