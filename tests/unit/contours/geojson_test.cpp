// SPDX-License-Identifier: BSD-3-Clause
// GeoJSON as maps have it: rings with their lines, and what a user reads when it is something else.
#include "contours/feature_rings.hpp"
#include "contours/map_features.hpp"
#include "trime/contours/contour.hpp"
#include "trime/core/error.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <limits>
#include <string>

namespace trime::contours {
namespace {

using geometry::Frame;
using geometry::Vec2;
using shape::message_of;
using shape::Part;

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
  EXPECT_EQ(contour.rings[0].lines, (std::vector<int>{1, 1, 1, 1})); // numbers of features
  EXPECT_EQ(contour.rings[1].points, (std::vector<Vec2>{{2, 2}, {2, 4}, {4, 4}}));
  EXPECT_EQ(contour.rings[1].lines, (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(contour.rings[2].points, (std::vector<Vec2>{{10, 0}, {12, 0}, {12, 1}}));
  EXPECT_EQ(contour.rings[3].points, (std::vector<Vec2>{{20, 0}, {21, 0}, {21, 1}})); // not closed, and still a polygon
  EXPECT_EQ(contour.rings[3].lines, (std::vector<int>{2, 2, 2}));
  ASSERT_EQ(contour.features.size(), 2u);
  EXPECT_EQ(where(contour, 1), "a.geojson:4 (feature 1, 'main')");
  EXPECT_EQ(where(contour, 2), "a.geojson:9 (feature 2)");
  EXPECT_EQ(line_or_feature(contour, 1), "feature 1, 'main'");
  EXPECT_TRUE(contour.warnings.empty());
}

TEST(GeoJson, FeaturesAreNamedByTheMostTellingAttribute) {
  const auto named = [](const std::string& feature) {
    const Contour contour =
        parse_geojson(R"({"features": [{"type": "Feature", )" + feature +
                          R"(, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [8, 0], [8, 8]]]}}]})",
                      "a.geojson");
    return where(contour, 1);
  };
  EXPECT_EQ(named(R"("properties": {"kind": "x", "NAME_1": "Fyn", "name_en": "Funen", "id": 3})"),
            "a.geojson (feature 1, 'Fyn')");
  EXPECT_EQ(named(R"("properties": {"id": 3, "Name": "Als", "NAME_1": "Fyn"})"), "a.geojson (feature 1, 'Als')");
  EXPECT_EQ(named(R"("id": "way/17", "properties": {"area": 4.5})"), "a.geojson (feature 1, 'way/17')");
  EXPECT_EQ(named(R"("properties": {"osm_id": 4711, "tags": {"name": "no"}})"), "a.geojson (feature 1, '4711')");
  EXPECT_EQ(named(R"("properties": {"kind": "x"})"), "a.geojson (feature 1)");
}

TEST(GeoJson, EdgesThatCrossAreThoseOfFeatures) {
  const std::string map = R"({"type": "FeatureCollection", "features": [
    {"type": "Feature", "properties": {"name": "Als"}, "geometry": {"type": "Polygon", "coordinates":
     [[[0, 0], [0.5, 0], [0.5, 0.5], [0, 0.5]]]}},
    {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
     [[[0.4, 0.1], [0.6, 0.1], [0.6, 0.2]]]}}]})";
  const Frame frame({{0, 0}, {1, 1}});
  Contour contour = parse_geojson(map, "a.geojson");
  const auto refused = [&] {
    return message_of<GeometryError>([&] { Part::contour("land", contour, Normalization(), frame); });
  };
  EXPECT_EQ(refused().find("a.geojson:3 (feature 1, 'Als'): an edge crosses an edge of feature 2 near (0.5, 0.1); "),
            0u)
      << refused();
  contour.rings[1].polygon = contour.rings[0].polygon;
  EXPECT_NE(refused().find("rings of one polygon must not cross; ogr2ogr -makevalid"), std::string::npos) << refused();
  for (ContourRing& ring : contour.rings) { // as a projection does it
    ring.in_file = ring.points;
    for (Vec2& p : ring.in_file)
      p = {10 * p.x, 50 + p.y};
  }
  contour.in_degrees = true;
  EXPECT_NE(refused().find(" near longitude 5, latitude 50.1;"), std::string::npos) << refused();
}

