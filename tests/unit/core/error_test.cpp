// SPDX-License-Identifier: BSD-3-Clause
// What an assertion prints before it ends the process, and the places that errors carry.
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

struct Point {
  double x, y;
};

TEST(Error, CarriesThePlacesOfItsMessage) {
  const double third = 1.0 / 3;
  const GeometryError error(
      fmt::format("from {} to {}: too near", Place(Point{third, -2e-7}), Place(Point{5, 0.1}, 0)));
  EXPECT_STREQ(error.what(), "from (0.333333333, -2e-07) to (5, 0.1): too near");
  ASSERT_EQ(error.message().places().size(), 2u);
  EXPECT_EQ(error.message().places()[0].x, third);
  EXPECT_EQ(error.message().places()[0].y, -2e-7);
  EXPECT_EQ(error.message().places()[1].x, 5);
  const auto note = [](double x, double y) { return fmt::format(" [{:.2g} {:.2g}]", x, y); };
  EXPECT_EQ(error.message().with_notes(note), "from (0.333333333, -2e-07) [0.33 -2e-07] to (5, 0.1) [5 0.1]: too near");
  const Error again(error.code(), error.message().formatted() + " (rank 3)");
  EXPECT_EQ(again.message().with_notes(note), error.message().with_notes(note) + " (rank 3)");
}

TEST(Error, KeepsATextWithoutPlacesAsItIs) {
  for (const char* text : {"", "(0.5, 0.5)", "\x02", "\x02 0.5", "a\x03"})
    EXPECT_STREQ(ConfigError(text).what(), text);
}

TEST(PlacedText, KeepsAPlaceBehindAStrayMark) {
  const PlacedText text(fmt::format("file a\x02"
                                    "b near {}",
                                    Place(Point{1, 2})));
  EXPECT_EQ(text.text(), "file a\x02"
                         "b near (1, 2)");
  ASSERT_EQ(text.places().size(), 1u);
  EXPECT_EQ(text.places()[0].x, 1);
  EXPECT_EQ(text.places()[0].y, 2);
}

} // namespace
} // namespace trime
