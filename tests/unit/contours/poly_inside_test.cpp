// SPDX-License-Identifier: BSD-3-Clause
// Regions and curves from the .poly files of Triangle: faces around region points, lines by marker, and what is
// refused.
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace trime::contours {
namespace {

using shape::message_of;

/// A square of side 4 that a segment from (2, 0) to (2, 4) divides; a square hole in the left half; a segment with a
/// free end in the right half.
constexpr const char* divided_square = R"(
11 2 0 0
1 0 0
2 2 0
3 4 0
4 4 4
5 2 4
6 0 4
7 0.5 1
8 1.5 1
9 1.5 2
10 0.5 2
11 3 3
12 1
1 1 2 5
2 2 3 5
3 3 4 6
4 4 5 5
5 5 6 5
6 6 1 7
7 2 5 20
8 7 8 9
9 8 9 9
10 9 10 9
11 10 7 9
12 4 11 30
1
1 1 1.5
)";

std::string with_regions(const std::string& rows) {
  return divided_square + rows;
}

double area_of(const Contour& contour, int marker) {
  double twice = 0;
  std::vector<double> areas;
  for (const ContourRing& ring : contour.rings)
    if (ring.markers.at(0) == marker) {
      double of_ring = 0;
      for (std::size_t k = 0; k < ring.points.size(); ++k)
        of_ring += geometry::cross(ring.points[k], ring.points[(k + 1) % ring.points.size()]);
      twice = areas.empty() ? std::fabs(of_ring) : twice - std::fabs(of_ring); // the outer ring comes first
      areas.push_back(of_ring);
    }
  return twice / 2;
}

TEST(PolyRegions, AreTheFacesAroundTheirPoints) {
  const Contour read = parse_poly_regions(with_regions("2\n1 0.1 0.1 3 -1\n2 3 1 7.5 0.25\n"), "a.poly");
  EXPECT_EQ(read.marker_names, (std::vector<std::string>{"3", "7.5"}));
  EXPECT_EQ(area_of(read, 1), 8 - 1);
  EXPECT_EQ(area_of(read, 2), 8);
  ASSERT_EQ(read.largest_areas.size(), 2U);
  EXPECT_TRUE(std::isinf(read.largest_areas[0]));
  EXPECT_EQ(read.largest_areas[1], 0.25);
  EXPECT_TRUE(read.warnings.empty());
  EXPECT_EQ(contour_of_bytes(to_bytes(read)).largest_areas, read.largest_areas);
}

TEST(PolyRegions, WithOneAttributeAreOne) {
  const Contour read = parse_poly_regions(with_regions("2\n1 0.1 0.1 1 0.5\n2 3 1 1 0.25\n"), "a.poly");
  EXPECT_EQ(read.marker_names, (std::vector<std::string>{"1"}));
  EXPECT_EQ(read.largest_areas, (std::vector<double>{0.25}));
  std::set<int> polygons;
  for (const ContourRing& ring : read.rings)
    polygons.insert(ring.polygon);
  EXPECT_EQ(polygons.size(), 2U);
}

TEST(PolyRegions, WithoutPointsAreTheShape) {
  const Contour read = parse_poly_regions(divided_square, "a.poly");
  EXPECT_TRUE(read.marker_names.empty());
  EXPECT_EQ(read.rings.size(), parse_poly(divided_square, "a.poly").rings.size());
}

TEST(PolyRegions, RefusePointsInNoFaceOrTwiceInOne) {
  const auto refusal = [](const std::string& rows) {
    return message_of<GeometryError>([&] { parse_poly_regions(with_regions(rows), "a.poly"); });
  };
  EXPECT_NE(refusal("1\n1 5 5 1\n").find("(5, 5) lies outside of all segments"), std::string::npos);
  EXPECT_NE(refusal("1\n1 1 1.2 1\n").find("(1, 1.2) lies in a hole"), std::string::npos);
  const std::string two = refusal("2\n1 3 1 1\n2 3 2 1\n");
  EXPECT_NE(two.find("(3, 2) and (3, 1)"), std::string::npos);
  EXPECT_NE(two.find("same face"), std::string::npos);
  EXPECT_NE(refusal("1\n1 3 1 x\n").find("a.poly:30"), std::string::npos);
}

TEST(PolyRegions, NeedSegmentsThatMeetInVertices) {
  const std::string crossed = "4 2 0 0\n1 0 0\n2 2 0\n3 2 2\n4 0 2\n6 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 1 3\n6 2 4\n"
                              "0\n1\n1 1 0.5 1 -1\n";
  EXPECT_NE(message_of<GeometryError>([&] {
              parse_poly_regions(crossed, "a.poly");
            }).find("a.poly:11: this segment and the one in line 12 meet"),
            std::string::npos);
}

TEST(PolyLines, AreDividedByMarker) {
  const Contour read = parse_poly_lines(divided_square, "a.poly");
  std::multiset<std::pair<int, std::size_t>> found; // marker and number of vertices
  for (const ContourRing& ring : read.rings)
    found.emplace(ring.markers.at(0), ring.points.size());
  EXPECT_EQ(found,
            (std::multiset<std::pair<int, std::size_t>>{{5, 3}, {5, 3}, {6, 2}, {7, 2}, {20, 2}, {9, 4}, {30, 2}}));
  for (const ContourRing& ring : read.rings)
    EXPECT_EQ(ring.open, ring.markers[0] != 9);
}

TEST(PolyShape, SaysWhatRegionsAndCurvesWouldRead) {
  const Contour read = parse_poly(with_regions("1\n1 3 1 1\n"), "a.poly");
  ASSERT_FALSE(read.inner_warnings.empty());
  EXPECT_NE(read.inner_warnings.front().find("[region.NAME]"), std::string::npos);
}

} // namespace
} // namespace trime::contours
