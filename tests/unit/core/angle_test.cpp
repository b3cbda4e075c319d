// SPDX-License-Identifier: BSD-3-Clause
// Sine, cosine and angle against the C library, which is accurate here but not the same everywhere.
#include "core/angle.hpp"

#include "core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime {
namespace {

TEST(Angle, SineAndCosineAgreeWithTheLibrary) {
  for (int i = 0; i < 200000; ++i) {
    const double x = (random_unit(7, RandomPurpose::test, i, 0) - 0.5) * (i % 2 == 0 ? 13.0 : 1e5);
    const SinCos got = sin_cos(x);
    ASSERT_NEAR(got.sin, std::sin(x), 3e-16) << x;
    ASSERT_NEAR(got.cos, std::cos(x), 3e-16) << x;
  }
}

TEST(Angle, SineKeepsRelativeAccuracyNearZeroAndPi) {
  for (const double x : {1e-300, 1e-12, -1e-8, 1e-3, pi, 2 * pi, pi / 2, 3 * pi / 2, 0.0}) {
    EXPECT_NEAR(sin_cos(x).sin, std::sin(x), 4e-16 * std::fabs(std::sin(x))) << x;
    EXPECT_NEAR(sin_cos(x).cos, std::cos(x), 4e-16 * std::fabs(std::cos(x))) << x;
  }
}

TEST(Angle, QuadrantsAreExact) {
  EXPECT_EQ(angle_of(0, 1), 0);
  EXPECT_EQ(angle_of(1, 0), pi / 2);
  EXPECT_EQ(angle_of(-1, 0), -pi / 2);
  EXPECT_EQ(angle_of(0, -1), pi);
  EXPECT_EQ(angle_of(-0.0, -1), pi);
  EXPECT_EQ(angle_of(1, 1), pi / 4);
  EXPECT_EQ(angle_of(0, 0), 0);
}

TEST(Angle, AngleAgreesWithTheLibrary) {
  for (int i = 0; i < 200000; ++i) {
    const double scale = std::ldexp(1.0, i % 60 - 30);
    const double x = random_unit(8, RandomPurpose::test, i, 0) - 0.5;
    const double y = (random_unit(8, RandomPurpose::test, i, 1) - 0.5) * scale;
    const double expected = std::atan2(y, x);
    ASSERT_NEAR(angle_of(y, x), expected, 4.5e-16 * std::fmin(1.0, std::fabs(expected))) << y << " " << x;
  }
}

TEST(Angle, AngleUndoesSinCos) {
  for (int i = -1000; i <= 1000; ++i) {
    const double x = i * 0.00314159;
    const SinCos sc = sin_cos(x);
    ASSERT_NEAR(angle_of(sc.sin, sc.cos), x, 8e-16);
  }
}

} // namespace
} // namespace trime
