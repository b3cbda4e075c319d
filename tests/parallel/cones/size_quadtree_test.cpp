// SPDX-License-Identifier: BSD-3-Clause
// The quadtree of the size field: the gradient bound on its edges, its error, the same bits on any ranks and threads;
// and the tree of cones below it.
#include "cones/size_quadtree.hpp"
#include "core/random.hpp"
#include "core/simd_level.hpp"
#include "sizing/boundary_features.hpp"
#include "support/boundary_shapes.hpp"
#include "support/distributed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace trime::cones {
namespace {

using geometry::Box;
using geometry::Vec2;
using sizing::boundary_features;
using sizing::Images;

double random(std::uint64_t key, std::uint64_t slot) {
  return random_unit(5, RandomPurpose::test, key, slot);
}

/// A star with `n` rough arms, and a round hole.
geometry::Boundary rough_shape(int n) {
  std::vector<Vec2> points;
  for (int k = 0; k < n; ++k) {
    const SinCos direction = sin_cos(2 * pi * k / n);
    points.push_back(Vec2{0.5, 0.5} +
                     (0.25 + 0.2 * random(static_cast<std::uint64_t>(k), 9)) * Vec2{direction.cos, direction.sin});
  }
  return testing::boundary_of({testing::polygon_loop(points), testing::circle_loop({0.52, 0.5}, 0.1, true)});
}

/// A tree with what it was made from; period_x = 1.
struct Field {
  Field(const comm::Communicator& comm, double gradation)
      : images({{0, 0}, {1, 1}}, 1, 0),
        cones(boundary_features(comm, rough_shape(60), images, floor, gradation), gradation),
        tree(comm, {cones, gradation, 2, images.container(), floor / 128}) {}

