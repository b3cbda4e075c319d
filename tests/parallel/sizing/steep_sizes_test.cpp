// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/steep_sizes.hpp"

#include "core/angle.hpp"
#include "support/boundary_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <utility>

namespace trime::sizing {
namespace {

using geometry::Vec2;

class Given final : public SizeField {
public:
  explicit Given(std::function<double(Vec2)> function) : function_(std::move(function)) {}
  double size(Vec2 p) const override { return function_(p); }

private:
  std::function<double(Vec2)> function_;
};

geometry::Boundary square() {
  return testing::boundary_of({testing::polygon_loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})});
}

/// A size in the unit square, and the size after its growth was limited.
struct Limited {
  comm::Communicator world = comm::Communicator::world();
  Given field;
  geometry::Boundary boundary = square();
  double gradation;
  ScaledSize asked{field, 1};
  SteepSizes steep{world, field, boundary, testing::unit_lattice(), 10000};
  SteepSizes::Limits found = steep.limits(asked, gradation, 1e6);
  const std::vector<SizeLimit>& limits = found.limits;
  LoweredSize lowered{asked, {{limits, found.gradation}}, {}};

  Limited(std::function<double(Vec2)> function, double its_gradation)
      : field(std::move(function)), gradation(its_gradation) {}
};

/// Expects about min over y of size(y) + gradation |x - y|, where `low` is the distance to the nearest low place.
void expect_cone(const Limited& limited, double least, const std::function<double(Vec2)>& distance, double error) {
  for (int k = 0; k < 400; ++k) {
    const Vec2 p{std::fmod(0.5 + 0.618034 * k, 1), std::fmod(0.25 + 0.754878 * k, 1)};
    const double expected = std::fmin(limited.field.size(p), least + limited.found.gradation * distance(p));
    EXPECT_NEAR(limited.lowered.size(p) / expected, 1, error) << p.x << " " << p.y;
  }
}

TEST(SteepSizes, GentleSizesHaveNoLimits) {
  EXPECT_TRUE(Limited([](Vec2 p) { return 0.1 + 0.25 * p.x; }, 0.3).limits.empty());
  EXPECT_TRUE(Limited([](Vec2 p) { return 0.1 + 0.05 * std::sin(3 * p.x + 2 * p.y); }, 0.3).limits.empty());
}

TEST(SteepSizes, AJumpBecomesACone) {
  const Limited limited([](Vec2 p) { return p.x < 0.5 ? 0.01 : 1; }, 0.3);
  EXPECT_GT(limited.limits.size(), 100u);
  expect_cone(
      limited, 0.01, [](Vec2 p) { return std::fmax(0, p.x - 0.5); }, 0.06);
}

TEST(SteepSizes, ABandFarNarrowerThanTheSamplesIsFollowed) {
  const double half_width = 0.0008; // the samples are 0.01 apart
  const auto distance = [&](Vec2 p) {
    return std::fmax(0, std::fabs(std::hypot(p.x - 0.5, p.y - 0.5) - 0.3) - half_width);
  };
  const Limited limited([&](Vec2 p) { return distance(p) > 0 ? 1.0 : 0.004; }, 0.2);
  expect_cone(limited, 0.004, distance, 0.12);
}

TEST(SteepSizes, AKinkIsFollowedAlongItsLowestLine) {
  const auto distance = [](Vec2 p) { return std::fabs(p.x - 0.3 - 0.2 * p.y) / std::hypot(1, 0.2); };
  const Limited limited([&](Vec2 p) { return 0.01 + 5 * distance(p); }, 0.3);
  expect_cone(limited, 0.01, distance, 0.15);
}

/// A disc of many short edges, and a size that grows fast with the distance from its circle.
struct FromTheCircle {
  static constexpr int corners = 4000;
  mutable std::atomic<int> evaluations = 0;
  comm::Communicator world = comm::Communicator::world();
  Given field{[this](Vec2 p) {
    ++evaluations;
    return 0.002 + 2 * std::fabs(0.4 - geometry::length(p - Vec2{0.5, 0.5}));
  }};
  geometry::Boundary boundary;
  ScaledSize asked{field, 1};

  FromTheCircle() {
    std::vector<Vec2> ring;
    for (int k = 0; k < corners; ++k)
      ring.push_back({0.5 + 0.4 * std::cos(2 * pi * k / corners), 0.5 + 0.4 * std::sin(2 * pi * k / corners)});
    boundary = testing::boundary_of({testing::polygon_loop(ring)});
  }
};

