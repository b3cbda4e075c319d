// SPDX-License-Identifier: BSD-3-Clause
// A stage notes for which size its curves were simplified, also if the boundary was not.
#include "fitting/layout.hpp"
#include "support/boundary_shapes.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace trime::fitting {
namespace {

using geometry::Vec2;

/// A square with a line inside that goes up and down by far less than the sizes of the test.
geometry::Domain square_with_zigzag() {
  geometry::Domain domain(geometry::Frame({{0, 0}, {1, 1}}),
                          testing::boundary_of({testing::polygon_loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})}));
  geometry::InnerArc arc;
  const auto vertex = [](int k) { return testing::unit_lattice().snap(Vec2{0.2 + 0.01 * k, 0.5 + 0.001 * (k % 2)}); };
  for (int k = 0; k < 60; ++k) {
    geometry::Piece& piece = arc.pieces.emplace_back();
    piece.start = vertex(k);
    piece.end = vertex(k + 1);
  }
  geometry::InnerCurves curves;
  curves.arcs.push_back(std::move(arc));
  curves.names = {"zigzag"};
  domain.set_curves(std::move(curves));
  return domain;
}

TEST(Coarseness, IsNotedWhereOnlyCurvesInsideAreSimplified) {
  const comm::Communicator world = comm::Communicator::world();
  const geometry::Domain domain = square_with_zigzag();
  const sizing::UniformSize size(1);
  const FitOptions options;
  Log log{LogLevel::silent, false};
  TimerTable timers;
  const boundary::FixedPoints fixed(domain.boundary(), geometry::Box{{0, 0}, {1, 1}}, {}, testing::unit_lattice(), log);
  const LayoutContext context{world, domain, size, options, log, timers, fixed};
  FittedSize fitted;
  fitted.factor = 0.08;
  EXPECT_EQ(lay_stage(context, fitted, 1, 200).simplified.coarseness, 1);
  ASSERT_TRUE(fitted.curves.inner);
  EXPECT_FALSE(fitted.curves.found) << "the boundary of a square has nothing to simplify";
  fitted.curves.held = true;
  fitted.factor = 0.04;
  EXPECT_EQ(lay_stage(context, fitted, 1, 800).simplified.coarseness, 2);
}

} // namespace
} // namespace trime::fitting
