// SPDX-License-Identifier: BSD-3-Clause
// Meshes of periodic containers: certified (Euler characteristic and area of the torus included), and the same bits on
// any ranks and threads.
#include "support/distributed.hpp"
#include "support/periodic_shapes.hpp"
#include "support/plain_shapes.hpp"
#include "trime/core/error.hpp"
#include "trime/meshing/mesher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;
using shape::RegionShape;
using sweep::Method;
using testing::expect_certified;

/// Periodic along both axes.
class WavySize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 2 + sin_cos(2 * pi * p.x).sin + 0.5 * sin_cos(2 * pi * (p.x + p.y)).cos; }
};

MeshResult run(const comm::Communicator& comm, const RegionShape& shape, Method method, GlobalId points, bool graded) {
  Log log(LogLevel::silent, false);
  TimerTable timers;
  MeshOptions options;
  options.points = points;
  options.method = method;
  options.max_sweeps = 10;
  const sizing::UniformSize uniform;
  const WavySize wavy;
  const sizing::SizeField& size = graded ? static_cast<const sizing::SizeField&>(wavy) : uniform;
  return Mesher(comm, shape.domain(), size, options, log, timers).run();
}

TEST(PeriodicMesh, IsCertifiedAndTheSameEverywhere) {
  const comm::Communicator world = comm::Communicator::world();
  int number = 0;
  for (const RegionShape& shape : testing::periodic_shapes()) {
    SCOPED_TRACE("shape " + std::to_string(number++));
    const bool graded = number % 2 == 0;
    const Method method = number % 3 == 0 ? Method::cvd : number % 3 == 1 ? Method::distmesh : Method::hybrid;
    const MeshResult serial = run(comm::Communicator::self(), shape, method, 700, graded);
    const testing::OnThreads two(2);
    const MeshResult result = run(world, shape, method, 700, graded);
    expect_certified(result);
    EXPECT_EQ(result.mesh.hash, serial.mesh.hash);
    EXPECT_LE(result.mesh.point_slab.total, 700);
    EXPECT_GT(result.mesh.point_slab.total, 600);
    EXPECT_TRUE(std::ranges::equal(testing::gather_all(world, result.mesh.points), serial.mesh.points));
    EXPECT_EQ(testing::gather_all(world, global_triangles(result.mesh)), global_triangles(serial.mesh));
    EXPECT_TRUE(std::ranges::equal(testing::gather_all(world, result.mesh.size), serial.mesh.size));
    EXPECT_EQ(result.quality.size_std, serial.quality.size_std);
    for (const Vec2 p : result.mesh.points)
      EXPECT_EQ(p, shape.frame().periods().wrap(p));
  }
}

TEST(PeriodicMesh, TheWholeTorusHasTwoTrianglesAPoint) {
  const MeshResult result = run(comm::Communicator::world(), testing::whole_torus(), Method::hybrid, 500, true);
  expect_certified(result);
  EXPECT_EQ(result.mesh.triangle_slab.total, 2 * result.mesh.point_slab.total);
  EXPECT_EQ(result.mesh.facet_slab.total, 0);
}

TEST(PeriodicMesh, TooFewPointsAreRefusedWithTheNumberNeeded) {
  try {
    run(comm::Communicator::world(), testing::whole_torus(), Method::distmesh, 4, false);
    ADD_FAILURE() << "triangles reach around the torus";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("about 42 points are enough"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace trime::meshing
