// SPDX-License-Identifier: BSD-3-Clause
#include "core/quoted.hpp"

#include <gtest/gtest.h>

namespace trime {
namespace {

TEST(Quoted, CutsLongTextsBetweenCharacters) {
  EXPECT_EQ(quoted("short"), "'short'");
  EXPECT_EQ(shown(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(shown(std::string(1000000, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(shown(std::string(59, 'x') + "\xc3\xa4" + "z"), std::string(59, 'x') + "...");
}

TEST(Quoted, HasNoBytesThatUpsetATerminal) {
  EXPECT_EQ(shown("a\x1b[31m\n\x7f"), "a?[31m??");
}

TEST(Quoted, LeavesOutTheMiddleOfALongMessage) {
  EXPECT_EQ(without_middle("short"), "short");
  const std::string told = without_middle("key " + std::string(1000000, 'x') + " is bad; try y");
  EXPECT_LT(told.size(), 600U);
  EXPECT_TRUE(told.starts_with("key xxx") && told.ends_with("xx is bad; try y"));
  std::string umlauts;
  for (int k = 0; k < 1000; ++k)
    umlauts += "\xc3\xa4";
  for (const std::size_t longest : {400, 401, 402, 403, 404})
    EXPECT_EQ(without_middle(umlauts, longest).find(" ... ") % 2, 0U); // whole characters only
}

} // namespace
} // namespace trime
