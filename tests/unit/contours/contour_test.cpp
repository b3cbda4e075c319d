// SPDX-License-Identifier: BSD-3-Clause
// Contours: text to rings, rings to polygons, and every complaint with its line.
#include "trime/contours/contour.hpp"

#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <cstdio>

namespace trime::contours {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Loop;
using geometry::Vec2;
using shape::expect_valid;
using shape::message_of;
using shape::Part;
using shape::RegionShape;

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
  expect_error("0 0\n1,, 0\n0 1\n", {"map.xy:2", "one comma between"});
  expect_error("0 0 0\n1 0 0\n0 1 0\n", {"map.xy:1", "remove the third column"});
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

TEST(Contour, OverlapsAreLocated) {
  // An edge on an edge, another edge on an edge, two rings that cross at their vertices.
  expect_error("0 0\n0.5 0\n0.5 0.5\n0 0.5\n\n0.5 0.1\n0.9 0.1\n0.9 0.2\n0.5 0.2\n",
               {"map.xy:2", "line 6", "two rings touch or overlap", "overlap along an edge"});
  expect_error("0 0\n0.5 0\n0.5 0.5\n\n0.5 0\n0.5 0.5\n0.9 0.5\n", {"two rings touch"});
  expect_error("0.2 0.2\n0.5 0.2\n0.8 0.2\n0.8 0.5\n0.2 0.5\n\n0.5 0\n0.6 0.1\n0.5 0.2\n0.6 0.4\n0.4 0.1\n",
               {"map.xy:1", "cross at a vertex", "(0.5, 0.2)"});
}

/// Area, components and holes of the contour; checks that the boundary is valid, and that so many touches are told.
void expect_parted(const std::string& text, double area, int components, int holes, std::size_t touches) {
  const Part part = part_of(text);
  const RegionShape shape({part}, "spade", unit_frame);
  expect_valid(shape.boundary());
  expect_inside_on_left(shape);
  EXPECT_NEAR(shape.boundary().area, area, 1e-10) << text;
  EXPECT_EQ(shape.boundary().components(), components) << text;
  EXPECT_EQ(shape.boundary().holes(), holes) << text;
  std::size_t told = 0;
  for (const std::string& warning : part.warnings())
    told += warning.find("rings touch at (") != std::string::npos ? 1 : 0;
  EXPECT_EQ(told, touches) << text;
}

TEST(Contour, RingsThatTouchAreParted) {
  const std::string square = "0.1 0.1\n0.5 0.1\n0.9 0.1\n0.9 0.9\n0.1 0.9\n";
  // A hole at a vertex of the outer ring, at its edge, at its corner: a bay. Two holes at each other: one hole.
  expect_parted(square + "\n0.5 0.1\n0.6 0.3\n0.4 0.3\n", 0.62, 1, 0, 1);
  expect_parted(square + "\n0.3 0.1\n0.4 0.3\n0.2 0.3\n", 0.62, 1, 0, 1);
  expect_parted(square + "\n0.1 0.1\n0.3 0.3\n0.3 0.2\n", 0.63, 1, 0, 1);
  expect_parted(square + "\n0.5 0.5\n0.6 0.7\n0.4 0.7\n\n0.5 0.5\n0.6 0.3\n0.4 0.3\n", 0.6, 1, 1, 1);
  // A hole at the outer ring twice cuts the area in two.
  expect_parted(square + "\n0.5 0.1\n0.6 0.5\n0.5 0.9\n0.4 0.5\n", 0.56, 2, 0, 2);
  // Two squares at a corner; a ring that pinches the area; a hole as a loop of the outer ring; four at one place.
  expect_parted("0.1 0.1\n0.5 0.1\n0.5 0.5\n0.1 0.5\n\n0.5 0.5\n0.9 0.5\n0.9 0.9\n0.5 0.9\n", 0.32, 2, 0, 1);
  expect_parted("0 0\n0.5 0.5\n1 0\n1 1\n0.5 0.5\n0 1\n", 0.5, 2, 0, 1);
  expect_parted("0 0\n1 0\n1 1\n0.5 0\n0 1\n", 0.5, 2, 0, 1);
  for (const char* loop : {"0.6 0.3\n0.4 0.3\n", "0.4 0.3\n0.6 0.3\n"})
    expect_parted(fmt::format("0.5 0.1\n{}0.5 0.1\n0.9 0.1\n0.9 0.9\n0.1 0.9\n0.1 0.1\n", loop), 0.62, 1, 0, 1);
  expect_parted("0.5 0.5\n0.9 0.4\n0.9 0.6\n\n0.5 0.5\n0.6 0.9\n0.4 0.9\n\n0.5 0.5\n0.1 0.6\n0.1 0.4\n\n"
                "0.5 0.5\n0.4 0.1\n0.6 0.1\n",
                0.16, 4, 0, 1);
  // Narrow gaps at one place: directions into a reflex sector may lead across the other gap.
  expect_parted(square + "\n0.5 0.2\n0.3 0.6\n0.299 0.6\n\n0.5 0.2\n0.801 0.8\n0.8 0.8\n", 0.6395, 1, 1, 1);
  // A vertex that snapping leaves beside the slanted edge it is meant to lie on.
  expect_parted("0.1 0.1\n0.8 0.2\n0.1 0.9\n\n0.3 0.12857142857142856\n0.3 0.3\n0.2 0.3\n", 0.28 - 0.0085714286, 1, 0,
                1);
}

TEST(Contour, TouchesInALongChainAreAllParted) {
  std::string text;
  for (int k = 0; k < 500; ++k) // squares corner to corner
    text += fmt::format("{0} {0}\n{1} {0}\n{1} {1}\n{0} {1}\n\n", k / 512.0, (k + 1) / 512.0);
  const Part part = part_of(text);
  const RegionShape shape({part}, "spade", unit_frame);
  EXPECT_EQ(shape.boundary().components(), 500);
  EXPECT_NEAR(shape.boundary().area, 500 / 512.0 / 512.0, 1e-10);
  EXPECT_LT(part.warnings().size(), 15u);
}

TEST(Contour, ARingGivenTwiceIsUsedOnce) {
  const Part part = part_of("0 0\n0.5 0\n0.5 0.5\n\n0.5 0.5\n0.5 0\n0 0\n\n0.6 0.6\n0.7 0.6\n0.7 0.7\n\n"
                            "0.5 0\n0.5 0.5\n0 0\n");
  EXPECT_EQ(part.boundary().size(), 2u);
  ASSERT_EQ(part.warnings().size(), 3u); // two repeated, one piece apart
  EXPECT_NE(part.warnings()[0].find("map.xy:5: the ring that starts here was given before, at line 1"),
            std::string::npos)
      << part.warnings()[0];
  EXPECT_NE(part.warnings()[1].find("map.xy:13:"), std::string::npos) << part.warnings()[1];
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

TEST(Contour, ReadsWhatOtherProgramsWrite) {
  const std::vector<Vec2> triangle{{0.125, 0}, {1, 0}, {0, 1}};
  for (const char* text : {"1.25D-1 0\n1d0 0\n0 +1.0D+00\n", "0.125 0\r1 0\r0 1\r", "0.125 0\r\n1 0\r\r\n0 1",
                           "> a ring\n.125 0\n1 0\n0 1\n>", "# lines\n0.125 1e-400\n1 4.9e-324\n0 1\n"}) {
    const Contour contour = parse_xy(text, "map.xy");
    ASSERT_EQ(contour.rings.size(), 1u) << text;
    ASSERT_EQ(contour.rings[0].points.size(), 3u) << text;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(length(contour.rings[0].points[k] - triangle[k]), 0, 1e-300) << text;
    EXPECT_TRUE(contour.warnings.empty());
  }
  const Contour two = parse_xy(">\r0 0\r1 0\r0 1\r>\r.2 .2\r.3 .2\r.2 .3\r\r.5 .2\r.6 .2\r.5 .3\r", "map.xy");
  ASSERT_EQ(two.rings.size(), 3u);
  EXPECT_EQ(two.rings[1].lines, (std::vector<int>{6, 7, 8}));
  EXPECT_EQ(two.rings[2].lines[0], 10);
}

TEST(Contour, TakesNamesOfColumnsForWhatTheyAre) {
  for (const char* names : {"x y", "X\tY", "lon lat", "\"Longitude\",\"Latitude\""}) {
    const Contour contour = parse_xy(std::string(names) + "\n0 0\n1 0\n0 1\n", "map.xy");
    EXPECT_EQ(contour.rings[0].points.size(), 3u);
    ASSERT_EQ(contour.warnings.size(), 1u);
    EXPECT_NE(contour.warnings[0].find("map.xy:1:"), std::string::npos);
  }
  expect_error("lat lon\n0 0\n1 0\n0 1\n", {"map.xy:1", "x (longitude) before y"});
  expect_error("id x y\n0 0\n1 0\n0 1\n", {"map.xy:1", "put '#' before it"});
  expect_error("0 0\nx y\n1 0\n0 1\n", {"map.xy:2", "two numbers"});
  EXPECT_NE(message_of<GeometryError>([] { parse_points("x y\n0 0\n", "p.xy"); }).find("p.xy:1"), std::string::npos);
}

TEST(Contour, SemicolonsBetweenNumbersAllowDecimalCommas) {
  const std::vector<Vec2> triangle{{10.25, 20.5}, {95, 22}, {12.5, 70}};
  for (const char* text : {"10,25;20,5\n95;22\n12,5;70\n", "x;y\r\n10,25 ; 20,50;\r\n95,0;22\r\n12,5;70,0 # end\r\n",
                           "; table\n10.25;20.5\n95;22\n12.5;70"})
    EXPECT_EQ(parse_xy(text, "map.csv").rings.at(0).points, triangle) << text;
  EXPECT_EQ(parse_points("10,25;20,5\n\n95;22\n12,5;70\n", "p.csv").at(2).line, 4);
  // In all other texts a semicolon starts a comment.
  EXPECT_EQ(parse_xy("10.25,20.5 ; a\n95 22 ;1;2\n12.5 70\n", "map.xy").rings.at(0).points, triangle);
  expect_error("10,25;20,5\n95,0 22\n12,5;70\n", {"map.xy:1", "line 2", "decimals with a point"});
  expect_error("a line\n10,25;20,5\n95;22\n12,5;70\n", {"map.xy:2", "line 1", "'#' before comments"});
  expect_error("10,25;1\n95,22;2\n12,70;3\n", {"map.xy:1", "two ways"});
  expect_error("10,25;20,5;0\n95;22;0\n12,5;70;0\n", {"map.xy:1", "third column"});
}

TEST(ReadPoints, OfAMap) {
  const std::string text = R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"type": "Point", "coordinates": [9, 9]},
     "geometry": {"type": "Point", "coordinates": [1.5, 2]}},
    {"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}},
    {"type": "Feature", "properties": {}, "geometry": {"type": "GeometryCollection", "geometries": [
      {"type": "MultiPoint", "coordinates": [[3, 4], [5, 6, 7]]}]}}]})";
  const std::vector<FilePoint> points = parse_points(text, "wells.geojson");
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0].position, (Vec2{1.5, 2}));
  EXPECT_EQ(points[0].line, 3);
  EXPECT_EQ(points[2].position, (Vec2{5, 6}));
  EXPECT_EQ(points[2].line, 6);
  for (const char* bad :
       {R"({"type": "LineString", "coordinates": [[0, 0], [1, 1]]})", R"({"type": "Point", "coordinates": [1]})",
        R"({"type": "Point", "coordinates": [1, 1e31]})", R"({"type": "Point", "coordinates": [])"})
    EXPECT_THROW(parse_points(bad, "wells.json"), GeometryError) << bad;
}

