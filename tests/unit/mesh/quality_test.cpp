// SPDX-License-Identifier: BSD-3-Clause
// Quality of single triangles and the statistics over many.
#include "core/random.hpp"
#include "trime/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <limits>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace trime::mesh {
namespace {

using geometry::Vec2;

TEST(TriangleQuality, KnownTriangles) {
  const Vec2 o{0, 0};
  const Vec2 apex{0.5, std::sqrt(3.0) / 2};
  EXPECT_NEAR(aspect_ratio(o, {1, 0}, apex), 1, 1e-12);
  EXPECT_NEAR(edge_ratio(o, {1, 0}, apex), 1, 1e-12);
  EXPECT_NEAR(min_angle_degrees(o, {1, 0}, apex), 60, 1e-9);
  // 3-4-5: R = 5/2, r = 1.
  EXPECT_NEAR(aspect_ratio(o, {3, 0}, {0, 4}), 1.25, 1e-12);
  EXPECT_NEAR(edge_ratio(o, {3, 0}, {0, 4}), 5.0 / 3, 1e-12);
  EXPECT_NEAR(min_angle_degrees(o, {3, 0}, {0, 4}), std::asin(0.6) * 180 / M_PI, 1e-9);
  // Half a square: R = sqrt(2)/2, r = 1 - sqrt(2)/2.
  EXPECT_NEAR(aspect_ratio(o, {1, 0}, {0, 1}), std::sqrt(0.5) / (2 - std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(min_angle_degrees(o, {1, 0}, {0, 1}), 45, 1e-9);
}

TEST(TriangleQuality, DoesNotDependOnSizePlaceAndOrderOfTheVertices) {
  const Vec2 a{0.1, 0.2}, b{0.9, 0.3}, c{0.4, 0.8};
  const double alpha = aspect_ratio(a, b, c), beta = edge_ratio(a, b, c), angle = min_angle_degrees(a, b, c);
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const Vec2 shift{3 * scale, -7 * scale};
    const Vec2 p = shift + scale * a, q = shift + scale * b, r = shift + scale * c;
    EXPECT_NEAR(aspect_ratio(r, p, q), alpha, 1e-9);
    EXPECT_NEAR(aspect_ratio(q, p, r), alpha, 1e-9);
    EXPECT_NEAR(edge_ratio(q, p, r), beta, 1e-9);
    EXPECT_NEAR(min_angle_degrees(q, p, r), angle, 1e-9);
  }
}

TEST(TriangleQuality, WhatIsSurelyBelowIsBelow) {
  int sure = 0, below = 0;
  for (std::uint64_t k = 0; k < 200000; ++k) {
    const auto random = [&](std::uint64_t j) { return random_unit(3, RandomPurpose::test, k, j); };
    // From equilateral to flat, and isosceles ones of all shapes, which are the worst of their kind.
    const double spread = 0.6 * random(3);
    const double x = k % 2 == 0 ? 0.5 : 0.5 + spread * (random(0) - 0.5);
    const Vec2 apex{x, 0.866 + 1.7 * spread * (random(1) - 0.5)};
    const double limit = 1 + 0.3 * random(2), alpha = aspect_ratio({0, 0}, {1, 0}, apex);
    if (is_surely_below(limit, {0, 0}, {1, 0}, apex)) {
      ++sure;
      ASSERT_LT(alpha, limit) << apex.x << " " << apex.y;
    }
    below += alpha < limit;
  }
  EXPECT_GT(sure, 0.7 * below);
  EXPECT_FALSE(is_surely_below(2, {0, 0}, {1, 0}, {0.5, -0.866})); // the other way round
  EXPECT_FALSE(is_surely_below(2, {0, 0}, {0, 0}, {0, 0}));
  EXPECT_FALSE(is_surely_below(2, {0, 0}, {1, 0}, {2, 0}));
}

TEST(TriangleQuality, ObtuseIsDecidedExactly) {
  constexpr double step = 0x1p-40;
  for (const auto& [x, obtuse] : {std::pair{0.25 - step, true}, {0.25, false}, {0.25 + step, false}}) {
    const Vec2 a{0.25, 0.25}, b{0.5, 0.25}, c{x, 0.75};
    EXPECT_EQ(is_obtuse(a, b, c), obtuse) << x - 0.25;
    EXPECT_EQ(is_obtuse(b, c, a), obtuse);
    EXPECT_EQ(is_obtuse(c, a, b), obtuse);
    EXPECT_EQ(is_obtuse(a, c, b), obtuse) << "also clockwise";
    EXPECT_NEAR(max_angle_degrees(b, c, a), 90, 1e-9);
  }
  EXPECT_NEAR(max_angle_degrees({0, 0}, {1, 0}, {-1, std::sqrt(3.0)}), 120, 1e-12);
  EXPECT_TRUE(is_obtuse({0, 0}, {1, 0}, {2, 0}));
}

TEST(TriangleQuality, NoObtuseTriangleHasASmallerAlpha) {
  EXPECT_NEAR(least_obtuse_alpha, (1 + std::sqrt(2.0)) / 2, 1e-5);
  EXPECT_LT(least_obtuse_alpha, aspect_ratio({0, 0}, {1, 0}, {0, 1}));
  for (std::uint64_t k = 0; k < 20000; ++k) {
    const auto random = [&](std::uint64_t j) { return random_unit(5, RandomPurpose::test, k, j); };
    const Vec2 apex{random(0), 0.3 + 0.4 * random(1)};
    if (is_obtuse({0, 0}, {1, 0}, apex)) {
      ASSERT_GT(aspect_ratio({0, 0}, {1, 0}, apex), least_obtuse_alpha) << apex.x << " " << apex.y;
    }
  }
}

TEST(TriangleQuality, FlatTrianglesAreInfinitelyBadButDefined) {
  EXPECT_TRUE(std::isinf(aspect_ratio({0, 0}, {1, 1}, {2, 2})));
  EXPECT_EQ(min_angle_degrees({0, 0}, {1, 1}, {2, 2}), 0);
  const double alpha = aspect_ratio({0, 0}, {1, 0}, {0.5, 1e-9});
  EXPECT_TRUE(std::isfinite(alpha));
  EXPECT_GT(alpha, 1e8);
}

std::vector<double> random_ratios(std::size_t n) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = random_unit(1, RandomPurpose::test, k, 0);
    ratios.push_back(1 + 0.1 * u / (1.0001 - u));
  }
  return ratios;
}

