// SPDX-License-Identifier: BSD-3-Clause
// Contours: text to rings, rings to polygons, and every complaint with its line.
#include "trime/shape/contour.hpp"

#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <cstdio>

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Loop;
using geometry::Vec2;

const Frame unit_frame(Box{{0, 0}, {1, 1}});

Part part_of(const std::string& text, const Frame& frame = unit_frame) {
  return Part::contour("spade", parse_xy(text, "map.xy"), {}, frame);
}

std::string error_of(const std::string& text) {
  return message_of<GeometryError>([&] { part_of(text); });
}

void expect_error(const std::string& text, std::initializer_list<const char*> expected) {
  const std::string message = error_of(text);
  for (const char* part : expected)
    EXPECT_NE(message.find(part), std::string::npos) << "text:\n" << text << "\nmessage: " << message;
}

TEST(Contour, ReadsRingsCommentsAndClosedOrOpenRings) {
  const Contour contour = parse_xy("# a map\n; another comment\n0.1 0.1\n+0.9\t0.1 # corner\r\n  5e-1 .9  \n0.1 0.1\n"
                                   "\n\n0.4 0.2\n# inside a ring\n0.6 0.2\n0.5 0.3",
                                   "map.xy");
  ASSERT_EQ(contour.rings.size(), 2u);
  EXPECT_EQ(contour.rings[0].points, (std::vector<Vec2>{{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}}));
  EXPECT_EQ(contour.rings[0].lines, (std::vector<int>{3, 4, 5}));
  EXPECT_EQ(contour.rings[1].lines, (std::vector<int>{9, 11, 12}));
  EXPECT_TRUE(contour.warnings.empty());
}

TEST(Contour, MergesRepeatedVerticesWithAWarning) {
  const Contour contour = parse_xy("0 0\n1 0\n1 0\n1 0\n1 1\n", "map.xy");
  EXPECT_EQ(contour.rings[0].points.size(), 3u);
  ASSERT_EQ(contour.warnings.size(), 2u);
  EXPECT_NE(contour.warnings[0].find("map.xy:3"), std::string::npos);
  std::string many = "0 0\n1 0\n";
  for (int k = 0; k < 1000; ++k)
    many += "1 1\n";
  EXPECT_LT(parse_xy(many, "map.xy").warnings.size(), 10u);
}

TEST(Contour, VerticesThatTheLatticeMakesEqualAreMergedWithAWarning) {
  const Part part = part_of("0.1 0.1\n0.9 0.1\n0.9 0.10000000000000002\n0.5 0.9\n");
  ASSERT_EQ(part.warnings().size(), 1u);
  EXPECT_NE(part.warnings()[0].find("map.xy:1"), std::string::npos) << part.warnings()[0];
  EXPECT_EQ(part.boundary()[0].pieces.size(), 3u);
}

TEST(Contour, BadTextIsLocated) {
  expect_error("", {"map.xy", "no vertex"});
  expect_error("# only\n\n", {"map.xy", "no vertex"});
  expect_error("0 0\n1 0\nx 1\n", {"map.xy:3", "'x 1'"});
  expect_error("0 0\n1\n", {"map.xy:2", "two numbers"});
  expect_error("0 0\n1 0 2\n", {"map.xy:2", "two numbers"});
  expect_error("0 0\n1 0\n0,5 1\n", {"map.xy:3", "two numbers"});
  expect_error("0 0\n1, 0\n0 1\n", {"map.xy:2", "by blanks, not commas"});
  expect_error("0 0 0\n1 0 0\n0 1 0\n", {"map.xy:1", "found three numbers"});
  expect_error("0 0\n1 0\nnan 0.5\n", {"map.xy:3", "finite", "nan"});
  expect_error("0 0\n1 0\n0.5 -inf\n", {"map.xy:3", "finite", "-inf"});
  expect_error("0 0\n1 0\n0.5 1e999\n", {"map.xy:3", "finite"});
}

