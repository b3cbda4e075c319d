// SPDX-License-Identifier: BSD-3-Clause
// Bounds of a scaled size, and sizes from formulas: what is refused, what is clamped.
#include "trime/core/error.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace trime::sizing {
namespace {

using geometry::Box;

const Box unit_box{{0, 0}, {1, 1}};

TEST(ScaledSize, KeepsWithinItsBounds) {
  const Formula formula("0.01 + x", "test");
  const ExpressionSize field(formula, unit_box);
  const ScaledSize size(field, 2, 0.1, 1.5);
  EXPECT_EQ(size.size({0, 0}), 0.1);
  EXPECT_EQ(size.size({0.49, 0}), 1.0);
  EXPECT_EQ(size.size({0.99, 0}), 1.5);
  EXPECT_FALSE(size.is_uniform());
  EXPECT_EQ(ScaledSize(field, 3).size({0.99, 0}), 3.0);
}

TEST(ExpressionSize, IsTheFormula) {
  const Formula formula("1+3*x+3*y", "test");
  const ExpressionSize size(formula, unit_box);
  EXPECT_EQ(size.size({0, 0}), 1);
  EXPECT_EQ(size.size({0.5, 1}), 5.5);
}

TEST(ExpressionSize, NamesThePlaceWhereItIsNotPositive) {
  for (const auto& [text, found] : {std::pair{"x - 0.5", "found -0.5 at (0, 0)"},
                                    {"1/(y-1)^2", "at (0, 1)"},
                                    {"sqrt(0.26 - x)", "is not a number at (0.265625, 0)"}}) {
    const Formula formula(text, "config.ini:9");
    try {
      const ExpressionSize size(formula, unit_box);
      ADD_FAILURE() << text;
    } catch (const ConfigError& error) {
      EXPECT_NE(std::string(error.what()).find(found), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).rfind("config.ini:9: ", 0), 0u) << error.what();
    }
  }
}

TEST(ExpressionSize, WhatFailsBetweenThePointsOfItsGridComesThroughForTheMesherToName) {
  const Formula negative("abs(x-0.3) + abs(y-0.3) < 1e-3 ? -1 : x + 2", "test");
  const ExpressionSize size(negative, unit_box);
  EXPECT_EQ(size.size({0.3, 0.3}), -1);
  EXPECT_EQ(ScaledSize(size, 2, 0.1, 1.5).size({0.3, 0.3}), -1) << "a bound must not hide it";
  const Formula tiny("abs(x-0.3) + abs(y-0.3) < 1e-3 ? 1e-9 : x + 2", "test");
  EXPECT_EQ(ExpressionSize(tiny, unit_box).size({0.3, 0.3}), 3e-6);
}

TEST(ExpressionSize, IsThatOfTheNearestPointOutsideItsBox) {
  const Formula formula("0.1 + sqrt(x)", "test");
  EXPECT_EQ(ExpressionSize(formula, unit_box).size({-1e-17, 0.5}), 0.1);
}

TEST(ScaledSize, WhatIsNoSizeComesThrough) {
  for (const double bad : {0.0, -2.0, std::numeric_limits<double>::infinity()}) {
    const UniformSize field(bad);
    EXPECT_EQ(ScaledSize(field, 3, 0.1, 1).size({}), bad);
    EXPECT_THROW(checked_size(ScaledSize(field, 3, 0.1, 1), {}), GeometryError);
  }
  const UniformSize none(std::nan(""));
  EXPECT_TRUE(std::isnan(ScaledSize(none, 3, 0.1, 1).size({})));
}

} // namespace
} // namespace trime::sizing
