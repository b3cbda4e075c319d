// SPDX-License-Identifier: BSD-3-Clause
// Boundaries at the resolution of a mesh: what stays, what goes, and what must hold for every shape.
#include "generalise/generalise.hpp"

#include "boundary_properties.hpp"
#include "generalise/narrow_parts.hpp"
#include "generalise/rules.hpp"
#include "generalise_shapes.hpp"

#include <gtest/gtest.h>

namespace trime::generalise {
namespace {

using testing::circle_loop;
using testing::unit_lattice;

std::unique_ptr<const Generalised> at_size(const Boundary& boundary, double h, Narrow narrow = Narrow::keep,
                                           const std::vector<Vec2>& inside = {}) {
  return generalise(boundary, sizing::UniformSize(h), unit_lattice(), {narrow}, inside);
}

Loop box(Vec2 low, Vec2 high, bool hole = false, int tag = 1) {
  const std::vector<Vec2> ring{low, {high.x, low.y}, high, {low.x, high.y}};
  return polygon_loop(hole ? reversed(ring) : ring, tag);
}

/// A disc with teeth as high and wide as 0.1.
Loop gear() {
  std::vector<Vec2> ring;
  for (int k = 0; k < 24; ++k) {
    const SinCos turn = sin_cos(pi * k / 12);
    ring.push_back(Vec2{0.5, 0.5} + (k / 2 % 2 == 0 ? 0.3 : 0.4) * Vec2{turn.cos, turn.sin});
  }
  return polygon_loop(ring);
}

TEST(Generalise, LeavesShapesWithoutNarrowPartsAlone) {
  for (const double h : {0.1, 0.02, 0.001})
    for (const Narrow narrow : {Narrow::keep, Narrow::close}) {
      EXPECT_EQ(at_size(boundary_of({box({0.1, 0.1}, {0.9, 0.9})}), h, narrow), nullptr);
      EXPECT_EQ(at_size(boundary_of({circle_loop({0.5, 0.5}, 0.4)}), h, narrow), nullptr);
      EXPECT_EQ(at_size(boundary_of({gear()}), h, narrow), nullptr);
    }
}

TEST(Generalise, KeepsSharpCornersOfTheShape) {
  const Boundary sharp = boundary_of({polygon_loop({{0.1, 0.5}, {0.9, 0.45}, {0.9, 0.55}})});
  EXPECT_EQ(at_size(sharp, 0.05), nullptr);
  const Boundary notch = boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.48}, {0.3, 0.5}, {0.9, 0.52}, {0.9, 0.9}, {0.1, 0.9}})});
  EXPECT_EQ(at_size(notch, 0.05), nullptr);
}

} // namespace
} // namespace trime::generalise