void expect_same(const RatioSummary& a, const RatioSummary& b) {
  EXPECT_EQ(a.median, b.median);
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_EQ(a.max, b.max);
  EXPECT_EQ(a.half_mean, b.half_mean);
  EXPECT_EQ(a.std, b.std);
}

RatioTotals totals_of(const RatioStatistics& statistics) {
  return {statistics.pack(), statistics.max()};
}
RatioSummary summary_of(const RatioStatistics& statistics) {
  const RatioTotals totals = totals_of(statistics);
  return totals.summary(statistics.bins(totals.median_run()));
}

TEST(RatioStatistics, AgreesWithPlainSums) {
  const std::vector<double> ratios = random_ratios(10001);
  RatioStatistics statistics;
  double sum = 0, roots = 0, squares = 0;
  for (const double r : ratios) {
    statistics.add(r);
    sum += r;
    roots += std::sqrt(r);
    squares += r * r;
  }
  const double n = static_cast<double>(ratios.size()), mean = sum / n;
  const RatioSummary summary = summary_of(statistics);
  const auto counts = totals_of(statistics).histogram();
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}), std::ssize(ratios));
  EXPECT_NEAR(summary.mean, mean, 1e-8);
  EXPECT_NEAR(summary.half_mean, roots / n * (roots / n), 1e-8);
  EXPECT_NEAR(summary.std, std::sqrt(squares / n - mean * mean), 1e-4 * summary.std);
  EXPECT_EQ(summary.max, *std::max_element(ratios.begin(), ratios.end()));
  std::vector<double> sorted(ratios);
  std::nth_element(sorted.begin(), sorted.begin() + 5000, sorted.end());
  EXPECT_NEAR(summary.median, sorted[5000], 1e-4);
}

