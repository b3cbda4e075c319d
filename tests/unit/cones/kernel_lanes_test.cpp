// SPDX-License-Identifier: BSD-3-Clause
// The kernels of cones and of searches give the same bits with any number of lanes; on any machine.
#include "cones/cone_kernel_lanes.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trime::cones {
namespace {

using geometry::Vec2;
using testing::random_vec2;

/// A list of cones and its arrays.
struct Listed {
  static constexpr std::int64_t room = 64;
  Listed() : numbers(static_cast<std::size_t>(ConeList::arrays * room)) {
    list.numbers = numbers.data();
    list.stride = room;
  }
  std::vector<double> numbers;
  ConeList list;
};

void expect_same(const ConeList& a, const ConeList& b, std::initializer_list<int> points) {
  ASSERT_EQ(a.count, b.count);
  for (int array = 0; array < ConeList::arrays; ++array)
    for (std::int64_t k = 0; k < a.count; ++k)
      EXPECT_EQ(a.at(array)[k], b.at(array)[k]) << array << ' ' << k;
  for (const int point : points) {
    EXPECT_EQ(a.low[point], b.low[point]);
    EXPECT_EQ(a.lowest[point], b.lowest[point]);
  }
}

/// Cones around the unit square as its cell, evaluated, passed on to a quarter, and chosen from.
template <int lanes>
struct Treated {
  explicit Treated(std::uint64_t key) {
    ConeList& list = all.list;
    list.count = static_cast<std::int64_t>(3 + key % 50);
    for (std::int64_t k = 0; k < list.count; ++k) {
      const Vec2 apex = 3 * random_vec2(key, static_cast<std::uint64_t>(k)) - Vec2{1, 1};
      list.x()[k] = apex.x;
      list.y()[k] = apex.y;
      list.height()[k] = 0.05 + 0.3 * random_vec2(key + 1000, static_cast<std::uint64_t>(k)).x;
    }
    ConePoints first{8, {}, {}, {}}, rest{5, {}, {}, {}};
    for (int p = 0; p < ConeList::points; ++p) {
      ConePoints& points = p < 8 ? first : rest;
      const int k = p < 8 ? p : p - 8;
      const bool is_quarter = p >= ConeList::first_quarter;
      const int q = p - ConeList::first_quarter;
      points.number[k] = p;
      points.x[k] = is_quarter ? 0.25 + 0.5 * (q & 1) : 0.5 * (p % 3);
      points.y[k] = is_quarter ? 0.25 + 0.5 * (q >> 1) : 0.5 * (p / 3);
    }
    Cones<lanes>::evaluate(list, 0.2, first);
    Cones<lanes>::evaluate(list, 0.2, rest);
    Cones<lanes>::pass_on(list, static_cast<int>(key % 4), quarter.list);
    ConeChoice choice{0, 0, 1, 1, 1e-3, 0.05, {}};
    count = Cones<lanes>::choose(list, ConeChoice::most, choice);
    chosen.assign(choice.chosen, choice.chosen + count);
  }
  Listed all, quarter;
  int count;
  std::vector<std::int64_t> chosen;
};

TEST(KernelLanes, ConesAreTheSameWithAny) {
  int chosen = 0;
  for (std::uint64_t key = 0; key < 100; ++key) {
    const Treated<2> two(key);
    const Treated<4> four(key);
    const Treated<8> eight(key);
    for (const auto& [all, quarter] :
         {std::pair(&four.all.list, &four.quarter.list), std::pair(&eight.all.list, &eight.quarter.list)}) {
      expect_same(two.all.list, *all, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
      ASSERT_EQ(two.quarter.list.count, quarter->count);
      for (const int point : {0, 2, 4, 6, 8}) {
        EXPECT_EQ(two.quarter.list.low[point], quarter->low[point]);
        EXPECT_EQ(two.quarter.list.lowest[point], quarter->lowest[point]);
      }
    }
    EXPECT_EQ(two.chosen, four.chosen);
    EXPECT_EQ(two.chosen, eight.chosen);
    chosen += two.count > 0;
  }
  EXPECT_GT(chosen, 10);
}

/// One node over eight leaves, with segments and cones in cells of a row.
struct Hierarchy {
  explicit Hierarchy(std::uint64_t key) {
    for (int k = 0; k < box_width; ++k) {
      node.min_x[k] = k;
      node.max_x[k] = k + 1;
      node.min_y[k] = 0;
      node.max_y[k] = 1;
      node.number[k] = 0;
      for (int s = 0; s < box_width; ++s) {
        const std::uint64_t item = static_cast<std::uint64_t>(box_width * k + s);
        const Vec2 a = random_vec2(key, item), b = random_vec2(key + 500, item), d = b - a;
        segments[k].a_x[s] = cones[k].x[s] = a.x + k;
        segments[k].a_y[s] = cones[k].y[s] = a.y;
        segments[k].d_x[s] = d.x;
        segments[k].d_y[s] = d.y;
        segments[k].inverse_square[s] = 1 / geometry::squared_length(d);
        cones[k].height[s] = b.x;
      }
    }
    levels.nodes[0] = &node;
    levels.count = 1;
  }
  template <int lanes>
  NearestPoint nearest(Vec2 p) const {
    NearestPoint best{0, 0, 1e300, -1};
    Search<lanes>::nearest(levels, segments, p.x, p.y, 1, best);
    return best;
  }
  template <int lanes>
  LowestCone lowest(Vec2 p) const {
    LowestCone best{1e300, -1};
    Search<lanes>::lowest(levels, cones, 0.3, p.x, p.y, 1, best);
    return best;
  }
  BoxNode node;
  SegmentLeaf segments[box_width];
  ConeLeaf cones[box_width];
  BoxLevels levels;
};

TEST(KernelLanes, SearchesFindTheSameWithAny) {
  for (std::uint64_t key = 0; key < 300; ++key) {
    const Hierarchy hierarchy(key);
    const Vec2 p = 10 * random_vec2(key, 77) - Vec2{1, 4};
    const NearestPoint nearest = hierarchy.nearest<2>(p);
    EXPECT_GE(nearest.segment, 0);
    for (const NearestPoint& other : {hierarchy.nearest<4>(p), hierarchy.nearest<8>(p)}) {
      EXPECT_EQ(other.squared_distance, nearest.squared_distance);
      EXPECT_EQ(other.segment, nearest.segment);
      EXPECT_EQ(other.x, nearest.x);
      EXPECT_EQ(other.y, nearest.y);
    }
    const LowestCone lowest = hierarchy.lowest<2>(p);
    EXPECT_GE(lowest.cone, 0);
    for (const LowestCone& other : {hierarchy.lowest<4>(p), hierarchy.lowest<8>(p)}) {
      EXPECT_EQ(other.value, lowest.value);
      EXPECT_EQ(other.cone, lowest.cone);
    }
  }
}

} // namespace
} // namespace trime::cones
