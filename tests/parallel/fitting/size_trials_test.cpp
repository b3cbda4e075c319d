// SPDX-License-Identifier: BSD-3-Clause
// Trials of the size on a ragged coast: what one finds does not depend on those before, and curves serve for factors
// near their own.
#include "fitting/size_trials.hpp"

#include "core/angle.hpp"
#include "core/random.hpp"
#include "fitting/count_estimate.hpp"
#include "fitting/rules.hpp"
#include "fitting/simplified_curves.hpp"
#include "support/boundary_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace trime::fitting {
namespace {

using geometry::Vec2;

/// A round coast with bays of all widths.
geometry::Boundary coast(double roughness) {
  constexpr std::size_t n = 1024;
  std::vector<double> depth(n);
  for (std::size_t step = n / 4; step > 0; step /= 2)
    for (std::size_t k = step; k < n; k += 2 * step) {
      const double swing = roughness * std::pow(4.0 * static_cast<double>(step) / n, 0.6);
      depth[k] =
          0.5 * (depth[k - step] + depth[(k + step) % n]) + swing * (random_unit(7, RandomPurpose::test, k, 0) - 0.5);
    }
  std::vector<Vec2> ring;
  for (std::size_t k = 0; k < n; ++k) {
    const SinCos turn = sin_cos(2 * pi * static_cast<double>(k) / n);
    ring.push_back(Vec2{0.5, 0.5} + (0.27 + depth[k]) * Vec2{turn.cos, turn.sin});
  }
  return testing::boundary_of({testing::polygon_loop(ring)});
}

/// Twice as large on the right as on the left.
class Graded final : public sizing::SizeField {
public:
  double size(Vec2 p) const override { return 0.5 + p.x; }
};

/// What a layout needs.
struct Setting {
  explicit Setting(const geometry::Boundary& given)
      : domain(geometry::Frame({{0, 0}, {1, 1}}), given),
        fixed(domain.boundary(), geometry::Box{{0, 0}, {1, 1}}, {}, testing::unit_lattice(), log) {
    options.points = 400;
  }

  const comm::Communicator comm = comm::Communicator::world();
  const geometry::Domain domain;
  const Graded size{};
  FitOptions options{};
  Log log{LogLevel::silent, false};
  TimerTable timers;
  const boundary::FixedPoints fixed;
  const LayoutContext context{comm, domain, size, options, log, timers, fixed};
};

constexpr double rough = 0.15, points = 400, factor = 0.06;

SizeTrial trial_after(const Setting& setting, const std::vector<double>& others) {
  SizeTrials trials(setting.context, points, 1);
  for (const double other : others)
    trials.run(other);
  return trials.run(factor);
}

TEST(SizeTrials, AreTheSameAfterOthersWithOtherCurves) {
  const Setting setting(coast(rough));
  const SizeTrial first = trial_after(setting, {});
  ASSERT_TRUE(first.fitted.curves.found);
  ASSERT_FALSE(first.fitted.limits.empty());
  for (const std::vector<double>& others : {std::vector<double>{0.07}, {0.04}, {0.12, 0.04}}) {
    const SizeTrial trial = trial_after(setting, others);
    EXPECT_EQ(trial.points, first.points);
    EXPECT_EQ(trial.fitted.limits.size(), first.fitted.limits.size());
    EXPECT_EQ(trial.fit.stage.polygon.sites.size(), first.fit.stage.polygon.sites.size());
  }
}

TEST(SizeTrials, KeepCurvesOfALittleSmallerFactors) {
  const Setting setting(coast(rough));
  SizeTrials trials(setting.context, points, 1);
  const double smaller = (1 - 0.9 * LayoutRules::finer_curves) * factor;
  trials.run(smaller);
  EXPECT_EQ(trials.run(factor).fitted.curves.factor, smaller);
  const double larger = (1 + 1.1 * LayoutRules::same_curves) * factor;
  EXPECT_EQ(trials.run(larger).fitted.curves.factor, larger);
  EXPECT_EQ(trials.run(factor).fitted.curves.factor, factor);
}

TEST(CountEstimate, GoesByStridesOnlyWhereTheBoundaryIsRagged) {
  for (const double roughness : {0.0, rough}) {
    const Setting setting(coast(roughness));
    CountEstimate estimate(setting.context, points, 0.01, 1);
    const std::optional<double> along = estimate.points(factor);
    EXPECT_EQ(estimate.use_strides(factor), roughness > 0);
    const std::optional<double> strides = estimate.points(factor);
    ASSERT_TRUE(along && strides);
    if (roughness > 0)
      EXPECT_LT(*strides, 0.9 * *along);
    else
      EXPECT_EQ(*strides, *along);
  }
}

} // namespace
} // namespace trime::fitting
