// SPDX-License-Identifier: BSD-3-Clause
// Sites that ranks lay together on a boundary are those that one lays alone, bit for bit.
#include "boundary/boundary_refiner.hpp"

#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trime::boundary {
namespace {

using geometry::Vec2;
using polygon::BoundarySites;

/// Small in one corner.
class Graded : public sizing::SizeField {
public:
  explicit Graded(double h) : h_(h) {}
  double size(Vec2 p) const override { return h_ * (0.2 + geometry::length(p - Vec2{0.2, 0.1})); }

private:
  double h_;
};

BoundarySites lay_together(const comm::Communicator& comm, const geometry::Boundary& boundary,
                           const sizing::SizeField& size, const FeatureRule& rule) {
  return make_boundary_sites(comm, [&] {
    static const geometry::InnerCurves none;
    const auto curves = std::make_shared<const LaidCurves>(boundary, none);
    return std::make_unique<BoundaryRefiner>(curves, BoundarySizes(size, size), testing::unit_lattice(),
                                             LayoutRequest{30, {}, {}, rule, std::numeric_limits<std::size_t>::max()});
  });
}

void expect_same(const BoundarySites& together, const BoundarySites& alone) {
  EXPECT_EQ(together.loop_start, alone.loop_start);
  EXPECT_EQ(together.halvings, alone.halvings);
  EXPECT_EQ(together.rounds, alone.rounds);
  EXPECT_EQ(together.corners, alone.corners);
  EXPECT_EQ(together.left_out, alone.left_out);
  ASSERT_EQ(together.sites.size(), alone.sites.size());
  for (std::size_t k = 0; k < alone.sites.size(); ++k) {
    EXPECT_EQ(together.sites[k].position, alone.sites[k].position);
    EXPECT_EQ(together.sites[k].next, alone.sites[k].next);
    EXPECT_EQ(together.sites[k].corner, alone.sites[k].corner);
  }
}

/// A coast of many short pieces, an arrow with a sharp tip, and a circle.
geometry::Boundary many_kinds() {
  std::vector<Vec2> coast;
  for (int k = 0; k < 700; ++k) {
    const double angle = 2 * pi * k / 700, radius = 0.45 + 0.01 * std::sin(97.0 * k) + 0.02 * std::cos(31.0 * k);
    coast.push_back({0.5 + radius * sin_cos(angle).cos, 0.5 + radius * sin_cos(angle).sin});
  }
  return testing::boundary_of({testing::polygon_loop(coast),
                               testing::polygon_loop({{0.3, 0.3}, {0.32, 0.5}, {0.7, 0.31}, {0.33, 0.42}}),
                               testing::circle_loop({0.6, 0.6}, 0.1, true)});
}

TEST(SharedLayout, DoesNotDependOnTheRanks) {
  const comm::Communicator world = comm::Communicator::world();
  const geometry::Boundary boundary = many_kinds();
  for (const double h : {0.1, 0.02, 0.004})
    for (const double tolerance : {0.0, 0.25}) {
      const FeatureRule rule{tolerance, 3};
      const Graded size(h);
      expect_same(lay_together(world, boundary, size, rule),
                  testing::make_boundary_sites(boundary, size, testing::unit_lattice(), 30, {}, rule));
    }
}

TEST(SharedLayout, OneCurveIsSharedToo) {
  const comm::Communicator world = comm::Communicator::world();
  const geometry::Boundary circle = testing::boundary_of({testing::circle_loop({0.5, 0.5}, 0.4)});
  for (const double h : {2.0, 0.3, 0.001})
    expect_same(lay_together(world, circle, sizing::UniformSize(h), {}),
                testing::make_boundary_sites(circle, sizing::UniformSize(h), testing::unit_lattice(), 30));
}

TEST(SharedLayout, ErrorsOfOneRankAreThrownByAll) {
  const comm::Communicator world = comm::Communicator::world();
  const geometry::Boundary circle = testing::boundary_of({testing::circle_loop({0.5, 0.5}, 0.4)});
  EXPECT_THROW(lay_together(world, circle, sizing::UniformSize(1e-13), {}), GeometryError);
  const bool fails = world.rank() == world.size() - 1;
  EXPECT_THROW(lay_together(world, circle, sizing::UniformSize(fails ? -1 : 0.1), {}), GeometryError);
}

} // namespace
} // namespace trime::boundary
