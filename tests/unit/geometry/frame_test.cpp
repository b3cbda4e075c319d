// SPDX-License-Identifier: BSD-3-Clause
#include "trime/geometry/lattice.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace trime::geometry {
namespace {

bool same(const Box& a, const Box& b) {
  return a.min == b.min && a.max == b.max;
}

TEST(ContainerAround, UnitSquareWhereItHoldsTheShape) {
  EXPECT_TRUE(same(container_around({{0.2, 0.3}, {0.7, 0.9}}), unit_square));
  EXPECT_TRUE(same(container_around(unit_square), unit_square));
}

TEST(ContainerAround, UnitSquareWhereTheBoxHasNoArea) {
  EXPECT_TRUE(same(container_around(Box{}), unit_square));
  EXPECT_TRUE(same(container_around({{3, 3}, {3, 5}}), unit_square));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(same(container_around({{nan, nan}, {nan, nan}}), unit_square));
}

TEST(ContainerAround, MarginOfTheLongerSide) {
  EXPECT_TRUE(same(container_around({{50, 50}, {950, 450}}), {{5, 5}, {995, 495}}));
  EXPECT_TRUE(same(container_around({{0, 0}, {1, 1.25}}), {{-0.0625, -0.0625}, {1.0625, 1.3125}}));
}

} // namespace
} // namespace trime::geometry
