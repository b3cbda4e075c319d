// SPDX-License-Identifier: BSD-3-Clause
// The vector kernels against the rules themselves, star by star: the same bits on every kind of processor.
#include "sweep/sweep_kernel.hpp"

#include "unit/sweep/jittered_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace trime::sweep {
namespace {

TEST(SweepKernel, MovesSitesByTheBitsOfTheRules) {
  for (const bool is_graded : {false, true})
    for (const auto& rule : rules()) {
      Cloud cloud(0.3, is_graded);
      const SweepSums sums = measure(cloud.view(), spacing);
      for (int sweep = 0; sweep < 3; ++sweep)
        rule->begin_sweep(sums); // so that there is momentum
      SweepTask task = cloud.task();
      task.rule = rule->parameters();
      std::vector<Pass> passes;
      for (const SweepKernels* kernel : kernels()) {
        Pass pass(cloud.points.owned());
        pass.run(*kernel, task, cloud.points.owned() - 3); // not a whole number of groups
        int moved = 0, suspects = 0;
        for (LocalIndex i = 0; i < cloud.points.owned() - 3; ++i) {
          if (cloud.classes[static_cast<std::size_t>(i)] != SiteClass::local) {
            EXPECT_EQ(task.next_positions[i], task.positions[i]);
            EXPECT_EQ(std::ranges::count(pass.suspects, i),
                      cloud.classes[static_cast<std::size_t>(i)] == SiteClass::exact);
            continue;
          }
          if (std::ranges::count(pass.suspects, i)) { // its triangles are nearly as large as the cap, or flat
            ++suspects;
            continue;
          }
          const Step step = rule->step(cloud.view(), i);
          const Vec2 way = step.move + step.lead;
          if (std::ranges::count(pass.irregular, i)) {
            EXPECT_GT(std::max(geometry::length(step.move), geometry::length(way)), 0.399 * cloud.view().size(i));
            continue;
          }
          EXPECT_EQ(task.next_positions[i], testing::unit_lattice().snap(task.positions[i] + way));
          EXPECT_EQ(task.next_leads[i], step.lead);
          ++moved;
        }
        EXPECT_GT(moved, 300);
        EXPECT_LT(suspects, 30);
        passes.push_back(pass);
        EXPECT_EQ(pass.tally.moving, passes[0].tally.moving);
        EXPECT_EQ(pass.tally.power, passes[0].tally.power);
        EXPECT_EQ(pass.tally.squared_ratio, passes[0].tally.squared_ratio);
        EXPECT_EQ(pass.tally.squared_distance, passes[0].tally.squared_distance);
        EXPECT_EQ(pass.suspects, passes[0].suspects);
        EXPECT_EQ(pass.irregular, passes[0].irregular);
        EXPECT_TRUE(std::ranges::is_sorted(pass.suspects));
      }
    }
}

/// Where some stars are not right any more: sites have moved under their rings.
TEST(CertifyKernel, FindsTheSuspectsOfTheSweepAndMovesNothing) {
  for (const bool is_graded : {false, true}) {
    Cloud cloud(0.3, is_graded, true);
    std::vector<Vec2> places(cloud.points.positions().begin(), cloud.points.positions().end());
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] =
          testing::unit_lattice().snap(places[i] + (0.3 * spacing) * (testing::random_vec2(9, i) - Vec2{0.5, 0.5}));
    SweepTask task = cloud.task();
    task.positions = places.data();
    for (const SweepKernels* kernel : kernels())
      for (const SiteClass least : {SiteClass::local, SiteClass::bordered}) {
        task.least_class = least;
        Pass pass(cloud.points.owned());
        pass.run(*kernel, task, cloud.points.owned() - 3);
        SweepTask at_rest = task;
        at_rest.leads = at_rest.next_positions = at_rest.next_leads = nullptr;
        std::vector<LocalIndex> suspects(places.size());
        suspects.resize(
            static_cast<std::size_t>(kernel->certify(at_rest, 0, cloud.points.owned() - 3, suspects.data())));
        EXPECT_EQ(suspects, pass.suspects);
        EXPECT_GT(suspects.size(), 50U);
      }
  }
}