TEST(Contour, TooSmallRingsAreLocated) {
  expect_error("0 0\n1 0\n1 1\n\n0.2 0.2\n", {"map.xy:5", "1 distinct vertex"});
  expect_error("\n0 0\n1 0\n0 0\n", {"map.xy:2", "2 distinct"});
  expect_error("0 0\n1 0\n0 0\n1 0\n0 0\n", {"map.xy:1", "2 distinct"});
  expect_error("0 0\n0.5 0.5\n0.25 0.25\n0.75 0.75\n", {"map.xy:1", "no area"});
  expect_error("0.1 0.1\n0.1 0.1000000000000000125\n0.10000000000000001 0.1\n0.1 0.10000000000000003\n", {"map.xy:1"});
}

TEST(Contour, CrossingsAreLocated) {
  expect_error("0 0\n1 1\n1 0\n0 0.8\n", {"map.xy:1", "crosses", "line 3", "cross itself", "0.444444", "blank line"});
  expect_error("0.1 0.1\n0.5 0.1\n0.5 0.5\n0.1 0.5\n\n0.3 0.3\n0.9 0.3\n0.9 0.4\n0.3 0.4\n",
               {"map.xy:2", "crosses", "line 6", "two rings", "(0.5, 0.3)"});
}

TEST(Contour, TouchingIsLocated) {
  // A vertex on an edge, a vertex visited twice, an edge on an edge, twice the same ring, a corner at an edge.
  expect_error("0 0\n1 0\n1 1\n0.5 0\n0 1\n", {"map.xy:1", "touches", "touches itself", "(0.5, 0)"});
  expect_error("0 0\n0.5 0.5\n1 0\n1 1\n0.5 0.5\n0 1\n", {"touches itself", "(0.5, 0.5)"});
  expect_error("0 0\n0.5 0\n0.5 0.5\n0 0.5\n\n0.5 0.1\n0.9 0.1\n0.9 0.2\n0.5 0.2\n", {"map.xy:2", "two rings touch"});
  expect_error("0 0\n0.5 0\n0.5 0.5\n\n0.5 0\n0.5 0.5\n0 0\n", {"two rings touch"});
  expect_error("0 0\n0.5 0\n0.5 0.5\n0 0.5\n\n0.5 0.25\n0.9 0.1\n0.9 0.2\n", {"map.xy:2", "(0.5, 0.25)"});
}

TEST(Contour, SpikesAreLocated) {
  expect_error("0 0\n1 0\n1 1\n0.5 1\n0.75 1\n0 0.9\n", {"map.xy:4", "spike", "(0.5, 1)"});
  expect_error("0 0\n1 0\n1 1\n0.5 0\n", {"map.xy:1", "spike", "(0, 0)"});
  EXPECT_EQ(error_of("0 0\n0.5 0\n1 0\n1 1\n"), ""); // a straight vertex is none
}

TEST(Contour, TheFirstOffendingPairIsReportedWhateverTheThreads) {
  std::string text;
  for (int k = 0; k < 5000; ++k)
    text += fmt::format("{} {}\n", 0.1 + 0.8 * k / 5000, 0.1 + (k % 2) * 0.01);
  text += "0.9 0.105\n0.1 0.105\n";
  const std::string message = error_of(text);
  EXPECT_NE(message.find("map.xy:1:"), std::string::npos) << message;
  EXPECT_NE(message.find("line 5001"), std::string::npos) << message;
}

TEST(Contour, MessagesUseTheCoordinatesOfTheFile) {
  const Contour contour = parse_xy("0 0\n800 800\n800 0\n0 800\n", "map.xy");
  const std::string message = message_of<GeometryError>(
      [&] { Part::contour("m", contour, fit_to_container(contour, unit_frame.container()), unit_frame); });
  EXPECT_NE(message.find("(400, 400)"), std::string::npos) << message;
}

TEST(Contour, FarOutsideTheContainerSuggestsToNormalize) {
  expect_error("0 0\n800 0\n800 700\n", {"map.xy:2", "normalize"});
}

