// SPDX-License-Identifier: BSD-3-Clause
// Files of meshing programs, .poly and JIGSAW's .msh: rings and markers of their segments, and contours as bytes.
#include "contours/segment_rings.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <string>

namespace trime::contours {
namespace {

using geometry::Frame;
using geometry::Vec2;
using shape::message_of;
using shape::Part;
using shape::RegionShape;

const Frame unit_frame(geometry::Box{{0, 0}, {1, 1}});

/// Squares with the sides 8, 6, 4 and 2 around (4, 4), each with its side as marker.
std::string nested(const std::string& holes) {
  std::string vertices, segments;
  for (int k = 0; k < 4; ++k)
    for (int corner = 0; corner < 4; ++corner) {
      const int low = k, high = 8 - k, i = 4 * k + corner;
      vertices += fmt::format("{} {} {} 9.5\n", i, corner == 1 || corner == 2 ? high : low, corner > 1 ? high : low);
      segments += fmt::format("{} {} {} {}\n", i, i, 4 * k + (corner + 1) % 4, high - low);
    }
  return "16 2 1 0\n" + vertices + "16 1\n" + segments + holes;
}

/// Sides of the squares that remain.
std::vector<double> sides(const Contour& contour) {
  std::vector<double> found;
  for (const ContourRing& ring : contour.rings)
    found.push_back(ring.points[1].x - ring.points[0].x);
  return found;
}

TEST(Poly, HolePointsSayWhatIsMeshed) {
  // Nothing is a hole; the second area; the second and the fourth; the first: then the second bounds.
  EXPECT_EQ(sides(parse_poly(nested("0\n"), "a.poly")), (std::vector<double>{8}));
  EXPECT_EQ(sides(parse_poly(nested("1\n0 1.5 4\n"), "a.poly")), (std::vector<double>{8, 6, 4}));
  EXPECT_EQ(sides(parse_poly(nested("2\n0 1.5 4\n1 4 4\n"), "a.poly")), (std::vector<double>{8, 6, 4, 2}));
  EXPECT_EQ(sides(parse_poly(nested("1\n0 0.5 4\n"), "a.poly")), (std::vector<double>{6}));
  EXPECT_EQ(parse_poly(nested("1\n0 1.5 4\n"), "a.poly").warnings.size(), 1u); // of the innermost ring
  EXPECT_EQ(parse_poly(nested("1\n0 9 9\n"), "a.poly").warnings.size(), 2u);   // outside; three rings
  EXPECT_NE(message_of<GeometryError>([] { parse_poly(nested("4\n0 .5 4\n1 1.5 4\n2 2.5 4\n3 4 4\n"), "a.poly"); }),
            "");
}

TEST(Poly, OpenLinesAreLeftOutWithAWarning) {
  // A square with a fault line inside, and a line of two segments that begins at a corner; its ends meet in one vertex.
  const std::string vertices = "8 2 0 0\n1 0 0\n2 8 0\n3 8 8\n4 0 8\n5 3 3\n6 6 5\n7 2 4\n8 2 4\n";
  const std::string square = "1 1 2\n2 2 3\n3 3 4\n4 4 1\n";
  const Contour contour = parse_poly(vertices + "7 0\n" + square + "5 5 6\n6 8 7\n7 1 7\n0\n", "a.poly");
  EXPECT_EQ(sides(contour), (std::vector<double>{8}));
  ASSERT_EQ(contour.warnings.size(), 2u); // of the segment without length, too
  EXPECT_EQ(contour.warnings[1], "a.poly:15: 2 segments of open lines are left out (the first one begins at (3, 3)); "
                                 "only closed rings bound the mesh");
  // Nothing but open lines is a mistake, and so is an open ring around a hole point, since nothing is left to mesh.
  const auto error = [&](const std::string& rest) {
    return message_of<GeometryError>([&] { parse_poly(vertices + rest, "a.poly"); });
  };
  EXPECT_NE(error("3 0\n1 1 2\n2 2 3\n3 3 4\n0\n").find("1 segment ends at vertex"), std::string::npos);
  EXPECT_NE(error("5 0\n" + square + "5 5 6\n1\n1 4 4\n").find("1 segment ends at vertex 5"), std::string::npos);
}

TEST(Poly, KeepsMarkersAndLines) {
  const Contour contour = parse_poly(nested("2\n0 1.5 4\n1 4 4\n"), "a.poly");
  EXPECT_EQ(contour.rings[1].markers, (std::vector<int>{6, 6, 6, 6}));
  EXPECT_EQ(contour.rings[1].lines, (std::vector<int>{6, 7, 8, 9}));
}

TEST(Poly, VerticesMayStandInAnotherText) {
  const std::string segments = "3 0\n1 1 2\n2 2 3\n3 3 1\n0\n";
  const Contour contour = parse_poly("0 2 0 0\n" + segments, "a.poly", "# node\n3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
  EXPECT_EQ(contour.rings[0].points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_TRUE(contour.rings[0].markers.empty());
  const std::string error =
      message_of<GeometryError>([&] { parse_poly("0 2 0 0\n" + segments, "a.poly", "3 2 0 0\n1 0 0\n5 1 0\n"); });
  EXPECT_NE(error.find("a.node:3: expected vertex 2"), std::string::npos) << error;
}

TEST(SegmentRings, PartWhereTheyMeet) {
  // A bow tie of two triangles in vertex 0, its segments in no order.
  const std::vector<FileVertex> vertices{
      {{0, 0}, 1, 0}, {{1, 1}, 2, 1}, {{1, -1}, 3, 2}, {{-1, 1}, 4, 3}, {{-1, -1}, 5, 4}};
  std::vector<std::string> warnings;
  const auto rings = rings_of_segments(
      vertices, {{0, 1, 1, 6}, {3, 0, 2, 7}, {2, 0, 3, 8}, {4, 3, 4, 9}, {1, 2, 5, 10}, {0, 4, 6, 11}, {1, 0, 7, 12}},
      "a", warnings);
  ASSERT_EQ(rings.size(), 2u);
  EXPECT_EQ(rings[0].size(), 3u);
  EXPECT_EQ(rings[1].size(), 3u);
  ASSERT_EQ(warnings.size(), 1u); // the last segment is the first, reversed
  EXPECT_NE(warnings[0].find("a:12: this segment is ignored"), std::string::npos) << warnings[0];
}

TEST(Jigsaw, ReadsEdgesWithTheirTags) {
  const Contour contour =
      parse_jigsaw("mshid=3\nndims=2\npoint=3\n0;0;5\n1;0;5\n0;1;5\nedge2=3\n0;1;0\n1;2;4\n2;0;0\n", "a.msh");
  ASSERT_EQ(contour.rings.size(), 1u);
  EXPECT_EQ(contour.rings[0].points, (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(contour.rings[0].markers, (std::vector<int>{0, 4, 0}));
}

TEST(Jigsaw, EdgesWithoutPointsAreRefused) {
  try {
    parse_jigsaw("mshid=3\nedge2=1\n0;1;0\n", "a.msh");
    ADD_FAILURE() << "no points, and no error";
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("a.msh: expected points"), std::string::npos) << error.what();
  }
}

TEST(Contour, GoesThroughBytes) {
  Contour contour = parse_poly(nested("2\n0 1.5 4\n1 4 4\n"), "a.poly");
  contour.crs = "EPSG:32633";
  contour.warnings = {"one", ""};
  contour.marker_names = {"land", "open sea"};
  contour.rings[0].in_file = contour.rings[1].points;
  const Contour read = contour_of_bytes(to_bytes(contour));
  EXPECT_EQ(read.marker_names, contour.marker_names);
  ASSERT_EQ(read.rings.size(), contour.rings.size());
  for (std::size_t k = 0; k < read.rings.size(); ++k) {
    EXPECT_EQ(read.rings[k].points, contour.rings[k].points);
    EXPECT_EQ(read.rings[k].lines, contour.rings[k].lines);
    EXPECT_EQ(read.rings[k].markers, contour.rings[k].markers);
    EXPECT_EQ(read.rings[k].in_file, contour.rings[k].in_file);
  }
  EXPECT_EQ(read.source, contour.source);
  EXPECT_EQ(read.warnings, contour.warnings);
  EXPECT_EQ(read.crs, contour.crs);
}

TEST(Contour, MarkersSurviveWhereRingsAreParted) {
  // A hole with the marker 3 touches the middle of the lower side, whose marker is 2.
  Contour contour =
      make_contour({{{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}}, {{0.5, 0.1}, {0.6, 0.3}, {0.4, 0.3}}}, "a");
  contour.rings[0].markers = {2, 0, 0, 0};
  contour.rings[1].markers = {3, 3, 3};
  const RegionShape shape({Part::contour("sea", contour, {}, unit_frame)}, "sea", unit_frame);
  const geometry::Boundary& boundary = shape.boundary();
  EXPECT_EQ(boundary.part_names, (std::vector<std::string>{"sea", "sea.2", "sea.3"}));
  EXPECT_EQ(shape.domain().part_markers(), (std::vector<std::int32_t>{0, 2, 3}));
  ASSERT_EQ(boundary.loops.size(), 1u);
  int with_two = 0, with_three = 0;
  for (const geometry::Piece& piece : boundary.loops[0].pieces) {
    with_two += piece.part == 1 ? 1 : 0;
    with_three += piece.part == 2 ? 1 : 0;
  }
  EXPECT_EQ(with_two, 2);
  EXPECT_EQ(with_three, 3);
}

} // namespace
} // namespace trime::contours
