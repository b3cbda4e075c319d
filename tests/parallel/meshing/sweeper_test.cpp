// SPDX-License-Identifier: BSD-3-Clause
// Sweeps whose stars are certified by the Delaunay lemma: every star is that of emptiness, after every sweep.
#include "support/distributed.hpp"
#include "support/plain_shapes.hpp"
#include "trime/core/simd_level.hpp"
#include "trime/geometry/shape.hpp"
#include "trime/meshing/mesher.hpp"

#include <gtest/gtest.h>

#include <string>

namespace trime::meshing {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Part;
using geometry::RegionShape;
using geometry::Vec2;

/// Finer towards one point.
class GradedSize final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.05 + geometry::length(p - Vec2{0.4, 0.3}); }
};

struct Case {
  std::string name;
  Frame frame;
  std::vector<Part> parts;
  std::string region;
  Start start = Start::automatic;
  Method method = Method::hybrid;
  bool graded = false;
};

MeshResult run(const comm::Communicator& comm, const Case& c, GlobalId points, bool verify) {
  const RegionShape shape(c.parts, c.region, c.frame);
  MeshOptions options;
  options.container = c.frame.container();
  options.points = points;
  options.method = c.method;
  options.start = c.start;
  options.max_sweeps = 40;
  options.cleanup = false;
  options.verify_stars = verify;
  const sizing::UniformSize uniform;
  const GradedSize graded;
  const sizing::SizeField& size = c.graded ? static_cast<const sizing::SizeField&>(graded) : uniform;
  return testing::mesh_silently(comm, shape.boundary(), size, options);
}

std::vector<Case> cases() {
  const Frame unit(Box{{0, 0}, {1, 1}}), torus(Box{{0, 0}, {1, 1}}, true, true);
  const Part disc = Part::circle("d", {0.5, 0.5}, 0.4, unit), hole = Part::circle("h", {0.55, 0.5}, 0.15, unit);
  return {{"square from a lattice", unit, {}, "domain"},
          {"square from quantiles", unit, {}, "domain", Start::hilbert, Method::cvd},
          {"ring by bars", unit, {disc, hole}, "difference(d, h)", Start::hilbert, Method::distmesh},
          {"graded ring", unit, {disc, hole}, "difference(d, h)", Start::automatic, Method::hybrid, true},
          {"torus", torus, {}, "domain", Start::hilbert, Method::hybrid}};
}

TEST(Sweeper, EveryStarIsRightAfterEverySweep) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    EXPECT_NO_THROW(run(comm::Communicator::world(), c, 4000, true));
  }
}

TEST(Sweeper, TheSameMeshOnEveryKindOfProcessor) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const std::uint64_t hash = run(comm::Communicator::world(), c, 3000, false).mesh.hash;
    for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2}) {
      limit_simd_level(level);
      EXPECT_EQ(run(comm::Communicator::world(), c, 3000, false).mesh.hash, hash);
    }
    limit_simd_level(SimdLevel::avx512);
  }
}

} // namespace
} // namespace trime::meshing
