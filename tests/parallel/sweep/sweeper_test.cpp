// SPDX-License-Identifier: BSD-3-Clause
// Sweeps whose stars are certified by the Delaunay lemma: every star is that of emptiness, after every sweep.
#include "core/simd_level.hpp"
#include "support/distributed.hpp"
#include "support/plain_shapes.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <string>

namespace trime::sweep {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Vec2;
using meshing::MeshOptions;
using meshing::MeshResult;
using shape::Part;
using shape::RegionShape;
using start::Start;

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
  bool graded = false, cleanup = false;
};

enum class Stars { by_lemma, verified, by_emptiness };

MeshResult run(const comm::Communicator& comm, const Case& c, GlobalId points, Stars stars) {
  const RegionShape shape(c.parts, c.region, c.frame);
  MeshOptions options;
  options.points = points;
  options.method = c.method;
  options.start = c.start;
  options.max_sweeps = 40;
  options.cleanup = c.cleanup;
  options.star_tests.verify = stars == Stars::verified;
  options.star_tests.by_emptiness = stars == Stars::by_emptiness;
  const sizing::UniformSize uniform;
  const GradedSize graded;
  const sizing::SizeField& size = c.graded ? static_cast<const sizing::SizeField&>(graded) : uniform;
  return testing::mesh_silently(comm, shape.domain(), size, options);
}

std::vector<Case> cases() {
  const Frame unit(Box{{0, 0}, {1, 1}}), torus(Box{{0, 0}, {1, 1}}, true, true);
  const Part disc = Part::circle("d", {0.5, 0.5}, 0.4, unit), hole = Part::circle("h", {0.55, 0.5}, 0.15, unit);
  const Part bar = Part::rectangle("b", Box{{0.03, 0.46}, {0.97, 0.5}}, unit),
             notch = Part::triangle("n", {Vec2{0.49, 0.67}, Vec2{0.52, 0.95}, Vec2{0.2, 0.95}},
                                    unit); // a thin bridge above the hole
  return {{"square from a lattice", unit, {}, "domain"},
          {"square from quantiles", unit, {}, "domain", Start::hilbert, Method::cvd},
          {"ring by bars", unit, {disc, hole}, "difference(d, h)", Start::hilbert, Method::distmesh},
          {"graded ring", unit, {disc, hole}, "difference(d, h)", Start::automatic, Method::hybrid, true},
          {"graded boolean",
           unit,
           {disc, hole, bar, notch},
           "difference(union(d, b), union(h, n))",
           Start::automatic,
           Method::hybrid,
           true,
           true},
          {"torus", torus, {}, "domain", Start::hilbert, Method::hybrid}};
}

TEST(Sweeper, EveryStarIsRightAfterEverySweep) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    EXPECT_NO_THROW(run(comm::Communicator::world(), c, 4000, Stars::verified));
  }
}

/// Whichever certificate was used for a star, in the sweeps or after them.
TEST(Sweeper, TheSameMeshIfAllStarsAreCertifiedByEmptiness) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const MeshResult by_lemma = run(comm::Communicator::world(), c, 3000, Stars::by_lemma);
    const MeshResult by_emptiness = run(comm::Communicator::world(), c, 3000, Stars::by_emptiness);
    EXPECT_EQ(by_lemma.mesh.hash, by_emptiness.mesh.hash);
    EXPECT_EQ(by_lemma.history.back().sweep, by_emptiness.history.back().sweep);
    EXPECT_EQ(by_lemma.history.back().mean_alpha, by_emptiness.history.back().mean_alpha);
  }
}

TEST(Sweeper, TheSameMeshOnEveryKindOfProcessor) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const std::uint64_t hash = run(comm::Communicator::world(), c, 3000, Stars::by_lemma).mesh.hash;
    for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2}) {
      limit_simd_level(level);
      EXPECT_EQ(run(comm::Communicator::world(), c, 3000, Stars::by_lemma).mesh.hash, hash);
    }
    limit_simd_level(SimdLevel::avx512);
  }
}

} // namespace
} // namespace trime::sweep
