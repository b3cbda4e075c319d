// SPDX-License-Identifier: BSD-3-Clause
// Values and slopes between the centres of a raster, and what happens where a file has no values.
#include "fields/field.hpp"
#include "fields/nearest_fill.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace trime::fields {
namespace {

using geometry::Vec2;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Centres at 0, 1, 2, ... in x, and at 10, 12, 14, ... in y.
Raster raster_of(std::int64_t columns, std::int64_t rows, std::vector<double> values) {
  Raster raster;
  raster.x = {0, 1, columns};
  raster.y = {10, 2, rows};
  raster.doubles = std::move(values);
  return raster;
}

Raster plane() {
  std::vector<double> values;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 5; ++i)
      values.push_back(3.0 * i - 2.0 * (10 + 2 * j) + 1);
  return raster_of(5, 4, values);
}

TEST(Field, IsExactOnAPlane) {
  const Field field(plane(), 0, 0);
  for (const Vec2 p : {Vec2{0, 10}, Vec2{4, 16}, Vec2{0.25, 11}, Vec2{3.9, 15.5}, Vec2{2, 13}}) {
    EXPECT_NEAR(field.value(p), 3 * p.x - 2 * p.y + 1, 1e-12) << p.x << ' ' << p.y;
    EXPECT_NEAR(field.gradient(p).x, 3, 1e-12);
    EXPECT_NEAR(field.gradient(p).y, -2, 1e-12);
  }
}

TEST(Field, HasTheNearestValueOutside) {
  const Field field(plane(), 0, 0);
  EXPECT_DOUBLE_EQ(field.value({-5, 12}), field.value({0, 12}));
  EXPECT_DOUBLE_EQ(field.value({9, 12.5}), field.value({4, 12.5}));
  EXPECT_DOUBLE_EQ(field.value({9, 99}), field.value({4, 16}));
  EXPECT_EQ(field.gradient({-5, 12}).x, 0);
  EXPECT_NEAR(field.gradient({-5, 12}).y, -2, 1e-12);
  EXPECT_EQ(field.gradient({2, 99}).y, 0);
}

TEST(Field, LooksUpPlacesInThePeriodAroundTheMiddle) {
  const Field field(plane(), 360, 2);
  EXPECT_DOUBLE_EQ(field.value({361.5, 13}), field.value({1.5, 13}));
  EXPECT_DOUBLE_EQ(field.value({-357, 13}), field.value({3, 13}));
}

TEST(Field, MayHaveOneColumnOrOneRow) {
  const Field column(raster_of(1, 3, {1, 2, 4}), 0, 0), row(raster_of(3, 1, {1, 2, 4}), 0, 0);
  EXPECT_DOUBLE_EQ(column.value({7, 13}), 3);
  EXPECT_DOUBLE_EQ(row.value({1.5, -7}), 3);
  EXPECT_EQ(column.gradient({0, 11}).x, 0);
}

TEST(Field, CountsOnlyGivenValuesWhereThereAreAny) {
  Raster raster = raster_of(3, 2, {1, none, none, 3, none, none});
  fill_with_nearest(raster);
  for (std::size_t k = 0; k < raster.size(); ++k)
    EXPECT_EQ(raster.is_filled(k), k % 3 != 0) << k;
  const Field field(raster, 0, 0);
  EXPECT_DOUBLE_EQ(field.value({0.9, 10}), 1); // not the mean with what was filled
  EXPECT_DOUBLE_EQ(field.value({0.9, 11}), 2);
  EXPECT_DOUBLE_EQ(field.value({1.5, 12}), 3); // all around were filled
}

TEST(NearestFill, FindsTheNearestCentre) {
  constexpr int columns = 17, rows = 11;
  std::vector<double> values(columns * rows, none);
  const std::vector<std::size_t> given{3, 40, 77, 100, 151, 180};
  for (const std::size_t k : given)
    values[k] = static_cast<double>(k);
  Raster raster = raster_of(columns, rows, values);
  fill_with_nearest(raster);
  const auto place = [&](std::size_t k) {
    return Vec2{raster.x.at(static_cast<double>(k % columns)), raster.y.at(static_cast<double>(k / columns))};
  };
  const auto distance = [&](std::size_t a, std::size_t b) {
    const Vec2 way = place(a) - place(b);
    return std::hypot(way.x, way.y);
  };
  for (std::size_t k = 0; k < raster.size(); ++k) {
    double least = std::numeric_limits<double>::max();
    for (const std::size_t other : given)
      least = std::min(least, distance(k, other));
    EXPECT_DOUBLE_EQ(distance(k, static_cast<std::size_t>(raster.value(k))), least) << k;
  }
}

TEST(NearestFill, LeavesARasterWithoutGapsAlone) {
  Raster raster = plane();
  fill_with_nearest(raster);
  EXPECT_TRUE(raster.filled.empty());
  EXPECT_EQ(raster.doubles, plane().doubles);
}

} // namespace
} // namespace trime::fields
