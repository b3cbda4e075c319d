// SPDX-License-Identifier: BSD-3-Clause
// The smallest one of several sizes.
#include "sizing/minimum_size.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace trime::sizing {
namespace {

/// a + b x, which is not positive everywhere.
class LinearSize final : public SizeField {
public:
  LinearSize(double a, double b) : a_(a), b_(b) {}
  double size(geometry::Vec2 p) const override { return a_ + b_ * p.x; }
  bool jumps() const override { return b_ > 10; }

private:
  double a_, b_;
};

TEST(MinimumSize, IsTheSmallestOneAndNamesIt) {
  const LinearSize falling(2, -1), rising(1, 1);
  const UniformSize level(1.4);
  const MinimumSize smallest({&falling, &rising, &level});
  EXPECT_EQ(smallest.size({0, 0}), 1);
  EXPECT_EQ(smallest.smallest_field({0, 0}), 1U);
  EXPECT_EQ(smallest.size({0.5, 0}), 1.4);
  EXPECT_EQ(smallest.smallest_field({0.5, 0}), 2U);
  EXPECT_EQ(smallest.size({1, 0}), 1);
  EXPECT_EQ(smallest.smallest_field({1, 0}), 0U);
  EXPECT_FALSE(smallest.is_uniform());
  EXPECT_FALSE(smallest.jumps());
}

TEST(MinimumSize, ABlockHasTheValuesOfItsPlaces) {
  const LinearSize falling(2, -1), rising(1, 1), broken(std::nan(""), 0);
  const UniformSize level(1.4);
  const std::vector<geometry::Vec2> places{{0, 0}, {0.3, 0}, {0.5, 0}, {1, 0}, {3, 0}};
  for (const MinimumSize& smallest : {MinimumSize({&falling, &rising, &level}), MinimumSize({&level, &broken, &rising}),
                                      MinimumSize({&broken, &falling})}) {
    std::vector<std::size_t> fields(places.size());
    std::vector<double> sizes(places.size()), values(places.size());
    smallest.sizes(places, sizes);
    smallest.smallest_fields(places, fields, values);
    for (std::size_t k = 0; k < places.size(); ++k) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(sizes[k]), std::bit_cast<std::uint64_t>(smallest.size(places[k])));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(values[k]), std::bit_cast<std::uint64_t>(sizes[k]));
      EXPECT_EQ(fields[k], smallest.smallest_field(places[k]));
    }
  }
}

TEST(MinimumSize, KeepsInvalidSizesSoThatTheMesherSeesThem) {
  const LinearSize falling(2, -1), broken(std::nan(""), 0), steep(1, 11);
  const UniformSize level(1.4);
  EXPECT_EQ(MinimumSize({&falling, &level}).size({3, 0}), -1);
  EXPECT_EQ(MinimumSize({&level, &falling}).size({3, 0}), -1);
  EXPECT_TRUE(std::isnan(MinimumSize({&level, &broken}).size({0, 0})));
  EXPECT_TRUE(std::isnan(MinimumSize({&broken, &level}).size({0, 0})));
  EXPECT_TRUE(MinimumSize({&level, &steep}).jumps());
}

} // namespace
} // namespace trime::sizing
