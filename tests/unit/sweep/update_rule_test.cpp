// SPDX-License-Identifier: BSD-3-Clause
// The update rules and the sums that steer them.
#include "delaunay/star_builder.hpp"
#include "support/point_sets.hpp"
#include "sweep/update_rule.hpp"
#include "trime/mesh/quality.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using mesh::Site;
using mesh::SiteList;
using sites::StarView;
using testing::OnThreads;

constexpr double spacing = 0.03125;

/// Sites with their stars; sites marked as boundary do not move.
struct Cloud {
  explicit Cloud(const SiteList& sites, double h = spacing)
      : grid(geometry::Box{{0, 0}, {1, 1}}, {{}, {}, spacing}), points(grid), size(h) {
    points.assign_owned(sites, 0, grid.tile_count());
    stars.reset(points.owned());
    std::vector<mesh::BinRef> missing;
    delaunay::StarBuilder(testing::unit_lattice(), 2.5 * spacing).update(points, stars, {}, {}, missing);
  }
  StarView view() const { return {points, stars, size}; }
  /// The site nearest to the middle.
  LocalIndex middle() const {
    LocalIndex best = 0;
    for (LocalIndex i = 0; i < points.owned(); ++i)
      if (geometry::length(points.position(i) - Vec2{0.5, 0.5}) <
          geometry::length(points.position(best) - Vec2{0.5, 0.5}))
        best = i;
    return best;
  }

  mesh::TileGrid grid;
  mesh::BinnedPoints points;
  delaunay::StarTable stars;
  sizing::UniformSize size;
};

SiteList lattice(double jitter = 0) {
  SiteList sites = testing::hexagonal_lattice(24, spacing);
  for (std::size_t k = 0; k < sites.size(); ++k)
    sites[k].position = testing::unit_lattice().snap(
        sites[k].position + (jitter * spacing) * (testing::random_vec2(4, k) - Vec2{0.5, 0.5}));
  return sites;
}

/// Sums whose bars are so long, over h.
SweepSums sums_of_lengths(double ratio) {
  SweepSums sums;
  sums.squared_length_ratio.add(1000 * ratio * ratio);
  sums.squared_size_ratio.add(1000);
  return sums;
}

/// Else a site that sleeps might be wanted elsewhere by now.
TEST(DistMeshRule, ItsScaleStaysUntilItWouldChangeByAShareThatCounts) {
  DistMeshRule rule;
  rule.begin_sweep(sums_of_lengths(0.9));
  const double first = rule.parameters().length_scale;
  rule.begin_sweep(sums_of_lengths(0.9 * (1 + 0.9 * SweepRules::scale_change)));
  EXPECT_EQ(rule.parameters().length_scale, first);
  rule.begin_sweep(sums_of_lengths(0.9 * (1 + 1.1 * SweepRules::scale_change)));
  EXPECT_GT(rule.parameters().length_scale, first);
}

TEST(SweepSums, OfAPerfectLattice) {
  const Cloud cloud(lattice());
  const SweepSums sums = measure(cloud.view(), spacing);
  // 24 rows of 24: two triangles in each of 23 x 23 rhombi, and half of the ragged ends are small enough to count.
  EXPECT_GE(sums.triangles, 2 * 23 * 23);
  EXPECT_NEAR(sums.squared_length_ratio.value() / sums.squared_size_ratio.value(), 1, 0.1);
  EXPECT_LT(sums.excess_alpha.value() / static_cast<double>(sums.triangles), 0.05);
}