TEST(Contour, AirfoilsAreOneRing) {
  const std::vector<Vec2> foil{{1, 0.01}, {0.5, 0.1}, {0, 0}, {0.5, -0.05}, {1, -0.01}};
  for (const char* text : {"2032 FOIL\n1 .01\n.5 .1\n0 0\n.5 -.05\n1 -.01\n",
                           "FOIL A\r\n  3.  3.\r\n\r\n0 0\r\n.5 .1\r\n1 .01\r\n\r\n0 0\r\n.5 -.05\r\n1 -.01\r\n",
                           "3 3\n0 0\n.5 .1\n1 .01\n0 0\n.5 -.05\n1 -.01\n"}) {
    const Contour contour = parse_xy(text, "foil.dat");
    ASSERT_EQ(contour.rings.size(), 1u) << text;
    EXPECT_EQ(contour.rings[0].points, foil) << text;
    ASSERT_EQ(contour.warnings.size(), 1u);
    EXPECT_NE(contour.warnings[0].find("foil.dat: read as an airfoil"), std::string::npos);
  }
  expect_error("a square\n0 0\n1 0\n1 1\n.5 1\n0 1\n", {"map.xy:1", "put '#' before it"});
  EXPECT_EQ(parse_xy("3 3\n0 0\n.5 .1\n1 .01\n.5 -.05\n1 -.01\n", "map.xy").warnings.size(), 0u);
}

