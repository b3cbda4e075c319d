// SPDX-License-Identifier: BSD-3-Clause
// Steps towards the factor of the size that yields a number of points.
#include "fitting/factor_search.hpp"

#include <gtest/gtest.h>

namespace trime::fitting {
namespace {

TEST(FactorSearch, OneStepDoesForTheInverseSquare) {
  FactorSearch search(1000);
  search.expect(-2);
  EXPECT_NEAR(search.next(2, 4000), 4, 1e-12);
}

TEST(FactorSearch, LearnsAnotherPower) {
  const auto points = [](double factor) { return 5e4 / std::pow(factor, 1.3); };
  FactorSearch search(2e4);
  double factor = 1;
  for (int step = 0; step < 5; ++step)
    factor = search.next(factor, points(factor));
  EXPECT_NEAR(points(factor) / 2e4, 1, 1e-3);
}

/// Curves that are simplified again may have more points at a larger size, by chance. The next step still goes by the
/// power of the steps before.
TEST(FactorSearch, LearnsNothingFromPointsThatGrowWithTheSize) {
  FactorSearch search(3000);
  search.expect(-2);
  search.next(1.5, 2700);
  EXPECT_NEAR(search.next(1.6, 2750), 1.6 * std::sqrt(2750.0 / 3000), 1e-12);
}

TEST(FactorSearch, StepsStayBounded) {
  FactorSearch search(1e6);
  EXPECT_EQ(search.next(8, 0), 2);  // no points at all
  EXPECT_EQ(search.next(8, 10), 2); // far too few
  search.expect(-0.5);
  EXPECT_EQ(search.next(1, 1e12), 4);
}

} // namespace
} // namespace trime::fitting
