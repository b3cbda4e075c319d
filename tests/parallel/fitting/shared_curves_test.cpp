// SPDX-License-Identifier: BSD-3-Clause
// Curves that rank 0 simplifies for all: the others get them, hold nothing else, and hear of errors.
#include "fitting/layout.hpp"
#include "fitting/rules.hpp"
#include "support/boundary_shapes.hpp"
#include "trime/core/error.hpp"

#include "core/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace trime::fitting {
namespace {

using geometry::Vec2;

/// A round coast of so many vertices, with small waves.
geometry::Boundary coast(std::int64_t vertices) {
  std::vector<Vec2> ring;
  for (std::int64_t k = 0; k < vertices; ++k) {
    const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(vertices);
    const double radius = 0.4 + 0.01 * sin_cos(40 * angle).cos;
    ring.push_back(Vec2{0.5, 0.5} + radius * Vec2{sin_cos(angle).cos, sin_cos(angle).sin});
  }
  return testing::boundary_of({testing::polygon_loop(ring)});
}

/// A size that only some ranks can tell.
class SizeOfSome final : public sizing::SizeField {
public:
  explicit SizeOfSome(bool can_tell) : can_tell_(can_tell) {}
  double size(Vec2) const override {
    if (!can_tell_)
      throw GeometryError("no size here");
    return 1;
  }

private:
  bool can_tell_;
};

/// What a layout needs.
struct Setting {
  Setting(const comm::Communicator& of, const geometry::Boundary& given, const sizing::SizeField& relative)
      : comm(of), domain(geometry::Frame({{0, 0}, {1, 1}}), given), size(relative),
        fixed(domain.boundary(), geometry::Box{{0, 0}, {1, 1}}, {}, testing::unit_lattice(), log) {}
  LayoutContext context() { return {comm, domain, size, options, log, timers, fixed}; }

  const comm::Communicator& comm;
  const geometry::Domain domain;
  const sizing::SizeField& size;
  const FitOptions options{};
  Log log{LogLevel::silent, false};
  TimerTable timers;
  const boundary::FixedPoints fixed;
};

CurvesAtSize shared_curves(const comm::Communicator& comm, const geometry::Boundary& given, double h) {
  const sizing::UniformSize one(1);
  Setting setting(comm, given, one);
  CurvesAtSize curves;
  share_simplified_curves(setting.context(), sizing::ScaledSize(one, h), h, curves);
  return curves;
}

void expect_same(const geometry::Boundary& is, const geometry::Boundary& was) {
  EXPECT_EQ(is.area, was.area);
  ASSERT_EQ(is.loops.size(), was.loops.size());
  for (std::size_t k = 0; k < was.loops.size(); ++k) {
    ASSERT_EQ(is.loops[k].pieces.size(), was.loops[k].pieces.size());
    for (std::size_t j = 0; j < was.loops[k].pieces.size(); ++j)
      EXPECT_EQ(is.loops[k].pieces[j].start, was.loops[k].pieces[j].start);
  }
}

TEST(SharedCurves, ReachAllRanksAndNothingElseDoes) {
  const comm::Communicator world = comm::Communicator::world(), self = comm::Communicator::self();
  const geometry::Boundary given = coast(8 * fitting::LayoutRules::many_pieces);
  const double h = 0.1;
  const sizing::UniformSize one(1);
  Setting alone(self, given, one);
  CurvesAtSize expected;
  simplify_curves(alone.context(), sizing::ScaledSize(one, h), h, expected);
  ASSERT_TRUE(expected.found && expected.thinned && expected.given);
  const CurvesAtSize curves = shared_curves(world, given, h);
  if (world.size() == 1) {
    EXPECT_FALSE(curves.found); // simplify_curves will
    return;
  }
  EXPECT_EQ(curves.factor, h);
  ASSERT_TRUE(curves.found);
  expect_same(curves.found->boundary, expected.found->boundary);
  EXPECT_EQ(curves.found->counts.thinned, expected.found->counts.thinned);
  EXPECT_EQ(curves.thinned != nullptr, world.is_root());
  EXPECT_EQ(curves.given != nullptr, world.is_root());
}

TEST(SharedCurves, OfFewPiecesAreMadeByEachRank) {
  const CurvesAtSize curves =
      shared_curves(comm::Communicator::world(), coast(fitting::LayoutRules::many_pieces - 1), 0.02);
  EXPECT_EQ(curves.factor, 0);
  EXPECT_FALSE(curves.found);
}

TEST(SharedCurves, BringAnErrorOfTheFirstRankToAll) {
  const comm::Communicator world = comm::Communicator::world();
  if (world.size() == 1)
    GTEST_SKIP() << "one rank";
  const geometry::Boundary given = coast(fitting::LayoutRules::many_pieces);
  const SizeOfSome size(!world.is_root());
  Setting setting(world, given, size);
  CurvesAtSize curves;
  EXPECT_THROW(share_simplified_curves(setting.context(), sizing::ScaledSize(size, 0.02), 0.02, curves), GeometryError);
}

} // namespace
} // namespace trime::fitting