TEST(GeoJson, ErrorsNameTheFeatureAndItsName) {
  const auto file_with = [](const std::string& properties, const std::string& coordinates) {
    return R"({"type": "FeatureCollection", "features": [
      {"type": "Feature", "properties": {"name": "main"},
       "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [8, 0], [8, 8], [0, 0]]]}},
      {"type": "Feature", "properties": )" +
           properties + R"(,
       "geometry": {"type": "LineString", "coordinates": )" +
           coordinates + "}}\n]}";
  };
  const std::string two = "[[0, 0], [1, 0], [0, 0]]", open = "[[0, 0], [1, 0], [1, 1]]", far = "[[0, 0], [1, 1e300]]";
  EXPECT_EQ(error_of(file_with("null", two)).find("a.geojson:5 (feature 2): the ring that starts here"), 0u);
  EXPECT_EQ(error_of(file_with(R"({"name": "Sylt"})", two)).find("a.geojson:5 (feature 2, 'Sylt'): the ring"), 0u);
  EXPECT_EQ(error_of(file_with(R"({"name": "Sylt"})", open)).find("a.geojson:5 (feature 2, 'Sylt'): expected"), 0u);
  EXPECT_EQ(error_of(file_with("{}", far)).find("a.geojson:5 (feature 2): expected finite coordinates"), 0u);
  EXPECT_EQ(error_of(file_with("{}", "[[0, 0], [1, null]]")).find("a.geojson:5 (feature 2): expected only numbers in"),
            0u);
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
  for (const char* name : {"a.xy", "a.txt", "a.poly", "a.msh"})
    EXPECT_NE(message_of<GeometryError>([&] { parse_contour("\n " + std::string(feature_collection), name); })
                  .find(std::string(name) + ":2: expected a contour of the type that the ending of the file name says, "
                                            "found GeoJSON; rename the file to NAME.geojson"),
              std::string::npos);
}

TEST(GeoJson, MistakesAreLocated) {
  const auto expect = [](const std::string& text, const std::string& start, const std::string& words) {
    const std::string message = error_of(text);
    EXPECT_EQ(message.find(start), 0u) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect("{\"type\": \"Polygon\",\n\"coordinates\": [[[0, 0], [1 0]]]}", "a.geojson:2: ", "expected JSON, found");
  expect("0 0\n1 0\n", "a.geojson: ", "expected JSON, found '0' at character 3");
  expect("", "a.geojson: ", "expected JSON");
  expect(feature_collection.substr(0, 200), "a.geojson:", "expected JSON");
  expect(geometry_of("Polygon", "[[[0, 0],\n[1], [1, 1]]]"), "a.geojson:3: ", "two numbers [x, y]");
  expect(geometry_of("Polygon", "[[[0, 0],\n[\"1\", 2], [1, 1]]]"), "a.geojson:3: ", "expected only numbers in");
  expect(geometry_of("Polygon", "[[[0, 0], [1, 0], [0, 0]]]"), "a.geojson:2: ", "2 distinct vertices");
  expect(geometry_of("Polygon", "[[[0, 0],\n\n[1e31, 0], [0, 1]]]"), "a.geojson:4: ", "1e+31");
  expect(geometry_of("LineString", "[[0, 0], [1, 0],\n[0, 1]]"),
         "a.geojson:2: ", "whose end at (0, 0) no other line shares; close the ring, or make it a polygon");
  expect(geometry_of("Point", "[0, 0]"), "a.geojson: ", "found only geometries of type Point or");
  expect("[1, 2]", "a.geojson: ", "found no vertex at all");
  expect("{\"type\": \"Topology\", \"arcs\": [[[0, 0], [1, 1]]]}", "a.geojson: ", "Polygon or MultiPolygon");
}

std::string feature(const std::string& properties, const std::string& type, const std::string& coordinates) {
  return R"({"type": "Feature", "geometry": )" + geometry_of(type, coordinates) + R"(, "properties": {)" + properties +
         "}}";
}
std::string collection(const std::string& features) {
  return R"({"type": "FeatureCollection", "crs": {"properties": {"name": "EPSG:4326"}}, "features": [)" + features +
         "]}";
}

TEST(GeoJson, AnAttributeNamesTheRingsOfAFeature) {
  const std::string square = "[[[0, 0], [9, 0], [9, 9], [0, 9]]]", lake = "[[[1, 1], [2, 1], [1, 2]]]",
                    pond = "[[[4, 4], [5, 4], [4, 5]]]";
  const Contour named =
      parse_geojson(collection(feature(R"("name": " coast\nof ice", "id": 5)", "Polygon", square) + "," +
                               feature(R"("a": {"name": "deep"}, "name": null)", "Polygon", lake) + "," +
                               feature(R"("name": 7)", "Polygon", pond)),
                    "a", "name");
  EXPECT_EQ(named.marker_names, (std::vector<std::string>{"coast of ice", "7"}));
  EXPECT_EQ(named.rings[0].markers, (std::vector<int>{1, 1, 1, 1}));
  EXPECT_TRUE(named.rings[1].markers.empty());
  EXPECT_EQ(named.rings[2].markers, (std::vector<int>{2, 2, 2}));
  const Contour numbered = parse_geojson(collection(feature(R"("tag": -7)", "Polygon", square) + "," +
                                                    feature(R"("tag": "12")", "Polygon", lake) + "," +
                                                    feature(R"("tag": 0)", "Polygon", pond)),
                                         "a", "tag");
  EXPECT_TRUE(numbered.marker_names.empty());
  EXPECT_EQ(numbered.rings[0].markers, (std::vector<int>{-7, -7, -7, -7}));
  EXPECT_EQ(numbered.rings[1].markers, (std::vector<int>{12, 12, 12}));
  EXPECT_TRUE(numbered.rings[2].markers.empty());
  EXPECT_TRUE(parse_geojson(feature(R"("tag": 3)", "Polygon", square), "a").rings[0].markers.empty());
}

TEST(GeoJson, ALakeThatIsAHoleAndAFeatureHasTheNameThatStandsFirst) {
  const std::string lake = "[[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]]",
                    land = "[[[0, 0], [9, 0], [9, 9], [0, 9]], " + lake + "]";
  const Frame frame(geometry::Box{{0, 0}, {9, 9}});
  for (const std::string second : {"lake", "land"}) {
    const Contour contour =
        parse_geojson(collection(feature(R"("name": "land")", "Polygon", land) + ",\n" +
                                 feature("\"name\": \"" + second + '"', "Polygon", "[" + lake + "]")),
                      "a", "name");
    const Part part = Part::contour("map", contour, fit_to_container(contour, frame.container()), frame);
    EXPECT_EQ(part.boundary().size(), 2u);
    ASSERT_EQ(part.warnings().size(), 1u);
    EXPECT_NE(part.warnings()[0].find("used once"), std::string::npos) << part.warnings()[0];
    EXPECT_EQ(part.warnings()[0].find("names or markers that stand there") != std::string::npos, second == "lake");
  }
}

/// Only values right inside of `properties` of a feature are attributes, and what stands in there is no geometry.
TEST(GeoJson, WhatLooksLikeAnAttributeOrAFeatureIsNone) {
  const std::string square = "[[[0, 0], [9, 0], [9, 9], [0, 9]]]", lake = "[[[1, 1], [2, 1], [1, 2]]]";
  const std::string odd = R"("kind": "land", "type": "Feature", "names": ["x", {"kind": "no"}], "of": {"kind": "no"},
    "was": {"type": "Polygon", "coordinates": [[[5, 5], [6, 5], ["six", 6]]]})";
  const std::string text =
      R"({"type": "FeatureCollection", "properties": {"kind": "whole", "date": "today"}, "features": [)" +
      feature(odd, "Polygon", square) + "," + feature(R"("kind": ["a", "b"], "id": 7)", "Polygon", lake) + "]}";
  const Contour named = parse_geojson(text, "a", "kind");
  EXPECT_EQ(named.marker_names, std::vector<std::string>{"land"});
  ASSERT_EQ(named.rings.size(), 2u);
  EXPECT_EQ(named.rings[0].markers, (std::vector<int>{1, 1, 1, 1}));
  EXPECT_TRUE(named.rings[1].markers.empty());
  EXPECT_EQ(message_of<ConfigError>([&] { parse_geojson(text, "a", "date"); }),
            "a: expected features with the attribute 'date', found only id, kind, names, of, type, was");
  const std::string before = R"({"properties": {"kind": 3}, "style": {"type": "Feature"}, "geometry": )" +
                             geometry_of("Polygon", square) + R"(, "style": {"type": "Feature"}, "type": "Feature"})";
  EXPECT_EQ(parse_geojson(before, "a", "kind").rings.at(0).markers, (std::vector<int>{3, 3, 3, 3}));
}

TEST(GeoJson, OpenLinesThatJoinInTheirEndsAreOneRing) {
  const Contour contour =
      parse_geojson(collection(feature(R"("kind": "land")", "LineString", "[[0, 0], [0, 1], [1, 1]]") + "," +
                               feature(R"("kind": "open")", "LineString", "[[0, 0], [1, 0], [1, 1]]")),
                    "a", "kind");
  ASSERT_EQ(contour.rings.size(), 1u);
  EXPECT_EQ(contour.rings[0].points, (std::vector<Vec2>{{0, 0}, {0, 1}, {1, 1}, {1, 0}}));
  EXPECT_EQ(contour.rings[0].markers, (std::vector<int>{1, 1, 2, 2}));
  EXPECT_EQ(contour.marker_names, (std::vector<std::string>{"land", "open"}));
}

TEST(GeoJson, TheFirstLineIsNotNamed) { // most programs write a map in one line
  const std::string open = "[[0, 0], [1, 0], [0, 1]]", square = "[[0, 0], [0, 0], [1, 0], [0, 1], [0, 0]]";
  const std::string start = R"({"type": "Feature", "properties": {"name": "bay"}, "geometry": {"type": )";
  const auto line = [&](const char* type, const std::string& places) {
    return R"({"features": [)" + start + "\"" + type + R"(", "coordinates": )" + places + "}}]}";
  };
  EXPECT_EQ(error_of(line("LineString", open)).find("a.geojson (feature 1, 'bay'): "), 0u);
  EXPECT_EQ(parse_geojson(line("Polygon", "[" + square + "]"), "a.geojson").warnings.at(0),
            "a.geojson (feature 1, 'bay'): vertex (0, 0) repeats the one before it; the two are merged");
}

