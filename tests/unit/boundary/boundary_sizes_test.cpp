// SPDX-License-Identifier: BSD-3-Clause
// Sizes along the boundary from samples of the relative size, and limits that others imply.
#include "boundary/boundary_sizes.hpp"
#include "boundary/size_limits.hpp"
#include "support/boundary_shapes.hpp"
#include "support/laid_sites.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime::boundary {
namespace {

using geometry::Vec2;
using polygon::BoundarySites;

class Cone final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.2 + 0.3 * geometry::length(p - Vec2{0.3, 0.2}); }
};

TEST(SizeSamples, FollowTheFieldBetweenThem) {
  const geometry::Boundary boundary =
      testing::boundary_of({testing::polygon_loop({{0.1, 0.1}, {0.9, 0.2}, {0.7, 0.8}, {0.2, 0.9}})});
  const Cone relative;
  const sizing::ScaledSize asked(relative, 0.1, 0.025);
  const SizeSamples samples(boundary, relative, asked);
  EXPECT_TRUE(samples.serve(0.1));
  EXPECT_TRUE(samples.serve(0.08));
  EXPECT_FALSE(samples.serve(0.05));
  const BoundarySizes sampled(asked, asked, {samples, asked, nullptr, 1}), exact(asked, asked);
  SizeSamples::Cursor cursor, unused;
  for (std::size_t piece = 0; piece < 4; ++piece) {
    const geometry::Piece& on = boundary.loops[0].pieces[piece];
    for (int k = 0; k <= 100; ++k) {
      const double along = on.length() * k / 100;
      const BoundarySizes::PiecePlace place{0, static_cast<LocalIndex>(piece), along, on.length(), on.point(along)};
      const SizePair found = sampled.at(place, cursor);
      EXPECT_NEAR(found.size, exact.at(place, unused).size, 2e-3 * found.size);
      EXPECT_EQ(found.size, found.asked);
    }
  }
}

TEST(SizeLimits, LeaveOutWhatOthersImply) {
  // A channel that becomes narrow: the limits of its end reach far into it.
  const geometry::Boundary boundary =
      testing::boundary_of({testing::polygon_loop({{0.1, 0.1}, {0.5, 0.1}, {0.5, 0.11}, {0.3, 0.2}, {0.1, 0.4}})});
  const sizing::UniformSize size(0.1);
  const BoundarySites sites = testing::make_boundary_sites(boundary, size, testing::unit_lattice(), 30);
  const auto all = size_limits(sites, size, size, INFINITY), few = size_limits(sites, size, size, 0.2);
  ASSERT_FALSE(few.empty());
  EXPECT_LT(few.size(), all.size());
  const auto implied = [&](const std::vector<sizing::SizeLimit>& limits, Vec2 p) {
    double least = 0.1;
    for (const sizing::SizeLimit& limit : limits)
      least = std::fmin(least, limit.size + 0.2 * geometry::length(p - limit.place));
    return least;
  };
  for (const sizing::SizeLimit& limit : all)
    EXPECT_NEAR(implied(few, limit.place), implied(all, limit.place), 1e-15);
}

TEST(SizeLimits, EndWhereTheSizeMayNotBecomeLower) {
  // A slit far narrower than a twentieth of the size.
  const geometry::Boundary boundary = testing::boundary_of({testing::polygon_loop(
      {{0.1, 0.1}, {0.5, 0.1}, {0.5, 0.3}, {0.501, 0.3}, {0.501, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}})});
  const sizing::UniformSize asked(0.1);
  std::vector<sizing::SizeLimit> limits;
  std::size_t more = 1;
  for (int round = 0; round < 4 && more > 0; ++round) {
    const sizing::LoweredSize size(asked, {{limits, 0.2}}, boundary.periods);
    const auto found =
        size_limits(testing::make_boundary_sites(boundary, size, testing::unit_lattice(), 30), size, asked, 0.2);
    for (const sizing::SizeLimit& limit : found) {
      EXPECT_GE(limit.size, 0.05 * 0.1);
      EXPECT_LT(limit.size, 0.95 * size.size(limit.place));
    }
    limits.insert(limits.end(), found.begin(), found.end());
    more = found.size();
  }
  EXPECT_FALSE(limits.empty());
  EXPECT_EQ(more, 0u);
}

} // namespace
} // namespace trime::boundary
