// SPDX-License-Identifier: BSD-3-Clause
// Suggestions for misspelt names.
#include "core/quoted.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trime {
namespace {

const std::vector<std::string> names{"gradation", "points", "edge_length", "seed"};

TEST(NearestName, FindsTyposAndRefusesStrangers) {
  EXPECT_EQ(nearest_name("gradaton", names), "gradation");
  EXPECT_EQ(nearest_name("Points", names), "points");
  EXPECT_EQ(nearest_name("sede", names), "seed");
  EXPECT_EQ(nearest_name("edgelength", names), "edge_length");
  EXPECT_EQ(nearest_name("Edge", names), "edge_length"); // its beginning
  EXPECT_EQ(nearest_name("ed", names), "");
  EXPECT_EQ(nearest_name("viscosity", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name("seed", {}), "");
  EXPECT_EQ(suggestion("sede", names), "; did you mean 'seed'?");
  EXPECT_EQ(suggestion("viscosity", names), "");
}

TEST(NearestName, TheNearestWinsThenTheFirst) {
  const std::vector<std::string> close{"abcdex", "abcdey", "abcdef"};
  EXPECT_EQ(nearest_name("abcdeF", close), "abcdef");
  EXPECT_EQ(nearest_name("abcdez", close), "abcdex");
}

TEST(NearestName, LengthCountsAsDifference) {
  const std::vector<std::string> longer{"abcde", "abcdefg", std::string(100000, 'a')};
  EXPECT_EQ(nearest_name("abcd", longer), "abcde");
  EXPECT_EQ(nearest_name("abcdefghij", longer), "abcdefg"); // three of ten letters too many
  EXPECT_EQ(nearest_name(std::string(100000, 'a'), longer), "");
}

} // namespace
} // namespace trime
