// SPDX-License-Identifier: BSD-3-Clause
// The region expression: its values, and what a user reads when it is wrong.
#include "trime/shape/region_shape.hpp"

#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

namespace trime::shape {
namespace {

const std::vector<std::string> names{"spade", "hole", "slot"};

std::string error_of(const std::string& text) {
  return message_of<ConfigError>([&] { Region::parse(text, names); });
}

TEST(Region, ValuesOfAllCombinations) {
  const Region region = Region::parse(" difference( spade,union(hole , slot), intersection(domain,hole) ) ", names);
  EXPECT_EQ(region.parts(), (std::vector<int>{0, 1, 2, 3}));
  for (int bits = 0; bits < 16; ++bits) {
    const auto in = [&](int k) { return (bits >> k & 1) != 0; };
    EXPECT_EQ(region.contains(in), in(0) && !(in(1) || in(2)) && !(in(3) && in(1))) << bits;
    EXPECT_EQ(Region::parse("hole", names).contains(in), in(1));
    EXPECT_EQ(Region::parse("union(spade,hole,slot)", names).contains(in), in(0) || in(1) || in(2));
    EXPECT_EQ(Region::parse("intersection(spade,hole,slot)", names).contains(in), in(0) && in(1) && in(2));
  }
}

TEST(Region, KnowsWhatIsOnlySubtracted) {
  const std::vector<std::string> letters{"a", "b", "c"};
  const Region region = Region::parse("union(difference(a, b), difference(c, difference(b, c)))", letters);
  EXPECT_FALSE(region.subtracts(0));
  EXPECT_TRUE(region.subtracts(1));
  EXPECT_FALSE(region.subtracts(2)) << "it is also added";
}

TEST(Region, TheBoxHoldsTheShape) {
  const std::vector<geometry::Box> boxes{{{0, 0}, {4, 3}}, {{2, 1}, {9, 2}}, {{-1, -1}, {1, 1}}, {{0, 0}, {1, 1}}};
  const auto expect_box = [&](const char* text, geometry::Vec2 min, geometry::Vec2 max) {
    const geometry::Box box = Region::parse(text, names).box(boxes);
    EXPECT_EQ(box.min, min) << text;
    EXPECT_EQ(box.max, max) << text;
  };
  expect_box("spade", {0, 0}, {4, 3});
  expect_box("union(spade, hole, slot)", {-1, -1}, {9, 3});
  expect_box("intersection(spade, hole)", {2, 1}, {4, 2});
  expect_box("difference(spade, hole, slot)", {0, 0}, {4, 3});
  expect_box("union(domain, intersection(hole, spade))", {0, 0}, {4, 2});
}

TEST(Region, UnknownPartNamesTheNearest) {
  const std::string message = error_of("difference(spade, hule)");
  EXPECT_NE(message.find("'hule'"), std::string::npos) << message;
  EXPECT_NE(message.find("spade, hole, slot, domain"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean 'hole'"), std::string::npos) << message;
  EXPECT_EQ(error_of("zzzzzzzz").find("did you mean"), std::string::npos);
}

TEST(Region, SyntaxErrorsTellThePlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "column 1"},
      {"spade hole", "column 7"},
      {"union(spade)", "two or more"},
      {"union(spade,)", "column 13"},
      {"union(spade, hole", "',' or ')'"},
      {"diference(spade, hole)", "did you mean 'difference'?"},
      {"Difference(spade, hole)", "did you mean 'difference'?"},
      {"minus(spade, hole)", "instead of 'minus(...)'"},
      {"union spade", "unknown part 'union'"},
      {"minus(spade, hole)", "'minus(...)'"},
      {"difference(spade, hole))", "column 24"},
      {"(spade)", "column 1"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(error_of(text).find(expected), std::string::npos) << text << ": " << error_of(text);
}

TEST(Region, DepthIsLimited) {
  std::string text;
  for (int k = 0; k < 100000; ++k)
    text += "union(spade,";
  EXPECT_NE(error_of(text).find("nested"), std::string::npos);
}

} // namespace
} // namespace trime::shape
