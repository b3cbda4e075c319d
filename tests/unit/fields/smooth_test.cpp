// SPDX-License-Identifier: BSD-3-Clause
// The low-pass of a raster: its weights, what it keeps and removes, and values that the file does not have.
#include "fields/smooth.hpp"

#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "fields/field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace trime::fields {
namespace {

template <class Value>
Raster raster_of(std::int64_t columns, std::int64_t rows, const Value& value) {
  Raster raster;
  raster.x = {0, 1, columns};
  raster.y = {0, 1, rows};
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column)
      raster.doubles.push_back(value(column, row));
  return raster;
}

SmoothReach reach_of(double in_row, double in_column) {
  return {[in_row](std::int64_t) { return in_row; }, in_column};
}

double random_value(std::int64_t column, std::int64_t row) {
  return static_cast<double>(random_bits(7, RandomPurpose::test, column, row) % 1000);
}

TEST(Smooth, IsTheWeightedMeanOfItsDefinition) {
  constexpr std::int64_t columns = 13, rows = 150; // three blocks
  Raster raster = raster_of(columns, rows, random_value);
  raster.filled.assign((raster.size() + 7) / 8, 0);
  for (std::size_t k = 0; k < raster.size(); k += 5)
    raster.filled[k / 8] |= static_cast<std::uint8_t>(1 << k % 8);
  const auto width = [](std::int64_t row) { return 2.5 + 0.01 * static_cast<double>(row); };
  constexpr double height = 3.2;
  const Raster smooth = smoothed(raster, {width, height});
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column) {
      double sum = 0, weights = 0;
      for (std::int64_t j = 0; j < rows; ++j)
        for (std::int64_t i = 0; i < columns; ++i)
          if (!raster.is_filled(raster.index(i, j))) {
            const double weight = std::fmax(0, 1 - static_cast<double>(std::abs(i - column)) / width(j)) *
                                  std::fmax(0, 1 - static_cast<double>(std::abs(j - row)) / height);
            sum += weight * raster.value(raster.index(i, j));
            weights += weight;
          }
      EXPECT_NEAR(smooth.value(smooth.index(column, row)), sum / weights, 1e-9) << column << ' ' << row;
    }
}

TEST(Smooth, KeepsAPlaneAndRemovesShortWaves) {
  const auto value = [](std::int64_t column, std::int64_t row) {
    const double wave = std::sin(2 * std::numbers::pi * static_cast<double>(column) / 4);
    return 3.0 * static_cast<double>(column) - 2.0 * static_cast<double>(row) + 100 * wave;
  };
  Raster raster = raster_of(60, 40, value);
  const Field rough(raster, 0, 0), smooth(raster, 0, 0, smoothed(raster, reach_of(8, 8)));
  EXPECT_GT(std::fabs(rough.gradient({30.5, 20.5}).x), 50);
  EXPECT_NEAR(smooth.gradient({30.5, 20.5}).x, 3, 1e-9);
  EXPECT_NEAR(smooth.gradient({30.5, 20.5}).y, -2, 1e-9);
  EXPECT_EQ(smooth.value({30.5, 20.5}), rough.value({30.5, 20.5})) << "only gradients are smoothed";
}

TEST(Smooth, LeavesValuesAloneThatHaveNoOthersAround) {
  Raster raster = raster_of(5, 1, random_value);
  raster.filled = {0b11111};
  const Raster alone = smoothed(raster, reach_of(0.5, 0)), filled = smoothed(raster, reach_of(3, 3));
  EXPECT_EQ(alone.doubles, raster.doubles);
  EXPECT_EQ(filled.doubles, raster.doubles);
}

TEST(Smooth, HasTheSameBitsWithAnyNumberOfThreads) {
  const Raster raster = raster_of(40, 200, random_value);
  const int before = thread_count();
  set_thread_count(1);
  const Raster one = smoothed(raster, reach_of(3.3, 4.4));
  set_thread_count(3);
  const Raster three = smoothed(raster, reach_of(3.3, 4.4));
  set_thread_count(before);
  EXPECT_EQ(one.doubles, three.doubles);
}

} // namespace
} // namespace trime::fields