TEST(SweepKernel, TakesSitesBesideTheBoundaryWhereItIsTold) {
  Cloud cloud(0.3, true, true);
  TriangleRule rule;
  rule.begin_sweep(measure(cloud.view(), spacing));
  SweepTask task = cloud.task();
  task.rule = rule.parameters();
  for (const SweepKernels* kernel : kernels())
    for (const SiteClass least : {SiteClass::local, SiteClass::bordered}) {
      task.least_class = least;
      Pass pass(cloud.points.owned());
      pass.run(*kernel, task, cloud.points.owned());
      int bordered = 0;
      for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
        if (cloud.classes[static_cast<std::size_t>(i)] != SiteClass::bordered)
          continue;
        if (least == SiteClass::local) {
          EXPECT_EQ(task.next_positions[i], task.positions[i]);
          EXPECT_EQ(std::ranges::count(pass.suspects, i), 1);
        } else if (!std::ranges::count(pass.suspects, i) && !std::ranges::count(pass.irregular, i)) {
          const Step step = rule.step(cloud.view(), i);
          EXPECT_EQ(task.next_positions[i], testing::unit_lattice().snap(task.positions[i] + step.move + step.lead));
          ++bordered;
        }
      }
      EXPECT_TRUE(least == SiteClass::local || bordered > 100);
    }
}

TEST(SweepKernel, NamesTheSitesThatItMovesNearTheBoundary) {
  constexpr int cells = 16;
  Cloud cloud(0.3, false);
  CvdRule rule;
  rule.begin_sweep({});
  SweepTask task = cloud.task();
  task.rule = rule.parameters();
  std::vector<std::int8_t> states;
  for (int k = 0; k < cells * cells; ++k)
    states.push_back(k % 3 == 0 ? 0 : 1);
  task.guard.states = states.data();
  task.guard.inverse_side = cells;
  task.guard.columns = task.guard.rows = cells;
  for (const SweepKernels* kernel : kernels()) {
    Pass pass(cloud.points.owned());
    pass.run(*kernel, task, cloud.points.owned());
    EXPECT_GT(pass.guarded.size(), 50U);
    std::vector<LocalIndex> expected;
    for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
      const Vec2 p = task.next_positions[i];
      const int column = static_cast<int>(p.x * cells), row = static_cast<int>(p.y * cells);
      if (cloud.classes[static_cast<std::size_t>(i)] == SiteClass::local && !std::ranges::count(pass.suspects, i) &&
          !std::ranges::count(pass.irregular, i) && states[static_cast<std::size_t>(row * cells + column)] == 0)
        expected.push_back(i);
    }
    EXPECT_EQ(pass.guarded, expected);
  }
}

TEST(SweepKernel, LeavesAPerfectLatticeAsItIs) {
  Cloud cloud(0, false);
  SweepTask task = cloud.task();
  CvdRule rule;
  rule.begin_sweep({});
  task.rule = rule.parameters();
  for (const SweepKernels* kernel : kernels()) {
    Pass pass(cloud.points.owned());
    pass.run(*kernel, task, cloud.points.owned());
    int inside = 0;
    for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
      if (const Vec2 p = cloud.points.position(i); geometry::length(p - Vec2{0.4, 0.4}) < 0.2) { // not at the rim
        EXPECT_EQ(task.next_positions[i], p);
        ++inside;
      }
    EXPECT_GT(inside, 50);
  }
}

/// Moves sites under their old rings: whatever the kernel still accepts must be the star of emptiness.
TEST(SweepKernel, FindsTheStarsThatAreNotRightAnyMore) {
  Cloud cloud(0.3, false);
  SiteList sites;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
    sites.push_back(cloud.points.site(i));
    sites.back().position = testing::unit_lattice().snap(
        sites.back().position +
        (0.4 * spacing) * (testing::random_vec2(9, static_cast<std::size_t>(i)) - Vec2{0.5, 0.5}));
  }
  std::vector<std::vector<LocalIndex>> before;
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    before.emplace_back(cloud.stars.ring(i).begin(), cloud.stars.ring(i).end());
  cloud.points.prepare_advance();
  for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
    cloud.points.next().positions()[static_cast<std::size_t>(i)] = sites[static_cast<std::size_t>(i)].position;
  cloud.points.advance();
  for (LocalIndex tile = 0; tile < cloud.grid.tile_count(); ++tile)
    cloud.points.drifts().set(tile, 0.3 * spacing);
  cloud.points.drifts().set_largest({0.3 * spacing, 0.25});
  SweepTask task = cloud.task();
  for (const SweepKernels* kernel : kernels()) {
    Pass pass(cloud.points.owned());
    pass.run(*kernel, task, cloud.points.owned());
    EXPECT_GT(pass.suspects.size(), 50U);
    std::vector<std::uint8_t> is_suspect(before.size(), 0);
    for (const LocalIndex i : pass.suspects)
      is_suspect[static_cast<std::size_t>(i)] = 1;
    delaunay::StarTable now;
    now.reset(cloud.points.owned());
    std::vector<mesh::BinRef> missing;
    delaunay::StarBuilder(testing::unit_lattice(), cap, 1).update(cloud.points, now, cloud.sizes, {}, missing);
    int right = 0;
    for (LocalIndex i = 0; i < cloud.points.owned(); ++i) {
      const auto& ring = before[static_cast<std::size_t>(i)];
      if (cloud.classes[static_cast<std::size_t>(i)] != SiteClass::local || is_suspect[static_cast<std::size_t>(i)])
        continue;
      // A star that is locally convex is right unless a suspect beside it is not.
      const bool beside = std::ranges::any_of(ring, [&](LocalIndex j) {
        return is_suspect[static_cast<std::size_t>(j)] ||
               cloud.classes[static_cast<std::size_t>(j)] != SiteClass::local;
      });
      if (!beside) {
        EXPECT_TRUE(std::ranges::equal(ring, now.ring(i)));
        ++right;
      }
    }
    EXPECT_GT(right, 10);
  }
}

