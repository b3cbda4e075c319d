// SPDX-License-Identifier: BSD-3-Clause
// Names for solvers with narrow rules: which characters remain, and that no two names become equal.
#include "formats/solver_names.hpp"

#include <gtest/gtest.h>

#include <set>

namespace trime::formats {
namespace {

TEST(SolverNames, KeepWhatTheRulesAllow) {
  const std::vector<std::string> names{"rock", "rock|soil", "box.4", "Hole_2", "a-b c"};
  const std::vector<std::string> expected{"rock", "rock_soil", "box_4", "Hole_2", "a_b_c"};
  EXPECT_EQ(solver_names(names), expected);
}

TEST(SolverNames, BeginWithALetter) {
  const std::vector<std::string> expected{"SET_7", "SET_", "SET__x", "SET__lschiefer"};
  EXPECT_EQ(solver_names({"7", "", "_x", "\u00d6lschiefer"}), expected);
}

TEST(SolverNames, DifferInMoreThanCase) {
  const std::vector<std::string> expected{"rock", "Rock_2", "ROCK_3", "rock_2_2", "a_b", "a_b_2"};
  EXPECT_EQ(solver_names({"rock", "Rock", "ROCK", "rock_2", "a b", "a.b"}), expected);
  const std::vector<std::string> other{"a", "a_2", "A_3"};
  EXPECT_EQ(solver_names({"a", "a_2", "A"}), other);
}

TEST(SolverNames, AreShort) {
  const std::string stem(90, 'x');
  const std::vector<std::string> made = solver_names({stem, stem + "y", stem + "z"});
  EXPECT_EQ(made[0], std::string(80, 'x'));
  EXPECT_EQ(made[1], std::string(78, 'x') + "_2");
  EXPECT_EQ(made[2], std::string(78, 'x') + "_3");
  const std::vector<std::string> materials{"soft_", "sof_2", "clay", "SET_2"};
  EXPECT_EQ(solver_names({"soft_rock", "soft_rock_2", "clay", "2"}, 5), materials);
}

TEST(SolverNames, ManyEqualNamesTakeNoLongerThanOthers) {
  const std::vector<std::string> made = solver_names(std::vector<std::string>(200000, "\u5ca9"));
  EXPECT_EQ(std::set<std::string>(made.begin(), made.end()).size(), made.size());
  EXPECT_EQ(made.back(), "SET___200000");
}

TEST(SolverNames, CommentsHaveOneLine) {
  EXPECT_EQ(in_comment("a\nb\tc"), "a b c");
  EXPECT_EQ(in_comment(std::string(300, 'a')).size(), 100u);
}

} // namespace
} // namespace trime::formats