const std::string upper = "[[0, 0], [0, 1], [1, 1]]", lower = "[[0, 0], [1, 0], [1, 1]]";

TEST(GeoJson, ASpikeOfALineIsKeptForTheRepair) {
  const std::string spike = "[[0, 0], [0, 1], [0.5, 1], [0.5, 1], [0.5, 3], [0.5, 1], [1, 1]]";
  const Contour contour = parse_geojson(collection(feature(R"("name": "land")", "LineString", spike) + "," +
                                                   feature(R"("name": "open")", "LineString", lower)),
                                        "a");
  ASSERT_EQ(contour.rings.size(), 1u);
  EXPECT_EQ(contour.rings[0].points, (std::vector<Vec2>{{0, 0}, {0, 1}, {0.5, 1}, {0.5, 3}, {0.5, 1}, {1, 1}, {1, 0}}));
  EXPECT_EQ(contour.rings[0].lines, (std::vector<int>{1, 1, 1, 1, 1, 2, 2}));
  EXPECT_EQ(contour.warnings.size(), 1u); // of the vertex that occurs twice
}

TEST(GeoJson, ALineThatIsGivenTwiceIsUsedOnce) {
  const Contour contour = parse_geojson(collection(feature(R"("name": "a")", "LineString", upper) + "," +
                                                   feature(R"("name": "b")", "LineString", lower) + "," +
                                                   feature(R"("name": "c")", "LineString", "[[1, 1], [0, 1], [0, 0]]")),
                                        "a");
  ASSERT_EQ(contour.rings.size(), 1u);
  EXPECT_EQ(contour.rings[0].points.size(), 4u);
  ASSERT_EQ(contour.warnings.size(), 1u);
  EXPECT_NE(contour.warnings[0].find("(feature 3, 'c'): this line is the same as an earlier one"), std::string::npos);
}

