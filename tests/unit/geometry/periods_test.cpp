// SPDX-License-Identifier: BSD-3-Clause
// Images are exact: wrapping any image gives back the canonical point, bit for bit.
#include "core/random.hpp"
#include "trime/geometry/lattice.hpp"

#include <gtest/gtest.h>

namespace trime::geometry {
namespace {

const Box container{{-1.7, 0.3}, {2.1, 1.4}}; // off the lattice on purpose

TEST(Periods, NothingMovesWithoutThem) {
  const Periods none = Frame(container).periods();
  EXPECT_FALSE(none.any());
  EXPECT_EQ(none.wrap({-9, 9}), (Vec2{-9, 9}));
  EXPECT_EQ(none.nearest_image({-9, 9}, {0, 0}), (Vec2{-9, 9}));
}

TEST(Periods, AreLatticeMultiplesWithinAStepOfTheSides) {
  const Frame frame(container, true, true);
  const Periods& periods = frame.periods();
  for (const double v : {periods.x, periods.y, periods.min.x, periods.min.y})
    EXPECT_EQ(frame.lattice().snap(v), v);
  EXPECT_NEAR(periods.x, container.width(), frame.step());
  EXPECT_NEAR(periods.y, container.height(), frame.step());
}

TEST(Periods, EveryImageWrapsToTheCanonicalPoint) {
  const Frame frame(container, true, true);
  const Periods& periods = frame.periods();
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const Vec2 p = periods.wrap(
        frame.lattice().snap(container.min + Vec2{container.width() * random_unit(1, RandomPurpose::test, k, 0),
                                                  container.height() * random_unit(1, RandomPurpose::test, k, 1)}));
    EXPECT_TRUE(p.x >= periods.min.x && p.x < periods.min.x + periods.x);
    EXPECT_TRUE(p.y >= periods.min.y && p.y < periods.min.y + periods.y);
    for (const int i : {-3, -1, 0, 1, 2})
      for (const int j : {-2, 0, 1}) {
        const Vec2 image = p + Vec2{i * periods.x, j * periods.y};
        EXPECT_EQ(periods.wrap(image), p);
        EXPECT_TRUE(periods.same_point(image, p));
        const Vec2 near = periods.nearest_image(image, p);
        EXPECT_EQ(near, p);
      }
  }
}

TEST(Periods, TheBordersAreOneLine) {
  const Frame frame(container, true, false);
  const Periods& periods = frame.periods();
  EXPECT_EQ(periods.wrap({periods.min.x + periods.x, 1}), (Vec2{periods.min.x, 1}));
  EXPECT_EQ(periods.wrap({periods.min.x, 77}), (Vec2{periods.min.x, 77}));
  EXPECT_TRUE(periods.less({periods.min.x + periods.x, 1}, {periods.min.x + frame.step(), 1}));
}

TEST(Periods, TheNearestImageIsAtMostHalfAPeriodAway) {
  const Frame frame(container, true, true);
  const Periods& periods = frame.periods();
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const auto at = [&](std::uint64_t slot) {
      return frame.lattice().snap(9 * random_unit(2, RandomPurpose::test, k, slot) - 4);
    };
    const Vec2 p{at(0), at(1)}, center{at(2), at(3)}, near = periods.nearest_image(p, center);
    EXPECT_TRUE(periods.same_point(near, p));
    EXPECT_LE(std::abs(near.x - center.x), 0.5 * periods.x);
    EXPECT_LE(std::abs(near.y - center.y), 0.5 * periods.y);
  }
}

} // namespace
} // namespace trime::geometry
