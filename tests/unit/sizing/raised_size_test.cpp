// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/raised_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trime::sizing {
namespace {

using geometry::Vec2;

class Slope final : public SizeField {
public:
  double size(Vec2 p) const override { return p.y < 0 ? std::numeric_limits<double>::quiet_NaN() : 0.1 + 0.05 * p.x; }
};

const std::vector<LeastSize> places{{{0.2, 0.5}, 0.3}, {{0.7, 0.5}, 0.2}, {{0.72, 0.5}, 0.15}, {{0.9, 0.1}, 0.01}};

TEST(RaisedSize, IsTheLargestOfTheFieldAndTheConesBelowThePlaces) {
  const Slope field;
  const RaisedSize raised(field, places, 0.4, {});
  for (int k = 0; k < 500; ++k) {
    const Vec2 p{std::fmod(0.5 + 0.618034 * k, 1), std::fmod(0.25 + 0.754878 * k, 1)};
    double expected = field.size(p);
    for (const LeastSize& least : places)
      expected = std::fmax(expected, least.size - 0.4 * geometry::length(p - least.place));
    EXPECT_NEAR(raised.size(p), expected, 1e-15) << p.x << " " << p.y;
  }
  EXPECT_EQ(raised.size({0.2, 0.5}), 0.3);
  EXPECT_EQ(raised.size({0.9, 0.9}), field.size({0.9, 0.9}));
}

TEST(RaisedSize, InvalidSizesOfTheFieldStayInvalid) {
  const Slope field;
  EXPECT_TRUE(std::isnan(RaisedSize(field, places, 0.4, {}).size({0.2, -0.1})));
}

TEST(RaisedSize, RaisesAcrossThePeriod) {
  const UniformSize field(0.1);
  const geometry::Periods periods{1, 0, {0, 0}};
  const RaisedSize raised(field, {{{0.95, 0.5}, 0.2}}, 0.5, periods);
  EXPECT_NEAR(raised.size({0.05, 0.5}), 0.15, 1e-15);
}

} // namespace
} // namespace trime::sizing
