// SPDX-License-Identifier: BSD-3-Clause
// Sites on curves inside a shape that move along their curves.
#include "polygon/inner_chords.hpp"

#include "core/angle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trime::polygon {
namespace {

using geometry::LossReason;
using geometry::Vec2;

constexpr double radius = 0.25;
constexpr Vec2 center{0.5, 0.5};

Vec2 on_circle(double angle) {
  return center + radius * Vec2{std::cos(angle), std::sin(angle)};
}

/// A ring counter-clockwise around region 1 with these angles, in region 0.
InnerChords ring(const std::vector<double>& angles) {
  InnerChords inner;
  std::vector<Vec2> places;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    places.push_back(on_circle(angles[k]));
    inner.chords.push_back({{places.back(), on_circle(angles[(k + 1) % angles.size()])}, -1, 1, 0});
  }
  std::sort(places.begin(), places.end(), geometry::lexicographically_less);
  inner.sites = places;
  inner.corner.assign(places.size(), 0);
  inner.track.assign(places.size(), 0);
  inner.circles = {{center, radius, 1, 0}};
  inner.sort_ends();
  return inner;
}

double area_of(const InnerChords& inner) {
  double area = 0;
  for (const InnerChord& chord : inner.chords)
    area += 0.5 * geometry::cross(chord.ends.a - center, chord.ends.b - center);
  return area;
}

/// The loss of the disc to the rest.
geometry::RegionLoss loss_of(const InnerChords& inner) {
  const double lost = pi * radius * radius - area_of(inner);
  return {1, 0, LossReason::chords, lost, 1, lost, on_circle(0)};
}

TEST(InnerChords, FollowTheirSitesAlongACircle) {
  const std::vector<double> angles{0, 1, 2, 3, 4, 5};
  InnerChords inner = ring(angles);
  inner.losses = {loss_of(inner)};
  const std::vector<InnerMove> moves{{inner.index_of(on_circle(1)), on_circle(1.25)},
                                     {inner.index_of(on_circle(2)), on_circle(2.375)},
                                     {inner.index_of(on_circle(5)), on_circle(5.5)}};
  inner.move_sites(moves);
  const InnerChords expected = ring({0, 1.25, 2.375, 3, 4, 5.5});
  EXPECT_EQ(inner.sites, expected.sites);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    EXPECT_EQ(inner.chords[k].ends.a, expected.chords[k].ends.a);
    EXPECT_EQ(inner.chords[k].ends.b, expected.chords[k].ends.b);
  }
  for (const Vec2 p : inner.sites)
    EXPECT_EQ(inner.at(p).size(), 2U);
  EXPECT_NEAR(inner.losses[0].area, loss_of(inner).area, 1e-15);
  EXPECT_EQ(inner.losses[0].largest, inner.losses[0].area);
  EXPECT_EQ(inner.losses[0].loser, 1);
}

/// The disc loses a small area to the rest; a move gives the disc more than that, so that the rest is the loser then.
TEST(InnerChords, ExchangeLoserAndWinner) {
  InnerChords inner = ring({0, 1, 2, 3, 4, 5});
  const double before = area_of(inner);
  inner.losses = {{1, 0, LossReason::chords, 1e-6, 1, 1e-6, {}}};
  const std::vector<InnerMove> moves{{inner.index_of(on_circle(0)), on_circle(-0.125)}};
  inner.move_sites(moves);
  const double gain = area_of(inner) - before;
  ASSERT_GT(gain, 1e-4);
  EXPECT_EQ(inner.losses[0].loser, 0);
  EXPECT_EQ(inner.losses[0].winner, 1);
  EXPECT_NEAR(inner.losses[0].area, gain - 1e-6, 1e-15);
}

TEST(InnerChords, KeepTheMarksOfTheirSites) {
  InnerChords inner = ring({0, 1, 2, 3, 4, 5});
  inner.circles.clear();
  inner.track.assign(6, InnerChords::held);
  const LocalIndex mover = inner.index_of(on_circle(2)), corner = inner.index_of(on_circle(3));
  inner.track[static_cast<std::size_t>(mover)] = InnerChords::straight;
  inner.corner[static_cast<std::size_t>(corner)] = 1;
  const Vec2 to = on_circle(2.9);
  inner.move_sites(std::vector<InnerMove>{{mover, to}});
  ASSERT_GE(inner.index_of(to), 0);
  EXPECT_EQ(inner.track[static_cast<std::size_t>(inner.index_of(to))], InnerChords::straight);
  EXPECT_TRUE(inner.is_corner(on_circle(3)));
  EXPECT_EQ(inner.index_of(on_circle(2)), -1);
}

} // namespace
} // namespace trime::polygon