TEST(SweepSums, DoNotDependOnThreadsAndCountEachTriangleOnce) {
  const Cloud cloud(lattice(0.5));
  std::int64_t triangles = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    const auto ring = cloud.stars.ring(i);
    for (std::size_t k = 0; k < ring.size(); ++k)
      triangles += ring[k] != delaunay::gap && ring[(k + 1) % ring.size()] != delaunay::gap;
  }
  const OnThreads one(1);
  const SweepSums reference = measure(cloud.view(), spacing);
  EXPECT_EQ(3 * reference.triangles, triangles);
  const OnThreads four(4);
  const SweepSums sums = measure(cloud.view(), spacing);
  EXPECT_EQ(sums.squared_length_ratio.value(), reference.squared_length_ratio.value());
  EXPECT_EQ(sums.squared_size_ratio.value(), reference.squared_size_ratio.value());
  EXPECT_EQ(sums.excess_alpha.value(), reference.excess_alpha.value());
  EXPECT_EQ(sums.max_alpha, reference.max_alpha);
}

TEST(SweepSums, TrianglesAmongBoundarySitesAreNotMeasured) {
  SiteList sites = lattice();
  for (std::size_t k = 0; k < sites.size(); ++k)
    sites[k].boundary = static_cast<std::int32_t>(k);
  const Cloud all(sites);
  EXPECT_EQ(measure(all.view(), spacing).triangles, 0);
  EXPECT_EQ(measure(all.view(), spacing).squared_size_ratio.value(), 0);
  const LocalIndex i = all.middle();
  const std::int32_t k = all.points.boundary(i);
  sites[static_cast<std::size_t>(k)].boundary = -1;
  EXPECT_EQ(measure(Cloud(sites).view(), spacing).triangles, 6);
}

TEST(DistMeshRule, LeavesAPerfectLatticeAlone) {
  const Cloud cloud(lattice());
  DistMeshRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  EXPECT_LT(geometry::length(rule.step(cloud.view(), cloud.middle()).move), 1e-8 * spacing);
}

TEST(DistMeshRule, PushesASiteAwayFromTheNeighbourItCameTooNear) {
  SiteList sites = lattice();
  const Cloud before(sites);
  const Vec2 middle = before.points.position(before.middle());
  for (Site& site : sites)
    if (site.position == middle)
      site.position = testing::unit_lattice().snap(middle + Vec2{0.2 * spacing, 0});
  const Cloud cloud(sites);
  DistMeshRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  const Vec2 back = rule.step(cloud.view(), cloud.middle()).move;
  EXPECT_LT(back.x, -0.01 * spacing);
  EXPECT_GT(back.x, -0.4 * spacing);
  EXPECT_NEAR(back.y, 0, 0.01 * spacing);
}

TEST(DistMeshRule, WhatABarDoesToOneEndItDoesReversedToTheOther) {
  const Cloud cloud(lattice(0.7)); // all sites are inner: the forces of all bars cancel
  DistMeshRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  Vec2 sum;
  double lengths = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    sum = sum + rule.step(cloud.view(), i).move;
    lengths += geometry::length(rule.step(cloud.view(), i).move);
  }
  EXPECT_GT(lengths, spacing);
  EXPECT_LT(geometry::length(sum), 1e-12 * lengths);
}

TEST(DistMeshRule, BarsLongerThanTheirRestLengthDoNotPull) {
  const Cloud cloud(lattice(0.3), 1e-3 * spacing);
  DistMeshRule rule;
  rule.begin_sweep({}); // no bars at all: the rest length is 1.2 h
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    EXPECT_EQ(rule.step(cloud.view(), i).move, (Vec2{0, 0}));
}

TEST(SweepSums, MedianOfAlpha) {
  const Cloud cloud(lattice(0.5));
  const SweepSums sums = measure(cloud.view(), spacing);
  std::vector<double> values;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    const auto ring = cloud.stars.ring(i);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const LocalIndex a = ring[k], b = ring[(k + 1) % ring.size()];
      if (a != delaunay::gap && b != delaunay::gap)
        values.push_back(
            mesh::aspect_ratio(cloud.points.position(i), cloud.points.position(a), cloud.points.position(b)));
    }
  }
  std::sort(values.begin(), values.end()); // each triangle three times
  const double median = values[values.size() / 2] - 1;
  EXPECT_NEAR(sums.alpha_bins.median(), median, 0.07 * median);
}

