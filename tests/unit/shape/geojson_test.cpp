// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON as maps have it: rings with their lines, and what a user reads when it is something else.
#include "trime/core/error.hpp"
#include "trime/shape/contour.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <string>

namespace trime::shape {
namespace {

using geometry::Vec2;

const std::string feature_collection = R"({"type": "FeatureCollection", "name": "coast",
 "features": [
  {"type": "Feature", "properties": {"name": "main", "bbox": [1, 2], "list": [[1, 2], [3, 4]]},
   "geometry": {"coordinates": [[[0, 0], [8, 0],
      [8, 8, 3.5], [0, 8],
      [0, 0]],
     [[2, 2], [2, 4], [4, 4], [2, 2]]], "type": "Polygon"}},
  {"type": "Feature", "properties": null, "geometry": {"type": "MultiPolygon",
   "coordinates": [[[[10, 0], [12, 0], [12, 1e0], [10, 0]]], [[[20, 0], [21, 0],
     [21, 1]]]]}}
]})";

std::string error_of(const std::string& text) {
  return message_of<GeometryError>([&] { parse_geojson(text, "a.geojson"); });
}

std::string geometry_of(const std::string& type, const std::string& coordinates) {
  return "{\"type\": \"" + type + "\",\n\"coordinates\": " + coordinates + "}";
}

TEST(GeoJson, ReadsAllRingsOfACollectionWithTheirLines) {
  const Contour contour = parse_geojson(feature_collection, "a.geojson");
  ASSERT_EQ(contour.rings.size(), 4u);
  EXPECT_EQ(contour.rings[0].points, (std::vector<Vec2>{{0, 0}, {8, 0}, {8, 8}, {0, 8}}));
  EXPECT_EQ(contour.rings[0].lines, (std::vector<int>{4, 4, 5, 5}));
  EXPECT_EQ(contour.rings[1].points, (std::vector<Vec2>{{2, 2}, {2, 4}, {4, 4}}));
  EXPECT_EQ(contour.rings[1].lines, (std::vector<int>{7, 7, 7}));
  EXPECT_EQ(contour.rings[2].points, (std::vector<Vec2>{{10, 0}, {12, 0}, {12, 1}}));
  EXPECT_EQ(contour.rings[3].points, (std::vector<Vec2>{{20, 0}, {21, 0}, {21, 1}})); // not closed, and still a polygon
  EXPECT_TRUE(contour.warnings.empty());
}

TEST(GeoJson, ReadsBareGeometriesCollectionsOfThemAndClosedLines) {
  const std::string ring = "[[0, 0], [1, 0], [0, 1], [0, 0]]";
  EXPECT_EQ(parse_geojson(geometry_of("Polygon", "[" + ring + "]"), "a").rings.size(), 1u);
  EXPECT_EQ(parse_geojson(geometry_of("LineString", ring), "a").rings.size(), 1u);
  EXPECT_EQ(parse_geojson(geometry_of("MultiLineString", "[" + ring + ", " + ring + "]"), "a").rings.size(), 2u);
  const Contour contour =
      parse_geojson("\xEF\xBB\xBF{\"type\": \"GeometryCollection\", \"geometries\": [" +
                        geometry_of("Point", "[3, 4]") + ",\n" + geometry_of("Polygon", "[" + ring + "]") + "]}",
                    "a");
  EXPECT_EQ(contour.rings.size(), 1u);
  ASSERT_EQ(contour.warnings.size(), 1u);
  EXPECT_EQ(contour.warnings[0].find("a:2: 1 geometry of type Point or the like left out"), 0u) << contour.warnings[0];
}

TEST(GeoJson, TheEndingOfTheFileDecides) {
  EXPECT_EQ(parse_contour(feature_collection, "dir/A.GeoJSON").rings.size(), 4u);
  EXPECT_EQ(parse_contour(feature_collection, "a.json").rings.size(), 4u);
  EXPECT_EQ(parse_contour("0 0\n1 0\n0 1\n", "a.xy").rings.size(), 1u);
  EXPECT_NE(message_of<GeometryError>([] { parse_contour(feature_collection, "a.xy"); }), "");
}

TEST(GeoJson, MistakesAreLocated) {
  const auto expect = [](const std::string& text, const std::string& start, const std::string& words) {
    const std::string message = error_of(text);
    EXPECT_EQ(message.find(start), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect("{\"type\": \"Polygon\",\n\"coordinates\": [[[0, 0], [1 0]]]}", "a.geojson:2: ", "expected JSON, found");
  expect("0 0\n1 0\n", "a.geojson:1: ", "expected JSON");
  expect("", "a.geojson:1: ", "expected JSON");
  expect(feature_collection.substr(0, 200), "a.geojson:", "expected JSON");
  expect(geometry_of("Polygon", "[[[0, 0],\n[1], [1, 1]]]"), "a.geojson:3: ", "two numbers [x, y]");
  expect(geometry_of("Polygon", "[[[0, 0],\n[\"1\", 2], [1, 1]]]"), "a.geojson:3: ", "expected numbers");
  expect(geometry_of("Polygon", "[[[0, 0], [1, 0], [0, 0]]]"), "a.geojson:2: ", "2 distinct vertices");
  expect(geometry_of("Polygon", "[[[0, 0],\n\n[1e31, 0], [0, 1]]]"), "a.geojson:4: ", "1e+31");
  expect(geometry_of("LineString", "[[0, 0], [1, 0],\n[0, 1]]"), "a.geojson:3: ", "close it, or make a polygon");
  expect(geometry_of("Point", "[0, 0]"), "a.geojson: ", "found no vertex at all");
  expect("[1, 2]", "a.geojson: ", "found no vertex at all");
  expect("{\"type\": \"Topology\", \"arcs\": [[[0, 0], [1, 1]]]}", "a.geojson: ", "Polygon or MultiPolygon");
}

} // namespace
} // namespace trime::shape
