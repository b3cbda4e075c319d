// SPDX-License-Identifier: BSD-3-Clause
// Lists of faults, and the lines of a map that close no ring.
#include "contours/faults.hpp"

#include "contours/open_lines.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

namespace trime::contours {
namespace {

FaultList faults_of(int repairable, int others) {
  FaultList faults;
  for (int k = 0; k < repairable; ++k)
    add_fault(faults, HasArea::no, [] { return Fault{"a.xy:1", "a spike", "remove it", "it is removed"}; });
  for (int k = 0; k < others; ++k)
    add_fault(faults, HasArea::yes, [] { return Fault{"a.xy:2", "a crossing", "move it", ""}; });
  return faults;
}

std::string message_of(const FaultList& faults, Faults treatment) {
  try {
    check_faults(faults, "a.xy", treatment);
  } catch (const GeometryError& error) {
    return error.what();
  }
  return "";
}

TEST(Faults, AllAreCountedAndTheFirstOnesListed) {
  const std::string message = message_of(faults_of(25, 3), Faults::collect);
  EXPECT_NE(message.find("a.xy: found 28 faults. Try 'repair = true'"), std::string::npos) << message;
  EXPECT_NE(message.find("leaves out 25 without area; correct the other 3"), std::string::npos) << message;
  EXPECT_NE(message.find("and 18 more"), std::string::npos) << message;
}

TEST(Faults, ARepairRefusesOnlyWhatHasArea) {
  EXPECT_EQ(message_of(faults_of(25, 0), Faults::repair), "");
  EXPECT_EQ(message_of(faults_of(25, 1), Faults::repair), "a.xy:2: a crossing; move it");
}

/// Once only the faults of the list were added, so that a message gave too small a number.
TEST(Faults, AddedListsKeepTheirNumbers) {
  FaultList sum = faults_of(4, 1);
  add_faults(sum, faults_of(25, 13));
  EXPECT_EQ(sum.repairable, 29U);
  EXPECT_EQ(sum.others, 14U);
  EXPECT_EQ(sum.first.size(), 20U); // ten of each kind
}

TEST(OpenGroups, ABushOfLinesIsLeftOutAtOnce) {
  std::vector<LineEnds> lines;
  const auto add = [&](geometry::Vec2 a, geometry::Vec2 b) {
    LineEnds line{{a, static_cast<int>(lines.size()) + 1}, {b, static_cast<int>(lines.size()) + 1}, {}};
    line.box.include(a);
    line.box.include(b);
    lines.push_back(line);
  };
  add({0, 0}, {1, 0}); // the stem, which is free once its twigs are gone
  for (int k = 0; k < 20000; ++k)
    add({1, 0}, {2, k * 1e-3});
  const std::vector<OpenGroup> groups = open_groups(lines);
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].left_out.size(), lines.size());
  EXPECT_FALSE(groups[0].branches);
}

} // namespace
} // namespace trime::contours