Contour cut_at_date_line(const std::string& east, const std::string& west) {
  return parse_geojson(collection(feature("", "LineString", east) + "," + feature("", "LineString", west)), "a", "",
                       Faults::collect);
}

TEST(GeoJson, LinesThatAreCutAtTheDateLineAreJoined) {
  const std::string east = "[[180, 1], [179, 1], [179, 0], [180, 0]]";
  const Contour joined = cut_at_date_line(east, "[[-180, 0], [-179, 0], [-179, 1], [-180, 1]]");
  ASSERT_EQ(joined.rings.size(), 1u);
  EXPECT_TRUE(joined.joins_date_line);
  EXPECT_EQ(joined.rings[0].points, (std::vector<Vec2>{{180, 1}, {179, 1}, {179, 0}, {180, 0}, {-179, 0}, {-179, 1}}));
  for (const char* west : {"[[-180, 0], [-179, 0], [-179, 1], [-180, 1.1]]", // ends elsewhere
                           "[[-180, 0], [0, 0], [0, 1], [-180, 1]]"}) {      // long: on which side does it lie?
    const std::string message = message_of<GeometryError>([&] { cut_at_date_line(east, west); });
    EXPECT_NE(message.find("no other line shares"), std::string::npos) << message;
  }
}

/// Shapefiles may hold them. Once the search for lines that stay open never came past such an end.
TEST(FeatureRings, EndsThatAreNoNumbersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Contour contour;
  contour.source = "a.shp";
  FeatureRings rings(contour, "");
  rings.add(FeatureRings::Kind::line, {{{nan, 0}, 7}, {{1, 0}, 7}, {{1, 1}, 7}});
  const std::string message = message_of<GeometryError>([&] {
    rings.end_feature();
    rings.finish("rings", Faults::refuse);
  });
  EXPECT_NE(message.find("a.shp:7: expected finite coordinates"), std::string::npos) << message;
}

TEST(GeoJson, AnAttributeThatNoFeatureHasIsRefused) {
  const std::string one = collection(feature(R"("kind": "land", "id": 3)", "Polygon", "[[[0, 0], [1, 0], [0, 1]]]"));
  const auto refused = [](const std::string& text, const std::string& source) {
    return message_of<ConfigError>([&] { parse_contour(text, source, "name"); });
  };
  EXPECT_EQ(refused(one, "a.json"), "a.json: expected features with the attribute 'name', found only id, kind");
  EXPECT_NE(refused("0 0\n1 0\n0 1\n", "a.xy").find("expected a .geojson or .shp"), std::string::npos);
}

} // namespace
} // namespace trime::contours