TEST(SteepSizes, SizesThatGrowFromTheBoundaryNeedNoSearch) {
  FromTheCircle given;
  SteepSizes steep(given.world, given.field, given.boundary, testing::unit_lattice(), 1000);
  given.evaluations = 0;
  const SteepSizes::Limits found = steep.limits(given.asked, 0.2, 1e6);
  EXPECT_FALSE(found.is_full);
  EXPECT_LT(given.evaluations, 5 * static_cast<int>(found.limits.size())); // 200 along an edge that is followed
  const LoweredSize lowered(given.asked, {{found.limits, found.gradation}}, {});
  for (int k = 0; k < 400; ++k) {
    const Vec2 p{std::fmod(0.5 + 0.618034 * k, 1), std::fmod(0.25 + 0.754878 * k, 1)};
    const double distance = 0.4 - geometry::length(p - Vec2{0.5, 0.5});
    if (distance > 0) {
      EXPECT_NEAR(lowered.size(p) / (0.002 + found.gradation * distance), 1, 0.05) << p.x << " " << p.y;
    }
  }
}

TEST(SteepSizes, TheSearchEndsWhereAMeshWouldHaveTooManyPoints) {
  FromTheCircle given;
  SteepSizes steep(given.world, given.field, given.boundary, testing::unit_lattice(), 1000);
  EXPECT_TRUE(steep.limits(given.asked, 0.2, 500).is_full);
}

TEST(SteepSizes, TheGrowthOfASmoothSizeIsLimited) {
  const Limited limited([](Vec2 p) { return 0.01 * std::exp(8 * p.x); }, 0.3);
  for (int k = 0; k < 400; ++k) {
    const Vec2 p{0.99 * std::fmod(0.5 + 0.618034 * k, 1), std::fmod(0.25 + 0.754878 * k, 1)};
    const double growth = (limited.lowered.size(p + Vec2{0.005, 0}) - limited.lowered.size(p)) / 0.005;
    EXPECT_LE(growth, 0.3 * 1.02) << p.x;
    EXPECT_LE(limited.lowered.size(p), limited.field.size(p));
  }
}

TEST(SteepSizes, PlacesOutsideTheShapeDoNotCount) {
  Given field([](Vec2 p) { return p.x < 0.45 ? 0.001 : 0.1; });
  const geometry::Boundary boundary = testing::boundary_of(
      {testing::polygon_loop({{0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.5, 0.9}, {0.9, 0.5}, {0.5, 0.1}})});
  const comm::Communicator world = comm::Communicator::world();
  SteepSizes steep(world, field, boundary, testing::unit_lattice(), 10000);
  EXPECT_TRUE(steep.limits(ScaledSize(field, 1), 0.3, 1e6).limits.empty());
}

TEST(SteepSizes, AllRanksFindTheSameLimits) {
  const auto size = [](Vec2 p) { return std::fabs(p.x - p.y * p.y) < 0.003 ? 0.01 : 1; };
  Given field(size);
  const geometry::Boundary boundary = square();
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  SteepSizes shared(world, field, boundary, testing::unit_lattice(), 10000),
      alone(self, field, boundary, testing::unit_lattice(), 10000);
  const ScaledSize asked(field, 1);
  const std::vector<SizeLimit> found = shared.limits(asked, 0.3, 1e6).limits,
                               expected = alone.limits(asked, 0.3, 1e6).limits;
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].place, expected[k].place);
    EXPECT_EQ(found[k].size, expected[k].size);
  }
}

TEST(SteepSizes, ASizeThatThrowsOnOneRankThrowsOnAll) {
  const comm::Communicator world = comm::Communicator::world();
  const bool throws = world.rank() == world.size() - 1;
  Given field([=](Vec2 p) -> double {
    if (throws && p.x > 0.9)
      throw GeometryError("no value");
    return 1;
  });
  const geometry::Boundary boundary = square();
  EXPECT_THROW(SteepSizes(world, field, boundary, testing::unit_lattice(), 10000), GeometryError);
}

TEST(SteepSizes, TheSameFactorScalesTheSlope) {
  const auto size = [](Vec2 p) { return 0.1 + 0.5 * p.x; };
  EXPECT_FALSE(Limited(size, 0.3).limits.empty());
  Given field(size);
  const geometry::Boundary boundary = square();
  const comm::Communicator world = comm::Communicator::world();
  SteepSizes steep(world, field, boundary, testing::unit_lattice(), 10000);
  EXPECT_TRUE(steep.limits(ScaledSize(field, 0.5), 0.3, 1e6).limits.empty());
}

} // namespace
} // namespace trime::sizing
