// SPDX-License-Identifier: BSD-3-Clause
// Sites where parts of the shape meet: corners, however little the boundary turns there.
#include "support/laid_sites.hpp"

#include "support/boundary_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::boundary {
namespace {

using geometry::Boundary;
using polygon::BoundarySite;
using polygon::BoundarySites;
using sizing::UniformSize;
using testing::boundary_of;
using testing::polygon_loop;
using testing::unit_lattice;

/// A square of two parts, whose boundary turns by so much where they meet.
Boundary square_of_two_parts(double degrees) {
  geometry::Loop loop = polygon_loop({{0.1, 0.1},
                                      {0.5, 0.1 + 0.4 * std::tan(degrees * (3.14159265358979 / 180))},
                                      {0.9, 0.1},
                                      {0.9, 0.9},
                                      {0.1, 0.9}});
  loop.pieces[1].part = 1;
  loop.pieces[2].part = 1;
  return boundary_of({loop});
}

TEST(MeetingParts, AreCornersHoweverLittleTheyTurn) {
  for (const double degrees : {0.0, 3.0}) {
    const Boundary boundary = square_of_two_parts(degrees);
    const BoundarySites result = testing::make_boundary_sites(boundary, UniformSize(0.093), unit_lattice(), 30);
    for (const std::size_t meeting : {1, 3})
      EXPECT_TRUE(std::ranges::any_of(result.sites,
                                      [&](const BoundarySite& site) {
                                        return site.corner && site.position == boundary.loops[0].pieces[meeting].start;
                                      }))
          << degrees << " degrees, piece " << meeting;
    EXPECT_EQ(result.corners, 5);
    EXPECT_EQ(result.left_out, 0);
  }
}

TEST(MeetingParts, BelowTheResolutionMayBeLeftOutAndAreCounted) {
  geometry::Loop loop = polygon_loop({{0.1, 0.1}, {0.5, 0.1}, {0.5002, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}});
  loop.pieces[1].part = 1;
  const Boundary boundary = boundary_of({loop});
  const BoundarySites result =
      testing::make_boundary_sites(boundary, UniformSize(0.093), unit_lattice(), 30, {}, {0.1, 3});
  EXPECT_EQ(result.corners, 4);
  EXPECT_EQ(result.left_out, 2);
}

} // namespace
} // namespace trime::boundary