  static constexpr double floor = 0.01;
  Images images;
  ConeTree cones;
  SizeQuadtree tree;
};

/// Everything in the tree, in its order.
std::vector<double> content(const SizeQuadtree& tree) {
  std::vector<double> list;
  tree.for_each_leaf([&](const Box& cell, const CornerValues& values) {
    list.insert(list.end(), {cell.min.x, cell.min.y, cell.max.x});
    list.insert(list.end(), values.begin(), values.end());
  });
  return list;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST(ConeTree, FindsTheLowestConeAndAllBelowABound) {
  for (const std::size_t n : {0u, 1u, 7u, 8u, 9u, 1000u}) {
    std::vector<Cone> cones;
    for (std::uint64_t k = 0; k < n; ++k)
      cones.push_back({{random(k, 0), random(k, 1)}, 0.2 * random(k, 2)});
    const ConeTree tree(cones, 0.7);
    for (std::uint64_t key = 0; key < 100; ++key) {
      const Vec2 p{2 * random(key, 3) - 0.5, random(key, 4)};
      double low = 9;
      std::size_t below = 0;
      for (const Cone& cone : cones) {
        low = std::fmin(low, cone.value(p, 0.7));
        below += cone.value(p, 0.7) <= 0.3;
      }
      EXPECT_EQ(tree.value(p, 9), low);
      std::vector<LocalIndex> found;
      tree.collect(p, 0.3, found);
      EXPECT_EQ(found.size(), below);
    }
  }
}

TEST(ConeTree, TakesConesInOnePlace) {
  const ConeTree tree({{{0.5, 0.5}, 0.2}, {{0.5, 0.5}, 0.1}, {{0.5, 0.5}, 0.3}}, 1);
  EXPECT_EQ(tree.value({0.5, 1.5}), 1.1);
  EXPECT_EQ(tree.cones()[tree.lowest({0, 0}, 9)].height, 0.1);
  EXPECT_EQ(tree.lowest({0.5, 0.5}, 0.05), -1);
}

TEST(ConeTree, LeavesOutWhatIsSkipped) {
  std::vector<Cone> cones;
  for (std::uint64_t k = 0; k < 1000; ++k)
    cones.push_back({{random(k, 0), random(k, 1)}, random(k, 2)});
  const ConeTree tree(cones, 1);
  const auto far = [](const Box& box, double least) { return box.min.x > 0.5 || least > 0.5; };
  std::vector<LocalIndex> seen;
  tree.visit_unless(far, [&](LocalIndex k) { seen.push_back(k); });
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  for (std::size_t k = 0; k < cones.size(); ++k) {
    const Cone& cone = tree.cones()[k];
    const bool is_seen = std::binary_search(seen.begin(), seen.end(), static_cast<LocalIndex>(k));
    EXPECT_TRUE(is_seen || cone.apex.x > 0.5 || cone.height > 0.5);
  }
  EXPECT_LT(seen.size(), cones.size());
}

TEST(SizeQuadtree, ObeysTheGradationAlongAllItsEdges) {
  for (const double gradation : {0.1, 0.2, 0.5}) {
    const Field field(comm::Communicator::world(), gradation);
    int cells = 0;
    field.tree.for_each_leaf([&](const Box& cell, const CornerValues& v) {
      ++cells;
      const double most = gradation * cell.width() + 1e-12;
      EXPECT_LE(std::fabs(v[1] - v[0]), most);
      EXPECT_LE(std::fabs(v[3] - v[2]), most);
      EXPECT_LE(std::fabs(v[2] - v[0]), most);
      EXPECT_LE(std::fabs(v[3] - v[1]), most);
    });
    EXPECT_GT(cells, 4096);
  }
}

TEST(SizeQuadtree, IsWithinItsToleranceNearlyEverywhere) {
  const Field field(comm::Communicator::world(), 0.2);
  int beyond = 0;
  for (std::uint64_t key = 0; key < 5000; ++key) {
    const Vec2 p{random(key, 5), random(key, 6)};
    const double share = std::fabs(field.tree.value(p) / field.cones.value(p, 2) - 1);
    EXPECT_LT(share, 0.03);
    beyond += share > SizeQuadtree::tolerance;
  }
  EXPECT_LT(beyond, 50);
}

TEST(SizeQuadtree, HasExactCornersAndMeetsItsBounds) {
  const Field field(comm::Communicator::world(), 0.2);
  double least = 9, largest = 0;
  field.tree.for_each_leaf([&](const Box& cell, const CornerValues& v) {
    EXPECT_NEAR(v[0], field.cones.value(cell.min, 2), 1e-15);
    EXPECT_NEAR(v[3], field.cones.value(cell.max, 2), 1e-15);
    EXPECT_EQ(field.tree.value(cell.min), v[0]);
    for (const double value : v) {
      least = std::fmin(least, value);
      largest = std::fmax(largest, value);
    }
  });
  EXPECT_EQ(least, field.tree.least());
  EXPECT_EQ(largest, field.tree.largest());
  EXPECT_GE(least, Field::floor);
  EXPECT_EQ(field.tree.value({-5, 0.25}), field.tree.value({0, 0.25}));
  EXPECT_EQ(field.tree.value({0.25, 7}), field.tree.value({0.25, 1}));
  EXPECT_EQ(field.tree.value({1, 1}), field.tree.value({2, 2}));
  EXPECT_TRUE(std::isfinite(field.tree.value({std::nan(""), -HUGE_VAL})));
}

TEST(SizeQuadtree, IsTheSameOnAnyRanksAndThreads) {
  const std::vector<double> serial = content(Field(comm::Communicator::self(), 0.2).tree);
  EXPECT_TRUE(same_bits(content(Field(comm::Communicator::world(), 0.2).tree), serial));
  for (const int threads : {1, 3}) {
    const testing::OnThreads on(threads);
    EXPECT_TRUE(same_bits(content(Field(comm::Communicator::world(), 0.2).tree), serial)) << threads;
  }
}

TEST(SizeQuadtree, IsNowhereBeyondItsTolerance) {
  for (const double gradation : {0.05, 0.2, 1.0}) {
    const Field field(comm::Communicator::world(), gradation);
    const auto check = [&](Vec2 p) {
      EXPECT_NEAR(field.tree.value(p) / field.cones.value(p, 2), 1, SizeQuadtree::tolerance) << p.x << " " << p.y;
    };
    for (std::uint64_t key = 0; key < 5000; ++key)
      check({random(key, 10), random(key, 11)});
    std::uint64_t key = 0;
    for (const Cone& cone : field.cones.cones()) { // near features the field bends most
      const Vec2 p = cone.apex + 4 * cone.height * Vec2{random(key, 12) - 0.5, random(key, 13) - 0.5};
      if (field.images.container().contains(p))
        check(p);
      ++key;
    }
  }
}

TEST(SizeQuadtree, IsTheSameAtAllSimdLevels) {
  const std::vector<double> usual = content(Field(comm::Communicator::world(), 0.2).tree);
  for (const SimdLevel level : {SimdLevel::portable, SimdLevel::avx2}) {
    limit_simd_level(level);
    EXPECT_TRUE(same_bits(content(Field(comm::Communicator::world(), 0.2).tree), usual)) << static_cast<int>(level);
  }
  limit_simd_level(SimdLevel::avx512);
}

TEST(SizeQuadtree, CoversContainersThatAreNotSquare) {
  const comm::Communicator comm = comm::Communicator::world();
  const ConeTree cones({{{2.9, 0.1}, 0.01}}, 0.5);
  const SizeQuadtree tree(comm, {cones, 0.5, 9, {{1, -1}, {3, 0.15}}, 1e-4});
  for (std::uint64_t key = 0; key < 500; ++key) {
    const Vec2 p{1 + 2 * random(key, 0), 1.15 * random(key, 1) - 1};
    EXPECT_NEAR(tree.value(p) / cones.value(p), 1, 0.011);
  }
  EXPECT_NEAR(tree.value({3, 0.15}), cones.value({3, 0.15}), 1e-3);
}

} // namespace
} // namespace trime::cones
