// SPDX-License-Identifier: BSD-3-Clause
// The list of the worst triangles: the same however the triangles are shared out, and which a sharp corner excuses.
#include "extraction/extraction.hpp"
#include "extraction/mesh_quality.hpp"
#include "support/laid_sites.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

namespace trime::extraction {
namespace {

using geometry::Vec2;
using mesh::BadTriangle;

/// Triangle number k of many: some are equally bad, a third are excused.
BadTriangle triangle(int k) {
  return {2.0 + k * 7 % 31, {0.01 * (k * 13 % 40), 0.02 * k}, k % 3 == 0 ? 20.0 : 0.0, {0.5, 0.5}, 95, k % 4 == 0};
}

TEST(BadTriangles, AreTheSameHoweverTheyAreSharedOut) {
  const comm::Communicator comm = comm::Communicator::world();
  constexpr int count = 100;
  BadTriangles alone, shared, other_thread;
  for (int k = 0; k < count; ++k) {
    alone.add(triangle(k));
    if ((k * 5 + 1) % comm.size() == comm.rank())
      (k % 2 == 0 ? shared : other_thread).add(triangle(count - 1 - k));
  }
  shared.merge(other_thread);
  const BadTriangles::Counts own = shared.counts();
  shared.gather(comm, {comm.sum(own.bad), comm.sum(own.obtuse), comm.sum(own.obtuse_at_corners)});
  mesh::QualitySummary expected, found;
  alone.tell(expected);
  shared.tell(found);
  EXPECT_EQ(found.bad_triangles, 96) << "alpha is 2 for four of them, which is not above 2";
  EXPECT_EQ(found.obtuse_triangles, 25);
  EXPECT_EQ(found.obtuse_at_corners, 9) << "those with a number that 12 divides";
  ASSERT_EQ(found.worst_triangles.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_EQ(found.worst_triangles[k].alpha, expected.worst_triangles[k].alpha);
    EXPECT_EQ(found.worst_triangles[k].place, expected.worst_triangles[k].place);
  }
  EXPECT_EQ(found.worst_away.place, expected.worst_away.place);
  EXPECT_EQ(found.worst_away.corner_degrees, 0);
  EXPECT_EQ(found.worst_triangles[0].alpha, 32);
}

TEST(BadTriangles, NoneIsNoneOnEveryRank) {
  mesh::QualitySummary quality;
  BadTriangles none;
  none.gather(comm::Communicator::world(), {});
  none.tell(quality);
  EXPECT_EQ(quality.bad_triangles, 0);
  EXPECT_TRUE(quality.worst_triangles.empty());
  const mesh::Check good = worst_alpha_check(quality, 5);
  EXPECT_TRUE(good.passed);
  EXPECT_EQ(good.found, 1);
  quality.worst_away.alpha = 5.5;
  EXPECT_FALSE(worst_alpha_check(quality, 5).passed);
  EXPECT_TRUE(worst_alpha_check(quality, 6).passed);
}

TEST(BadTriangles, ObtuseOnesAreCountedAndListedHoweverGoodTheyAre) {
  const comm::Communicator comm = comm::Communicator::world();
  const geometry::Frame frame(geometry::Box{{0, 0}, {1, 1}});
  const shape::RegionShape square({shape::Part::rectangle("square", {{0, 0}, {1, 1}}, frame)}, "square", frame);
  const sizing::UniformSize size(0.125);
  const auto sites = testing::make_boundary_sites(square.boundary(), size, frame.lattice(), 32);
  const geometry::Periods periods{};
  const SharpCorners corners(sites, periods);
  QualityMeter meter(size, periods, corners);
  std::vector<float> alpha(3), beta(3);
  meter.write_to(alpha, beta);
  const double step = frame.lattice().step();
  if (comm.rank() == comm.size() - 1) {
    meter.add_triangle({0.25, 0.25}, {0.5, 0.25}, {0.25, 0.5});        // a right angle
    meter.add_triangle({0.25, 0.25}, {0.5, 0.25}, {0.25 - step, 0.5}); // one lattice step more
    meter.add_triangle({0.25, 0.25}, {0.5, 0.25}, {0.25 + step, 0.5}); // one less
    meter.finish();
  }
  const mesh::QualitySummary quality = summarize(comm, meter.sums());
  EXPECT_EQ(quality.bad_triangles, 0);
  EXPECT_EQ(quality.obtuse_triangles, 1);
  EXPECT_EQ(quality.obtuse_at_corners, 0);
  ASSERT_EQ(quality.worst_triangles.size(), 1u);
  EXPECT_EQ(quality.worst_triangles[0].obtuse, 1);
  EXPECT_NEAR(quality.worst_triangles[0].largest_degrees, 90, 1e-9);
  EXPECT_EQ(quality.worst_away.alpha, 0);
}

TEST(SharpCorners, ExcuseTrianglesWithinThreeOfTheirEdges) {
  const geometry::Frame frame(geometry::Box{{0, 0}, {1, 1}});
  const shape::RegionShape wedge(
      {shape::Part::triangle("wedge", {Vec2{0.125, 0.25}, {0.875, 0.25}, {0.875, 0.5}}, frame)}, "wedge", frame);
  const sizing::UniformSize size(0.05);
  const auto sites = testing::make_boundary_sites(wedge.boundary(), size, frame.lattice(), 30);
  const SharpCorners corners(sites, wedge.boundary().periods);
  const auto at_tip = corners.near({0.125, 0.25}, {0.2, 0.25}, {0.2, 0.26});
  EXPECT_EQ(at_tip.place, (Vec2{0.125, 0.25}));
  EXPECT_NEAR(at_tip.degrees, 18.4349, 1e-3);
  EXPECT_GT(corners.near({0.25, 0.26}, {0.3, 0.26}, {0.3, 0.28}).degrees, 0) << "2.4 edges away";
  EXPECT_EQ(corners.near({0.3, 0.26}, {0.35, 0.26}, {0.35, 0.28}).degrees, 0) << "3.3 edges away";
  EXPECT_EQ(corners.near({0.875, 0.25}, {0.8, 0.25}, {0.85, 0.26}).degrees, 0) << "a right angle excuses nothing";
}

} // namespace
} // namespace trime::extraction
