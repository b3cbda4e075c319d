// SPDX-License-Identifier: BSD-3-Clause
// Aspect ratios that are remembered from sweep to sweep: the same bits as those computed anew, whatever moved.
#include "cleanup/patch_optimizer.hpp"

#include "support/periodic_shapes.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using testing::random_vec2;
using testing::unit_lattice;

constexpr LocalIndex points = 40;

Patch patch_of_random_points(std::uint64_t seed) {
  Patch patch(unit_lattice(), {});
  patch.start({0.5, 0.5}, 4, 0.1);
  for (std::uint64_t key = 0; key < points; ++key)
    patch.add(unit_lattice().snap(random_vec2(seed, key)), 0.1, {}, VertexRole::free);
  return patch;
}

/// Asks for all triangles, or every so many of them.
void expect_known(KnownAlphas& alphas, const Patch& patch, std::size_t stride = 1) {
  alphas.follow(patch);
  const auto& triangles = patch.mesh.triangles();
  for (std::size_t k = 0; k < triangles.size(); k += stride)
    if (triangles[k].vertex[0] >= 0) {
      ASSERT_EQ(alphas.alpha(patch, triangles[k]), patch.alpha(triangles[k].vertex)) << "triangle " << k;
    }
}

/// Moves one vertex, unless a triangle would turn over; edges flip.
bool move(Patch& patch, std::uint64_t seed, std::uint64_t key) {
  const auto v = static_cast<LocalIndex>(PatchMesh::frame + static_cast<LocalIndex>(key * 7 % points));
  const Vec2 way = 0.2 * (random_vec2(seed + 1, key) - Vec2{0.5, 0.5});
  return patch.mesh.move(v, unit_lattice().snap(patch.mesh.position(v) + way));
}

TEST(KnownAlphas, FollowWhatMoves) {
  Patch patch = patch_of_random_points(1);
  KnownAlphas alphas;
  int moves = 0;
  for (std::uint64_t sweep = 0; sweep < 60; ++sweep) {
    expect_known(alphas, patch);
    for (std::uint64_t k = 0; k < sweep % 4; ++k)
      moves += move(patch, 1, 4 * sweep + k);
  }
  EXPECT_GT(moves, 10);
}

TEST(KnownAlphas, OfTrianglesThatWereNotAskedForAWhile) {
  Patch patch = patch_of_random_points(2);
  KnownAlphas alphas;
  expect_known(alphas, patch);
  for (std::uint64_t sweep = 0; sweep < 40; ++sweep) {
    move(patch, 2, sweep);
    expect_known(alphas, patch, 1 + sweep % 5);
  }
}

TEST(KnownAlphas, OfATrialThatWasTakenBack) {
  Patch patch = patch_of_random_points(3);
  KnownAlphas alphas;
  for (std::uint64_t sweep = 0; sweep < 20; ++sweep) {
    const Patch before = patch;
    move(patch, 3, sweep);
    expect_known(alphas, patch);
    patch = before;
    expect_known(alphas, patch);
  }
}

TEST(KnownAlphas, ForgetAnotherPatch) {
  KnownAlphas alphas;
  for (std::uint64_t seed = 4; seed < 8; ++seed) {
    alphas.forget();
    expect_known(alphas, patch_of_random_points(seed));
  }
}

} // namespace
} // namespace trime::cleanup
