// SPDX-License-Identifier: BSD-3-Clause
// The container goes with the shape: any container gives a certified mesh, and what does not belong together is an
// error on all ranks.
#include "support/plain_shapes.hpp"
#include "trime/core/error.hpp"
#include "trime/meshing/mesher.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace trime::meshing {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Vec2;
using shape::Part;
using shape::RegionShape;

MeshOptions small() {
  MeshOptions options;
  options.points = 400;
  options.method = sweep::Method::distmesh;
  options.max_sweeps = 20;
  return options;
}

MeshResult run(const geometry::Domain& domain) {
  return testing::mesh_silently(comm::Communicator::world(), domain, sizing::UniformSize(), small());
}

RegionShape rectangle(const Box& box, const Frame& frame) {
  return {{Part::rectangle("plate", box, frame)}, "plate", frame};
}

/// Negative in a disc around (500, 250).
class Disc final : public tracing::Shape {
public:
  double signed_distance(Vec2 p) const override { return geometry::length(p - Vec2{500, 250}) - 200; }
};

/// The message of a GeometryError, if it is the same on all ranks.
std::string error_of(const std::function<void()>& work) {
  const comm::Communicator world = comm::Communicator::world();
  std::string message;
  try {
    work();
  } catch (const GeometryError& error) {
    message = error.what();
  }
  EXPECT_EQ(world.broadcast(message), message) << "each rank has the error";
  return message;
}

bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

TEST(MeshedDomain, AnyContainerWillDo) {
  const Frame wide({{0, 0}, {1000, 500}}), two({{0, 0}, {2, 2}});
  for (const RegionShape& shape :
       {rectangle({{50, 50}, {950, 450}}, wide), rectangle({{0.2, 0.2}, {1.5, 1.5}}, two),
        rectangle({{0.9, 0.9}, {1.1, 1.1}}, two), rectangle({{0.2, 0.2}, {0.8, 0.8}}, two)}) {
    const MeshResult result = run(shape.domain());
    testing::expect_certified(result);
    EXPECT_GT(result.mesh.point_slab.total, 380);
    EXPECT_LT(result.quality.alpha.max, 3);
  }
}

TEST(MeshedDomain, AFunctionIsTracedInTheContainer) {
  const comm::Communicator world = comm::Communicator::world();
  const MeshResult result = run(traced_domain(world, Disc(), Frame({{0, 0}, {1000, 500}})));
  testing::expect_certified(result);
  const std::string elsewhere = error_of([&] { run(traced_domain(world, Disc(), Frame(geometry::unit_square))); });
  EXPECT_TRUE(says(elsewhere, "or outside of the container [0, 1] x [0, 1]?")) << elsewhere;
}

TEST(MeshedDomain, WhatDoesNotBelongTogetherIsAnErrorOnAllRanks) {
  const Frame wide({{0, 0}, {1000, 500}}), unit(geometry::unit_square);
  const RegionShape shape = rectangle({{50, 50}, {950, 450}}, wide), small = testing::square();
  const std::string outside = error_of([&] { run(geometry::Domain(unit, shape.boundary())); });
  EXPECT_TRUE(says(outside, "leaves the container [0, 1] x [0, 1]")) << outside;
  EXPECT_TRUE(says(outside, "use the frame in which the shape was made")) << outside;
  const std::string lattice = error_of([&] { run(geometry::Domain(wide, small.boundary())); });
  EXPECT_TRUE(says(lattice, "expected vertices on its lattice")) << lattice;
  RegionShape fixed = testing::square();
  fixed.set_fixed_points({{{50, 0.5}, "list.xy:3"}});
  const std::string point = error_of([&] { run(fixed.domain()); });
  EXPECT_TRUE(says(point, "list.xy:3: the fixed point (50, 0.5) lies outside the container")) << point;
}

} // namespace
} // namespace trime::meshing
