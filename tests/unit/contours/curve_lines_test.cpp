// SPDX-License-Identifier: BSD-3-Clause
// The lines of curves in files: open lines, rings, attributes, and what is refused.
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

namespace trime::contours {
namespace {

TEST(CurveLines, OfTextMayBeOpen) {
  const Contour read = parse_curves("0 0\n1 0\n\n0 1\n1 1\n1 2\n0 1\n> note\n3 3\n4 4 # end\n", "f.xy");
  ASSERT_EQ(read.rings.size(), 3U);
  EXPECT_TRUE(read.rings[0].open);
  EXPECT_FALSE(read.rings[1].open);
  EXPECT_EQ(read.rings[1].points.size(), 3U);
  EXPECT_TRUE(read.rings[2].open);
  EXPECT_EQ(read.rings[2].lines.back(), 10);
}

TEST(CurveLines, OfMapsHaveMarkers) {
  const Contour read = parse_curves(
      R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"kind":"a"},"geometry":{"type":"LineString","coordinates":[[0,0],[1,0]]}},
{"type":"Feature","properties":{"kind":"b"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}},
{"type":"Feature","properties":{"kind":"a"},"geometry":{"type":"MultiLineString","coordinates":[[[5,5],[6,6]],[[7,7],[8,9]]]}}
]})",
      "f.geojson", "kind");
  ASSERT_EQ(read.rings.size(), 4U);
  EXPECT_TRUE(read.rings[0].open);
  EXPECT_FALSE(read.rings[1].open);
  EXPECT_EQ(read.rings[0].markers, read.rings[2].markers);
  EXPECT_NE(read.rings[0].markers.at(0), read.rings[1].markers.at(0));
  EXPECT_EQ(read.marker_names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(read.rings[3].lines.at(0), 3); // the number of the feature
}

TEST(CurveLines, SurviveTheWayToOtherRanks) {
  const Contour read = contour_of_bytes(to_bytes(parse_curves("0 0\n1 0\n", "f.xy")));
  ASSERT_EQ(read.rings.size(), 1U);
  EXPECT_TRUE(read.rings[0].open);
}

TEST(CurveLines, AreRefused) {
  EXPECT_THROW(parse_curves("", "f.xy"), GeometryError);
  EXPECT_THROW(parse_curves("1 1\n1 1\n", "f.xy"), GeometryError);
  EXPECT_THROW(parse_curves("1 1\nhello\n", "f.xy"), GeometryError);
  EXPECT_THROW(parse_curves("0 0\n1 inf\n", "f.xy"), GeometryError);
  EXPECT_THROW(parse_curves("0 0\n1 1\n", "f.xy", "kind"), ConfigError);
  EXPECT_THROW(read_curves("f.msh"), ConfigError);
}

} // namespace
} // namespace trime::contours