TEST(Contour, OtherEncodingsAndNumbersAreToldWithARemedy) {
  expect_error(std::string("\xFF\xFE"
                           "0\0 \0",
                           6),
               {"map.xy:1", "UTF-16", "iconv"});
  expect_error(std::string("0\0 \0000\0\n\0", 9), {"map.xy:1", "zero bytes", "UTF-8"});
  expect_error("{\"type\": \"Polygon\"}", {"map.xy:1", "GeoJSON"});
  expect_error("0 0\n1 0\n0 1\nNaN NaN\n0 0\n", {"map.xy:4", "blank line", "'>'"});
  expect_error("0 0\n1 0\n0.5 1e200\n", {"map.xy:3", "at most 1e+30", "1e+200"});
  const Contour small = parse_xy("0 0\n1e-310 0\n0 1e-310\n", "map.xy");
  EXPECT_NE(message_of<GeometryError>([&] { fit_to_container(small, unit_frame.container()); }).find("1e-310 wide"),
            std::string::npos);
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
  EXPECT_NE(message_of<FileError>([] { read_contour("no/such/file.xy"); }).find("no/such/file.xy"), std::string::npos);
  EXPECT_NE(message_of<FileError>([] { read_contour("."); }), "");
  EXPECT_NE(message_of<FileError>([] { read_contour("no/a.SHP", " (hint)"); }).find("(hint)"), std::string::npos);
  EXPECT_NE(message_of<ConfigError>([] { read_contour("a.kml"); }).find(".geojson"), std::string::npos);
}

TEST(Contour, ReadsAFile) {
  const std::string path = ::testing::TempDir() + "trime_contour_test.xy";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  std::fputs("0 0\n1 0\n0 1\n", file);
  std::fclose(file);
  EXPECT_EQ(read_contour(path).rings[0].points.size(), 3u);
  EXPECT_EQ(read_contour(path).source, path);
  std::remove(path.c_str());
}

} // namespace
} // namespace trime::contours