TEST(QualityKernel, MeasuresAsTheScalarSumsDo) {
  for (const auto& [is_graded, holds_some] :
       {std::pair(false, false), std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
    Cloud cloud(0.4, is_graded, holds_some);
    SweepTask task = cloud.task();
    task.least_class = SiteClass::bordered;
    SweepSums expected;
    for (LocalIndex i = 0; i < cloud.points.owned(); ++i)
      if (cloud.classes[static_cast<std::size_t>(i)] >= SiteClass::bordered)
        measure_star(cloud.view(), i, 0.9 * spacing, expected);
    for (const SweepKernels* kernel : kernels()) {
      std::vector<double> excesses(8 * static_cast<std::size_t>(cloud.points.owned()));
      const QualityTally tally = kernel->measure(task, 0, cloud.points.owned(), 1 / (0.9 * spacing), excesses.data());
      FixedSum lengths, squares, excess;
      lengths.add_units(tally.squared_lengths);
      squares.add_units(tally.squared_sizes);
      excess.add_units(tally.excess);
      AlphaBins bins;
      for (std::int64_t k = 0; k < tally.triangles; ++k)
        bins.add(excesses[static_cast<std::size_t>(k)]);
      EXPECT_EQ(lengths.value(), expected.squared_length_ratio.value());
      EXPECT_EQ(squares.value(), expected.squared_size_ratio.value());
      EXPECT_EQ(excess.value(), expected.excess_alpha.value());
      EXPECT_EQ(tally.triangles, expected.triangles);
      EXPECT_EQ(1 + tally.largest_excess, expected.max_alpha);
      EXPECT_EQ(bins.counts(), expected.alpha_bins.counts());
      EXPECT_GT(tally.triangles, 500);
    }
  }
}

/// The sums that tiles keep add up to those that are computed again, and a tile forgets its sums when its sites move.
TEST(StarMeasures, EqualTheScalarSumsAlsoWhereTilesKeepThem) {
  for (const bool is_graded : {false, true}) {
    Cloud cloud(0.4, is_graded, true);
    const SweepTask task = cloud.task();
    StarMeasures measures;
    const SweepSums first = measures.measure(task, cloud.view(), spacing);
    EXPECT_TRUE(first.has_same_measures(measure(cloud.view(), spacing)));
    EXPECT_TRUE(measures.measure(task, cloud.view(), spacing).has_same_measures(first));
    std::vector<Vec2> places(cloud.points.positions().begin(), cloud.points.positions().end());
    const auto moved = std::ranges::find(cloud.classes, SiteClass::local) - cloud.classes.begin();
    places[static_cast<std::size_t>(moved)].x += 0.1 * spacing;
    SweepTask later = task;
    later.positions = places.data();
    EXPECT_TRUE(measures.measure(later, cloud.view(), spacing).has_same_measures(first)) << "the tiles sleep";
    for (LocalIndex t = 0; t < cloud.points.last_tile() - cloud.points.first_tile(); ++t)
      measures.forget(static_cast<std::size_t>(t));
    EXPECT_FALSE(measures.measure(later, cloud.view(), spacing).has_same_measures(first));
    measures.reset();
    EXPECT_TRUE(measures.measure(task, cloud.view(), spacing).has_same_measures(first));
  }
}

} // namespace
} // namespace trime::sweep