TEST(CvdRule, LeavesAPerfectLatticeAlone) {
  const Cloud cloud(lattice());
  EXPECT_LT(geometry::length(CvdRule().centroid(cloud.view(), cloud.middle())), 1e-8 * spacing);
}

/// The centroid of a polygon by the shoelace formula, from the circumcentres of the star.
TEST(CvdRule, UniformWeightGivesTheCentroidOfTheCell) {
  const Cloud cloud(lattice(0.6));
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    const auto ring = cloud.stars.ring(i);
    const Vec2 p = cloud.points.position(i);
    if (ring.size() < 3 || std::find(ring.begin(), ring.end(), delaunay::gap) != ring.end())
      continue;
    std::vector<Vec2> cell;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 u = cloud.points.position(ring[k]) - p, v = cloud.points.position(ring[(k + 1) % ring.size()]) - p;
      const double d = 2 * geometry::cross(u, v);
      cell.push_back({(geometry::dot(u, u) * v.y - geometry::dot(v, v) * u.y) / d,
                      (geometry::dot(v, v) * u.x - geometry::dot(u, u) * v.x) / d});
    }
    double area = 0;
    Vec2 first;
    for (std::size_t k = 0; k < cell.size(); ++k) {
      const Vec2 a = cell[k], b = cell[(k + 1) % cell.size()];
      area += geometry::cross(a, b) / 2;
      first = first + (geometry::cross(a, b) / 6) * (a + b);
    }
    EXPECT_LT(geometry::length(CvdRule().centroid(cloud.view(), i) - (1 / area) * first), 1e-10 * spacing);
  }
}

/// h = 1 + g (x - p) around the site: the weight h^-n moves the centroid of a cell with second moment m per area by
/// -n g m to first order.
TEST(CvdRule, TheWeightMovesTheCentroidTowardsSmallSizes) {
  class Ramp final : public sizing::SizeField {
  public:
    double size(Vec2 p) const override { return spacing * (1 + 0.01 * (p.x - 0.5) / spacing); }
  };
  const Cloud cloud(lattice());
  const Ramp ramp;
  const StarView view(cloud.points, cloud.stars, ramp);
  const double second_moment = 5.0 / 72 * spacing * spacing; // of a hexagon, about an axis, over its area
  for (const int exponent : {2, 4}) {
    const Vec2 moved = CvdRule(exponent).centroid(view, cloud.middle());
    const double expected = -exponent * (0.01 / spacing) * second_moment;
    EXPECT_NEAR(moved.x, expected, 0.05 * std::fabs(expected)) << exponent;
    EXPECT_NEAR(moved.y, 0, 1e-6 * spacing);
  }
}

TEST(CvdRule, MomentumGrowsAndStartsAgainUphill) {
  SiteList sites = lattice(0.3);
  for (Site& site : sites)
    site.lead = {0.1 * spacing, 0};
  const Cloud cloud(sites);
  const LocalIndex i = cloud.middle();
  CvdRule rule;
  SweepSums downhill, uphill;
  uphill.power.add(1);
  rule.begin_sweep(downhill);
  EXPECT_EQ(rule.step(cloud.view(), i).lead, (Vec2{0, 0}));
  rule.begin_sweep(downhill);
  const Step step = rule.step(cloud.view(), i);
  EXPECT_EQ(step.lead, 0.25 * (step.move + Vec2{0.1 * spacing, 0}));
  rule.begin_sweep(uphill);
  EXPECT_EQ(rule.step(cloud.view(), i).lead, (Vec2{0, 0}));
}

TEST(TriangleRule, LeavesAPerfectLatticeAlone) {
  const Cloud cloud(lattice());
  TriangleRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  EXPECT_LT(geometry::length(rule.step(cloud.view(), cloud.middle()).move), 1e-8 * spacing);
}

