// SPDX-License-Identifier: BSD-3-Clause
// Reference systems: against the series for a meridian, there and back, and what is refused.
#include "projection/projection.hpp"

#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace trime::projection {
namespace {

using geometry::Vec2;

TEST(Projection, ThereAndBackToANanodegree) {
  const std::array<Vec2, 1> middle{Vec2{9, 48}};
  for (const std::string& plane : {std::string("EPSG:32632"), local_plane(middle)}) {
    const Transform transform(lon_lat, plane);
    for (const Vec2 p : {Vec2{9, 48}, Vec2{7.123456789, 46.2}, Vec2{11.9, 50.7}}) {
      const auto there = transform.apply(p);
      ASSERT_TRUE(there);
      const auto back = transform.undo(*there);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x, p.x, 1e-10) << plane;
      EXPECT_NEAR(back->y, p.y, 1e-10) << plane;
    }
  }
}

TEST(Projection, TheLocalPlaneHasMetresAndRightAngles) {
  for (const Vec2 middle : {Vec2{9, 48}, Vec2{180, -16.5}, Vec2{0, 90}, Vec2{-70, 0}}) {
    const std::array<Vec2, 1> points{middle};
    const Transform transform(lon_lat, local_plane(points));
    const Vec2 origin = transform.apply(middle).value();
    EXPECT_NEAR(length(origin), 0, 1e-6);
    const double latitude = middle.y > 89 ? 89.9 : middle.y;
    // One minute to the east and to the north, from a place near the middle.
    const Vec2 base = transform.apply({middle.x, latitude}).value();
    const Vec2 east = transform.apply({middle.x + 1. / 60, latitude}).value() - base,
               north = transform.apply({middle.x, latitude + 1. / 60}).value() - base;
    EXPECT_NEAR(dot(east, north) / (length(east) * length(north)), 0, 2e-4);
    EXPECT_NEAR(length(north), 1852, 15); // a nautical mile, by which latitude it is
  }
}

TEST(Projection, TheMiddleIsAcrossTheDateLineWherePointsAre) {
  const std::array<Vec2, 2> points{Vec2{179, -17}, Vec2{-179, -16}};
  EXPECT_NE(local_plane(points).find("180 "), std::string::npos) << local_plane(points);
  const std::array<Vec2, 2> far{Vec2{0, 0}, Vec2{100, 0}};
  EXPECT_THROW(local_plane(far), GeometryError);
}

TEST(Projection, TheMiddleIsThatOfTheBox) {
  const auto has = [](const std::vector<Vec2>& points, const std::string& middle) {
    return local_plane(points).find(middle) != std::string::npos;
  };
  EXPECT_TRUE(has({{4, 60}, {6, 60}, {6, 61}, {4, 61}}, "+lat_0=60.5 +lon_0=5 "));
  EXPECT_TRUE(has({{4, 60}, {4.1, 60}, {4.2, 60}, {4.3, 60}, {6, 61}}, "+lat_0=60.5 +lon_0=5 ")); // however they lie
  EXPECT_TRUE(has({{179, -17}, {-178, -16}}, "+lat_0=-16.5 +lon_0=-179.5 "));
  EXPECT_TRUE(has({{179, -17}, {182, -16}}, "+lat_0=-16.5 +lon_0=-179.5 "));
  EXPECT_TRUE(has({{358, 10}, {3, 12}}, "+lat_0=11 +lon_0=0.5 "));
  EXPECT_TRUE(has({{0, 60}, {90, 60}, {180, 70}, {-90, 60}}, "+lat_0=90 +lon_0=0 "));
  EXPECT_TRUE(has({{-180, -60}, {-60, -60}, {60, -75}, {180, -60}}, "+lat_0=-90 +lon_0=0 "));
}

TEST(Projection, TellsHowLengthsAreStretched) {
  EXPECT_NEAR(Distortion("EPSG:32633").scale({15, 52}), 0.9996, 1e-6);
  EXPECT_NEAR(Distortion("EPSG:32635").scale({5.5, 52}), 1.026, 2e-3); // two zones and more to the east
  EXPECT_NEAR(Distortion("EPSG:3857").scale({5.5, 60}), 2, 1e-2);
  EXPECT_NEAR(Distortion("+proj=stere +lat_0=52 +lon_0=5 +datum=WGS84").scale({5, 52}), 1, 1e-9);
  EXPECT_THROW(Distortion("EPSG:1"), ConfigError);
}

TEST(Projection, SystemsAreKnownOrRefused) {
  EXPECT_TRUE(is_geographic(lon_lat));
  EXPECT_TRUE(is_geographic("EPSG:4326"));
  EXPECT_FALSE(is_geographic("EPSG:32633"));
  EXPECT_FALSE(is_geographic("+proj=utm +zone=33 +datum=WGS84"));
  EXPECT_NE(well_known_text("EPSG:32633").find("UTM zone 33N"), std::string::npos);
  for (const char* name : {"EPSG:1", "nonsense", "+proj=nowhere", ""}) {
    EXPECT_THROW(is_geographic(name), ConfigError) << name;
    EXPECT_THROW(Transform(lon_lat, name), ConfigError) << name;
  }
}

} // namespace
} // namespace trime::projection
