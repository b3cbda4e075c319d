// SPDX-License-Identifier: BSD-3-Clause
// What an assertion prints before it ends the process.
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace trime {
namespace {

TEST(AssertionDeathTest, NamesTheRankThePlaceAndTheValues) {
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const int found = 3;
  EXPECT_DEATH(
      {
        setenv("OMPI_COMM_WORLD_RANK", "7", 1);
        TRIME_ASSERT(found == 2, "expected 2, found {}", found);
      },
      "internal error on rank 7: .*error_test.cpp:[0-9]+: 'found == 2' does not hold. expected 2, found 3");
}

} // namespace
} // namespace trime
