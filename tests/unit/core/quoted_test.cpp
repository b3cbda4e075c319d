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

} // namespace
} // namespace trime
