// SPDX-License-Identifier: BSD-3-Clause
// Fixed points on all ranks: every one is a vertex bit for bit, the mesh is certified and does not depend on the ranks.
#include "core/random.hpp"
#include "support/distributed.hpp"
#include "support/plain_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::boundary {
namespace {

using geometry::Vec2;
using meshing::MeshOptions;
using meshing::MeshResult;
using shape::RegionShape;
using sweep::Method;
using testing::mesh_silently;
using testing::unit_frame;

RegionShape ring() {
  return testing::disc_with_hole({0.5, 0.5}, 0.1);
}

class GradedSize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.5 + p.x; }
};

RegionShape with_points(RegionShape shape, const std::vector<Vec2>& places) {
  std::vector<geometry::FixedPoint> points;
  for (const Vec2 p : places)
    points.push_back({p, "test"});
  shape.set_fixed_points(std::move(points));
  return shape;
}

std::vector<Vec2> wanted_points() {
  std::vector<Vec2> points;
  for (int k = 0; k < 10; ++k)
    points.push_back({0.2 + 0.05 * k, 0.3});
  points.push_back({0.5, 0.601}); // a tenth of the size from the hole
  points.push_back({0.6, 0.7});   // and two that are as near to each other
  points.push_back({0.6, 0.7015});
  points.push_back({0.9, 0.5});               // a vertex of the boundary
  points.push_back({0.5 + 0.24, 0.5 + 0.32}); // on the outer circle
  points.push_back({0.5 - 0.06, 0.5 - 0.08}); // on the hole
  return points;
}

MeshResult run(const comm::Communicator& comm, const sizing::SizeField& size) {
  MeshOptions options;
  options.points = 1500;
  options.method = Method::distmesh;
  options.max_sweeps = 10;
  return mesh_silently(comm, with_points(ring(), wanted_points()).domain(), size, options);
}

void expect_fixed_points(const sizing::SizeField& size) {
  const comm::Communicator world = comm::Communicator::world();
  const MeshResult result = run(world, size);
  testing::expect_certified(result);
  EXPECT_TRUE(std::any_of(result.checks.begin(), result.checks.end(), [](const mesh::Check& check) {
    return check.name == "fixed_points" && check.found == static_cast<double>(wanted_points().size());
  }));
  EXPECT_LE(result.mesh.point_slab.total, 1500);
  EXPECT_GE(result.mesh.point_slab.total, 1470);
  EXPECT_EQ(result.corners, 3); // those on the boundary
  for (const Vec2 p : wanted_points()) {
    std::int64_t found = 0;
    for (std::size_t k = 0; k < result.mesh.points.size(); ++k)
      found += result.mesh.points[k] == unit_frame().lattice().snap(p) && result.mesh.fixed[k] == 1;
    EXPECT_EQ(world.sum(found), 1) << p.x << " " << p.y;
  }
  std::int64_t fixed = std::count(result.mesh.fixed.begin(), result.mesh.fixed.end(), 1);
  EXPECT_EQ(world.sum(fixed), static_cast<std::int64_t>(wanted_points().size()));
  const MeshResult alone = run(comm::Communicator::self(), size);
  EXPECT_EQ(result.mesh.hash, alone.mesh.hash);
}

TEST(FixedPointsInMesh, UniformSize) {
  expect_fixed_points(sizing::UniformSize());
}

TEST(FixedPointsInMesh, GradedSize) {
  expect_fixed_points(GradedSize());
}

/// Free points that would be too near to fixed ones are placed elsewhere: once a quarter of all was missing.
TEST(FixedPointsInMesh, ManyOfThemLeaveRoomForAllPoints) {
  const comm::Communicator world = comm::Communicator::world();
  MeshOptions options;
  options.points = 2000;
  options.max_sweeps = 10;
  std::vector<Vec2> places;
  for (std::uint64_t k = 0; k < 500; ++k) {
    const Vec2 p{random_unit(7, RandomPurpose::test, k, 0), random_unit(7, RandomPurpose::test, k, 1)};
    const double radius = geometry::length(p - Vec2{0.5, 0.5});
    if (radius > 0.12 && radius < 0.38)
      places.push_back(p);
  }
  for (const bool graded : {false, true}) {
    const sizing::UniformSize uniform;
    const GradedSize slope;
    const sizing::SizeField& size = graded ? static_cast<const sizing::SizeField&>(slope) : uniform;
    const MeshResult result = mesh_silently(world, with_points(ring(), places).domain(), size, options);
    EXPECT_LE(result.mesh.point_slab.total, 2000);
    EXPECT_GE(result.mesh.point_slab.total, 1960) << graded;
  }
}

TEST(FixedPointsInMesh, FarFromOthersTrianglesStayGood) {
  // Every fixed point is at least two sizes from any other thing: the worst triangle is no worse than usual.
  const comm::Communicator world = comm::Communicator::world();
  MeshOptions options;
  options.points = 2000;
  options.method = Method::distmesh;
  const RegionShape shape = with_points(testing::square(), {{0.31, 0.42}, {0.55, 0.27}, {0.7, 0.713}});
  const sizing::UniformSize size;
  const MeshResult result = mesh_silently(world, shape.domain(), size, options);
  EXPECT_LT(result.quality.alpha.mean, 1.05);
  EXPECT_LT(result.quality.alpha.max, 2.2);
}

} // namespace
} // namespace trime::boundary
