// SPDX-License-Identifier: BSD-3-Clause
// Rasters of labels: the polygons of labels cover the cells, share their borders bit for bit, and meet in vertices.
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace trime::contours {
namespace {

using geometry::Vec2;
using shape::message_of;

std::string grid(int columns, int rows, const std::string& values, const std::string& more = "") {
  return "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
         "\nxllcorner 10\nyllcorner 20\ncellsize 0.5\n" + more + values;
}

/// The signed area of the rings of each marker; outer rings run counter-clockwise.
std::map<int, double> areas_of(const Contour& contour) {
  std::map<int, double> areas;
  for (const ContourRing& ring : contour.rings)
    for (std::size_t k = 0; k < ring.points.size(); ++k) {
      const Vec2 a = ring.points[k] - ring.points[0], b = ring.points[(k + 1) % ring.points.size()] - ring.points[0];
      areas[ring.markers.empty() ? 0 : ring.markers[0]] += geometry::cross(a, b) / 2;
    }
  return areas;
}

std::vector<Vec2> sorted(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), geometry::lexicographically_less);
  return points;
}

TEST(LabelRaster, EachLabelIsAPolygon) {
  const Contour read = parse_grid_regions(grid(3, 2, "7 7 -2\n7 3 -2\n"), "a.asc");
  EXPECT_EQ(read.marker_names, (std::vector<std::string>{"-2", "3", "7"}));
  EXPECT_EQ(areas_of(read), (std::map<int, double>{{1, 0.5}, {2, 0.25}, {3, 0.75}}));
  for (const ContourRing& ring : read.rings)
    if (ring.markers[0] == 2) {
      EXPECT_EQ(sorted(ring.points), (std::vector<Vec2>{{10.5, 20}, {10.5, 20.5}, {11, 20}, {11, 20.5}}));
    }
}

TEST(LabelRaster, BordersMeetInVertices) {
  const Contour read = parse_grid_regions(grid(2, 2, "1 1\n2 3\n"), "a.asc");
  for (const ContourRing& ring : read.rings) // the middle of the raster is a vertex of all three
    EXPECT_EQ(std::count(ring.points.begin(), ring.points.end(), Vec2{10.5, 20.5}), 1);
}

TEST(LabelRaster, CellsThatMeetInACornerStayApart) {
  const Contour read = parse_grid_regions(grid(2, 2, "1 2\n2 1\n"), "a.asc");
  EXPECT_EQ(read.rings.size(), 4U);
  EXPECT_EQ(areas_of(read), (std::map<int, double>{{1, 0.5}, {2, 0.5}}));
}

TEST(LabelRaster, RandomLabelsCoverAllCells) {
  std::mt19937 random(3);
  std::string values;
  std::map<int, double> expected;
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 30; ++column) {
      const int label = static_cast<int>(random() % 4);
      expected[label] += label == 0 ? 0 : 0.25;
      values += std::to_string(label) + " ";
    }
    values += "\n";
  }
  expected.erase(0); // no data
  EXPECT_EQ(areas_of(parse_grid_regions(grid(30, 40, values, "NODATA_value 0\n"), "a.asc")), expected);
  const double all = expected[1] + expected[2] + expected[3];
  EXPECT_EQ(areas_of(parse_grid(grid(30, 40, values, "nodata_value 0\n"), "a.asc")), (std::map<int, double>{{0, all}}));
}

TEST(LabelRaster, MayGiveCentresAndTwoSizes) {
  const Contour read = parse_grid("NCOLS 1\nNROWS 2\nXLLCENTER 0.5\nYLLCENTER 1\nDX 1\nDY 2\n5\n5\n", "a.asc");
  ASSERT_EQ(read.rings.size(), 1U);
  EXPECT_EQ(sorted(read.rings[0].points), (std::vector<Vec2>{{0, 0}, {0, 4}, {1, 0}, {1, 4}}));
}

TEST(LabelRaster, RefusesOtherTexts) {
  const auto refusal = [](const std::string& text) {
    return message_of<GeometryError>([&] { parse_grid_regions(text, "a.asc"); });
  };
  EXPECT_NE(refusal("ncols 2\nnrows 1\n1 2\n").find("no line 'cellsize NUMBER'"), std::string::npos);
  EXPECT_NE(refusal(grid(2, 2, "1 2 3\n")).find("2 x 2 values, found only 3"), std::string::npos);
  EXPECT_NE(refusal(grid(2, 1, "1 2\n3\n")).find("a.asc:7: expected the end"), std::string::npos);
  EXPECT_NE(refusal(grid(2, 1, "1 2.5\n")).find("found 2.5 in row 1, column 2"), std::string::npos);
  EXPECT_NE(refusal(grid(1, 1, "9\n", "NODATA_value 9\n")).find("a.asc"), std::string::npos);
  EXPECT_NE(refusal(grid(100'000, 100'000, "9\n")).find("at most 2^26 cells"), std::string::npos);
  EXPECT_THROW(parse_grid_regions("ncols 1\nnrows 1\nxllcorner nan\nyllcorner 0\ncellsize 1\n1\n", "a.asc"),
               GeometryError);
}

} // namespace
} // namespace trime::contours