TEST(Contour, NormalizesIntoAShiftedContainer) {
  const Frame frame(Box{{10, -5}, {14, -3}});
  const Contour contour = make_contour({{{100, 100}, {300, 100}, {300, 150}, {100, 150}}}, "map");
  const Part part = Part::contour("m", contour, fit_to_container(contour, frame.container()), frame);
  const RegionShape shape({part}, "m", frame);
  const Box box = shape.boundary().bounding_box();
  EXPECT_NEAR(box.width(), 0.8 * 2, 1e-12);
  EXPECT_NEAR(box.height(), 0.4, 1e-12);
  EXPECT_NEAR(0.5 * (box.min.x + box.max.x), 12, 1e-12);
  EXPECT_NEAR(0.5 * (box.min.y + box.max.y), -4, 1e-12);
  EXPECT_NEAR(shape.boundary().area, 0.64, 1e-12);
}

TEST(Contour, OrientationFollowsFromNesting) {
  // Squares within squares, of all orientations, not in the order of nesting; and one beside them.
  const auto square = [](double a, double b, bool ccw) {
    return ccw ? std::vector<Vec2>{{a, a}, {b, a}, {b, b}, {a, b}} : std::vector<Vec2>{{a, a}, {a, b}, {b, b}, {b, a}};
  };
  for (int bits = 0; bits < 16; ++bits) {
    const auto ccw = [&](int k) { return (bits >> k & 1) != 0; };
    const Contour contour = make_contour(
        {square(0.3, 0.4, ccw(0)), square(0.1, 0.8, ccw(1)), square(0.2, 0.7, ccw(2)), square(0.85, 0.9, ccw(3))}, "s");
    const RegionShape shape({Part::contour("s", contour, {}, unit_frame)}, "s", unit_frame);
    expect_valid(shape.boundary());
    expect_inside_on_left(shape);
    EXPECT_EQ(shape.boundary().components(), 3);
    EXPECT_EQ(shape.boundary().holes(), 1);
    EXPECT_NEAR(shape.boundary().area, 0.49 - 0.25 + 0.01 + 0.0025, 1e-12);
    int outer = 0;
    for (const Loop& loop : shape.parts()[0].boundary())
      outer += loop.outer ? 1 : 0;
    EXPECT_EQ(outer, 3);
  }
}

TEST(Contour, SkipsAByteOrderMark) {
  EXPECT_EQ(parse_xy("\xEF\xBB\xBF"
                     "0 0\n1 0\n0 1\n",
                     "map.xy")
                .rings[0]
                .points.size(),
            3u);
}

TEST(Contour, WarnsOfSeparatePiecesButNotOfHoles) {
  const std::string ring = "0.1 0.1\n0.8 0.1\n0.8 0.8\n0.1 0.8\n\n", hole = "0.2 0.2\n0.3 0.2\n0.3 0.3\n\n";
  EXPECT_TRUE(part_of(ring + hole).warnings().empty());
  const Part beside = part_of("0.9 0.9\n0.95 0.9\n0.95 0.95\n\n" + ring + hole); // the largest is the main one
  ASSERT_EQ(beside.warnings().size(), 1u);
  EXPECT_NE(beside.warnings()[0].find("map.xy:1: "), std::string::npos) << beside.warnings()[0];
  std::string many = ring;
  for (int k = 0; k < 50; ++k)
    many += fmt::format("{0} 0.9\n{1} 0.9\n{1} 0.91\n\n", 0.01 * k, 0.01 * k + 0.005);
  EXPECT_EQ(part_of(many).warnings().size(), 6u);
}

TEST(Contour, FileErrors) {
  EXPECT_NE(message_of<FileError>([] { read_xy("no/such/file.xy"); }).find("no/such/file.xy"), std::string::npos);
  EXPECT_NE(message_of<FileError>([] { read_xy("."); }), "");
  EXPECT_NE(message_of<ConfigError>([] { read_xy("a.poly"); }).find(".poly"), std::string::npos);
  EXPECT_NE(message_of<ConfigError>([] { read_xy("a.GeoJSON"); }).find(".geojson"), std::string::npos);
}

TEST(Contour, ReadsAFile) {
  const std::string path = ::testing::TempDir() + "trime_contour_test.xy";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  std::fputs("0 0\n1 0\n0 1\n", file);
  std::fclose(file);
  EXPECT_EQ(read_xy(path).rings[0].points.size(), 3u);
  EXPECT_EQ(read_xy(path).source, path);
  std::remove(path.c_str());
}

} // namespace
} // namespace trime::shape
