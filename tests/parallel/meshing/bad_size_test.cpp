// SPDX-License-Identifier: BSD-3-Clause
// Size fields that fail: an error with place and value, on all ranks together, whoever meets it.
#include "support/distributed.hpp"
#include "support/plain_shapes.hpp"
#include "trime/core/error.hpp"
#include "trime/core/formula.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/shape/region_shape.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace trime::meshing {
namespace {

using geometry::Vec2;
using start::Start;
using sweep::Method;

MeshOptions with_points(GlobalId points, Start start = Start::automatic) {
  MeshOptions options;
  options.points = points;
  options.method = Method::distmesh;
  options.start = start;
  options.max_sweeps = 12;
  return options;
}

MeshResult run(const comm::Communicator& comm, const sizing::SizeField& size, const MeshOptions& options) {
  return testing::mesh_silently(comm, testing::square().domain(), size, options);
}

/// The message of an error of this class, on every rank; empty if there was none.
template <class Expected>
std::string error_of(const comm::Communicator& comm, const sizing::SizeField& size, const MeshOptions& options) {
  std::string message;
  try {
    run(comm, size, options);
  } catch (const Expected& error) {
    message = error.what();
  }
  comm.barrier(); // nobody is left behind in a collective
  return message;
}

/// A value of its own in a disc inside.
class SpottedSize final : public sizing::SizeField {
public:
  SpottedSize(double in_spot, double radius) : in_spot_(in_spot), radius_(radius) {}
  double size(Vec2 p) const override { return geometry::length(p - Vec2{0.31, 0.7323}) < radius_ ? in_spot_ : 1 + p.x; }

private:
  double in_spot_, radius_;
};

TEST(BadSize, IsNamedWithItsPlaceWhereverTheMesherMeetsIt) {
  const comm::Communicator world = comm::Communicator::world();
  for (const double bad : {std::nan(""), 0.0, -1.0, std::numeric_limits<double>::infinity()})
    for (const Start start : {Start::automatic, Start::hilbert}) {
      const SpottedSize size(bad, 0.1);
      const std::string message = error_of<GeometryError>(world, size, with_points(500, start));
      EXPECT_NE(message.find(fmt::format("expected a positive finite size, found {}", bad)), std::string::npos)
          << bad << ": " << message;
      EXPECT_NE(message.find("the size field at (0."), std::string::npos) << message;
    }
}

TEST(BadSize, SoSmallThatNoNumberOfPointsWouldDo) {
  const comm::Communicator world = comm::Communicator::world();
  const SpottedSize size(1e-14, 0.01); // between the places that the first guess is made from
  EXPECT_NE(error_of<GeometryError>(world, size, with_points(500)).find("such a small size"), std::string::npos);
}

TEST(BadSize, UniformOnes) {
  const comm::Communicator world = comm::Communicator::world();
  for (const double bad : {std::nan(""), 0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_NE(error_of<GeometryError>(world, sizing::UniformSize(bad), with_points(100)).find("positive finite size"),
              std::string::npos)
        << bad;
}

TEST(BadSize, AFormulaThatFailsBetweenThePointsOfItsGrid) {
  const comm::Communicator world = comm::Communicator::world();
  const Formula formula("(x-0.31)^2+(y-0.3323)^2 < 0.00001 ? -1 : 1", "test");
  const sizing::ExpressionSize size(formula, {{0.1, 0.1}, {0.9, 0.9}});
  MeshOptions options = with_points(20000); // fine enough to meet the spot
  options.max_sweeps = 2;
  const std::string message = error_of<GeometryError>(world, size, options);
  EXPECT_NE(message.find("the size field at (0.3"), std::string::npos) << message;
  EXPECT_NE(message.find("found -1"), std::string::npos) << message;
}

/// Throws at the n-th call on the last rank alone.
class ThrowingSize final : public sizing::SizeField {
public:
  ThrowingSize(bool throws, int calls) : throws_(throws), calls_left_(calls) {}
  double size(Vec2 p) const override {
    if (throws_ && --calls_left_ <= 0)
      throw std::runtime_error("no size today");
    return 1 + p.x;
  }

private:
  bool throws_;
  mutable std::atomic<int> calls_left_;
};

TEST(BadSize, AnExceptionOnOneRankEndsAll) {
  const comm::Communicator world = comm::Communicator::world();
  for (const int calls : {1, 300, 1500, 2500})
    for (const Start start : {Start::automatic, Start::hilbert}) {
      const ThrowingSize size(world.rank() == world.size() - 1, calls);
      EXPECT_NE(error_of<Error>(world, size, with_points(500, start)).find("no size today"), std::string::npos)
          << calls;
    }
}

TEST(BadSize, AnEdgeLengthOutsideItsBounds) {
  const comm::Communicator world = comm::Communicator::world();
  const SpottedSize graded(1.3, 0.1);
  const sizing::UniformSize uniform;
  for (const sizing::SizeField* size :
       {static_cast<const sizing::SizeField*>(&graded), static_cast<const sizing::SizeField*>(&uniform)}) {
    MeshOptions options = with_points(500);
    options.points.reset();
    options.edge_length = 0.03;
    options.max_size = 0.01;
    EXPECT_NE(error_of<ConfigError>(world, *size, options).find("max_size = 0.01"), std::string::npos);
    options.max_size.reset();
    options.min_size = 0.1;
    EXPECT_NE(error_of<ConfigError>(world, *size, options).find("min_size = 0.1"), std::string::npos);
  }
}

} // namespace
} // namespace trime::meshing
