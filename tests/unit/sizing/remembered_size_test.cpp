// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/remembered_size.hpp"

#include "core/thread_loop.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace trime::sizing {
namespace {

using geometry::Vec2;

/// Counts how often it is asked; it has no valid size at the origin.
class CountedSize final : public SizeField {
public:
  double size(Vec2 p) const override {
    ++asked;
    return std::sqrt(p.x * p.x + p.y * p.y);
  }
  mutable std::atomic<int> asked{0};
};

std::vector<Vec2> grid_of(int side) {
  std::vector<Vec2> places;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      places.push_back({std::ldexp(i, -10), std::ldexp(j, -10)});
  return places;
}

TEST(RememberedSize, AsksOnceForEachPlace) {
  const CountedSize field;
  const std::vector<Vec2> places = grid_of(100);
  RememberedSize size(field);
  size.remember(std::span(places).first(3000));
  size.remember(places);
  EXPECT_EQ(field.asked, 10000);
  std::vector<double> values(places.size());
  size.sizes(places, values);
  for (std::size_t k = 0; k < places.size(); ++k) {
    EXPECT_EQ(values[k], size.size(places[k]));
    EXPECT_EQ(values[k], std::sqrt(places[k].x * places[k].x + places[k].y * places[k].y));
  }
  EXPECT_EQ(field.asked, 10000);
  EXPECT_LE(size.memory_bytes(), 128 * places.size());
}

TEST(RememberedSize, AsksTheFieldAtOtherPlaces) {
  const CountedSize field;
  RememberedSize size(field);
  EXPECT_EQ(size.size({3, 4}), 5);
  const std::vector<Vec2> places = {{3, 4}, {6, 8}, {3, 4}};
  size.remember(std::span(places).first(1));
  std::vector<double> values(3);
  size.sizes(places, values);
  EXPECT_EQ(values, (std::vector<double>{5, 10, 5}));
  EXPECT_EQ(field.asked, 3);
}

TEST(RememberedSize, KeepsInvalidSizesForTheCheck) {
  const CountedSize field;
  RememberedSize size(field);
  const std::vector<Vec2> places = {{0, 0}};
  size.remember(places);
  EXPECT_EQ(size.size({0, 0}), 0);
  EXPECT_THROW(checked_size(size, {0, 0}), GeometryError);
}

TEST(RememberedSize, KeepsNothingOfUniformSizes) {
  const UniformSize field(2);
  RememberedSize size(field);
  const std::vector<Vec2> places = grid_of(10);
  size.remember(places);
  EXPECT_EQ(size.memory_bytes(), 0U);
  EXPECT_EQ(size.size({0, 0}), 2);
}

} // namespace
} // namespace trime::sizing
