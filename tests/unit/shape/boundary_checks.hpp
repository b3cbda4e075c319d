// SPDX-License-Identifier: BSD-3-Clause
// Functions that several tests of shapes use: checks of the invariants of a boundary, and short ways to make shapes.
#pragma once

#include "core/random.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::shape {

using geometry::Boundary;
using geometry::Box;
using geometry::Frame;
using geometry::Loop;
using geometry::Piece;
using geometry::Vec2;

inline double random(std::uint64_t i, int slot) {
  return random_unit(1, RandomPurpose::test, i, slot);
}

/// Returns a random point of the box on the coordinate lattice.
inline Vec2 random_point(std::uint64_t i, const Box& box, const Frame& frame) {
  return frame.snap({box.min.x + random(i, 0) * box.width(), box.min.y + random(i, 1) * box.height()});
}

/// Checks that loops are closed, start at their smallest vertex, and are in the order of their tags.
inline void expect_valid(const Boundary& boundary) {
  ASSERT_FALSE(boundary.loops.empty());
  EXPECT_GT(boundary.area, 0);
  for (std::size_t l = 0; l < boundary.loops.size(); ++l) {
    const Loop& loop = boundary.loops[l];
    EXPECT_EQ(loop.tag, static_cast<int>(l) + 1);
    if (l > 0) {
      EXPECT_TRUE(lexicographically_less(boundary.loops[l - 1].pieces[0].start, loop.pieces[0].start));
    }
    for (std::size_t k = 0; k < loop.pieces.size(); ++k) {
      const Piece& piece = loop.pieces[k];
      ASSERT_EQ(piece.end, loop.pieces[(k + 1) % loop.pieces.size()].start);
      EXPECT_NE(piece.start, piece.end);
      if (k > 0) {
        EXPECT_TRUE(lexicographically_less(loop.pieces[0].start, piece.start));
      }
      EXPECT_GE(piece.part, 0);
      EXPECT_LT(piece.part, static_cast<int>(boundary.part_names.size()));
      if (piece.circular) {
        EXPECT_NEAR(length(piece.start - piece.center), piece.radius, 1e-12);
        EXPECT_NEAR(length(piece.end - piece.center), piece.radius, 1e-12);
        EXPECT_LT(length(piece.point(piece.length() * (1 - 1e-12)) - piece.end), 2e-12);
        EXPECT_LT(length(piece.point(piece.length() * 1e-12) - piece.start), 2e-12);
      }
    }
  }
}

/// Checks that the shape lies on the left of every piece, at points next to the middle of the piece.
inline void expect_inside_on_left(const shape::RegionShape& shape) {
  for (const Loop& loop : shape.boundary().loops)
    for (const Piece& piece : loop.pieces) {
      const double s = 0.5 * piece.length(), offset = std::fmin(1e-6, 1e-3 * piece.length());
      const Vec2 normal = offset * left_normal(piece.tangent(s));
      EXPECT_TRUE(shape.inside(shape.frame().snap(piece.point(s) + normal))) << piece.start.x << " " << piece.start.y;
      EXPECT_FALSE(shape.inside(shape.frame().snap(piece.point(s) - normal))) << piece.start.x << " " << piece.start.y;
    }
}

inline double distance_by_brute_force(const Boundary& boundary, Vec2 p) {
  double best = 1e300;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      best = std::min(best, piece.distance(p));
  return best;
}

/// Returns the message of the GeometryError (or ConfigError) that `make` throws; empty if it throws nothing.
template <class Exception, class Make>
std::string message_of(const Make& make) {
  try {
    make();
  } catch (const Exception& error) {
    return error.what();
  }
  return {};
}

} // namespace trime::shape