TEST(TriangleRule, BringsADisplacedSiteBack) {
  SiteList sites = lattice();
  const Cloud before(sites);
  const Vec2 middle = before.points.position(before.middle());
  const auto site =
      std::find_if(sites.begin(), sites.end(), [&](const Site& candidate) { return candidate.position == middle; });
  site->position = middle + Vec2{0.3 * spacing, 0.1 * spacing};
  double distance = geometry::length(site->position - middle);
  for (int sweep = 0; sweep < 6; ++sweep) {
    site->position = testing::unit_lattice().snap(site->position);
    const Cloud cloud(sites);
    TriangleRule rule;
    rule.begin_sweep(measure(cloud.view(), spacing));
    for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
      if (cloud.points.position(i) == site->position) {
        site->position = site->position + rule.step(cloud.view(), i).move;
        break;
      }
    const double left = geometry::length(site->position - middle);
    EXPECT_LT(left, 0.5 * distance) << sweep;
    distance = left;
  }
  EXPECT_LT(distance, 1e-3 * spacing);
}

/// Energy of the triangles around site i if it were at p; edges of length h have their wanted area.
double energy_at(const Cloud& cloud, LocalIndex i, Vec2 p, double h) {
  const auto ring = cloud.stars.ring(i);
  double energy = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 a = cloud.points.position(ring[k]), b = cloud.points.position(ring[(k + 1) % ring.size()]);
    const double area = geometry::cross(a - p, b - p) / 2, wanted = std::sqrt(3) / 4 * h * h;
    const double squares = geometry::dot(a - p, a - p) + geometry::dot(b - p, b - p) + geometry::dot(b - a, b - a);
    energy +=
        squares / (4 * std::sqrt(3) * area) + SweepRules::triangle_stiffness * (area / wanted + wanted / area - 2);
  }
  return energy;
}

/// The step is 0.7 times that of Newton: derivatives by differences give the same.
TEST(TriangleRule, StepsTowardsTheLeastEnergyOfTheStar) {
  const Cloud cloud(lattice(0.5), 1.1 * spacing);
  TriangleRule rule;
  rule.begin_sweep({}); // no bars at all: edges are to have length h
  const double d = 1e-4 * spacing;
  int stars = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    const auto ring = cloud.stars.ring(i);
    if (ring.size() < 3 || std::find(ring.begin(), ring.end(), delaunay::gap) != ring.end())
      continue;
    const Vec2 p = cloud.points.position(i), x{d, 0}, y{0, d};
    const auto energy = [&](Vec2 to) { return energy_at(cloud, i, p + to, 1.1 * spacing); };
    const Vec2 gradient{(energy(x) - energy(-1.0 * x)) / (2 * d), (energy(y) - energy(-1.0 * y)) / (2 * d)};
    const double xx = (energy(x) + energy(-1.0 * x) - 2 * energy({})) / (d * d),
                 yy = (energy(y) + energy(-1.0 * y) - 2 * energy({})) / (d * d),
                 xy = (energy(x + y) - energy(x - y) - energy(y - x) + energy(-1.0 * (x + y))) / (4 * d * d);
    const double determinant = xx * yy - xy * xy;
    const Vec2 newton = (-1 / determinant) * Vec2{yy * gradient.x - xy * gradient.y, xx * gradient.y - xy * gradient.x};
    const Vec2 step = rule.step(cloud.view(), i).move;
    EXPECT_LT(geometry::length(step - SweepRules::triangle_damping * newton), 1e-4 * spacing);
    EXPECT_LT(energy(step), energy({}));
    ++stars;
  }
  EXPECT_GT(stars, 400);
}

TEST(TriangleRule, SitesWithAGapInTheirRingStay) {
  const Cloud cloud(lattice(0.3));
  int open = 0;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    const auto ring = cloud.stars.ring(i);
    if (std::find(ring.begin(), ring.end(), delaunay::gap) == ring.end())
      continue;
    EXPECT_EQ(TriangleRule().step(cloud.view(), i).move, (Vec2{0, 0}));
    ++open;
  }
  EXPECT_GT(open, 0);
}

} // namespace
} // namespace trime::sweep