TEST(RatioStatistics, MergingInAnyOrderGivesTheSameBits) {
  const std::vector<double> ratios = random_ratios(3000);
  RatioStatistics whole, forward, backward, parts[7];
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    whole.add(ratios[k]);
    parts[(k * k) % 7].add(ratios[ratios.size() - 1 - k]);
  }
  for (int k = 0; k < 7; ++k) {
    forward.merge(parts[k]);
    backward.merge(parts[6 - k]);
  }
  expect_same(summary_of(forward), summary_of(whole));
  expect_same(summary_of(backward), summary_of(whole));
  EXPECT_EQ(forward.pack(), backward.pack());
}

TEST(RatioStatistics, PartsMayBeAddedAsIntegersOfFewWords) {
  const std::vector<double> ratios = random_ratios(1000);
  RatioStatistics whole, first, second;
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    whole.add(ratios[k]);
    (k < 300 ? first : second).add(ratios[k]);
  }
  auto packed = first.pack();
  EXPECT_LT(packed.size(), 256u);
  for (std::size_t k = 0; k < packed.size(); ++k)
    packed[k] += second.pack()[k];
  const RatioTotals joined(packed, std::max(first.max(), second.max()));
  const auto some = first.bins(joined.median_run()), more = second.bins(joined.median_run());
  std::vector<std::int64_t> bins;
  std::transform(some.begin(), some.end(), more.begin(), std::back_inserter(bins), std::plus());
  expect_same(joined.summary(bins), summary_of(whole));
  EXPECT_EQ(joined.histogram(), totals_of(whole).histogram());
  EXPECT_NE(summary_of(first).median, summary_of(whole).median);
}

TEST(RatioStatistics, HistogramCountsEveryValueInItsClass) {
  RatioStatistics statistics;
  for (const double r : {1.0, 1.005, 1.015, 1.03, 1.07, 1.15, 1.3, 1.7, 3.0, 7.0, 1e9, double{INFINITY}})
    statistics.add(r);
  const std::array<std::int64_t, 9> expected{2, 1, 1, 1, 1, 1, 1, 1, 3};
  EXPECT_EQ(totals_of(statistics).histogram(), expected);
}

TEST(RatioStatistics, NothingAndInfinityAreDefined) {
  EXPECT_EQ(summary_of(RatioStatistics()).mean, 1);
  RatioStatistics statistics;
  statistics.add(INFINITY);
  statistics.add(1.5);
  EXPECT_TRUE(std::isfinite(summary_of(statistics).mean));
  EXPECT_TRUE(std::isfinite(summary_of(statistics).std));
  EXPECT_TRUE(std::isinf(summary_of(statistics).max));
}

TEST(Quality, DegenerateTrianglesAreInfinitelyBad) {
  const geometry::Vec2 p{0.25, 0.5}, q{0.5, 0.5}, r{0.75, 0.5};
  EXPECT_EQ(aspect_ratio(p, p, p), std::numeric_limits<double>::infinity());
  EXPECT_EQ(aspect_ratio(p, q, r), std::numeric_limits<double>::infinity());
  EXPECT_EQ(edge_ratio(p, p, q), std::numeric_limits<double>::infinity());
}

TEST(Quality, MediansFarFromOne) { // the last bin of the histogram was all that lies beyond 10
  for (const double middle : {1.000002, 1.5, 7.3, 13.6, 900.0}) {
    RatioStatistics statistics;
    for (const double factor : {0.9999995, 1.0, 1.0000005})
      statistics.add(1 + (middle - 1) * factor);
    EXPECT_NEAR(summary_of(statistics).median, middle, 0.01 * middle);
    EXPECT_NEAR((summary_of(statistics).median - 1) / (middle - 1), 1, 0.3);
  }
}

} // namespace
} // namespace trime::mesh
