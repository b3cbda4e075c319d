// SPDX-License-Identifier: BSD-3-Clause
// Which vertices of ragged runs go, and which stay.
#include "generalise/ragged_curves.hpp"

#include "boundary_properties.hpp"
#include "core/angle.hpp"
#include "generalise_shapes.hpp"

#include <gtest/gtest.h>

namespace trime::generalise {
namespace {

const sizing::UniformSize size(0.1);
constexpr double share = 0.05; // what is nearer than 0.005 is near

/// A square; its lower side goes to and fro by so much at every step.
Boundary saw(double height, double step) {
  std::vector<Vec2> ring;
  for (int k = 0; 0.1 + step * k < 0.9; ++k)
    ring.push_back({0.1 + step * k, k % 2 == 0 ? 0.1 : 0.1 + height});
  ring.insert(ring.end(), {{0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}});
  return boundary_of({polygon_loop(ring)});
}

TEST(RaggedCurves, LeavesSmoothCurvesAlone) {
  EXPECT_EQ(without_ragged_runs(boundary_of({testing::circle_loop({0.5, 0.5}, 0.4)}), size, share), nullptr);
  EXPECT_EQ(without_ragged_runs(boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}})}), size, share),
            nullptr);
  EXPECT_EQ(without_ragged_runs(saw(0.02, 0.02), size, share), nullptr); // no two vertices are near
}

TEST(RaggedCurves, ThinsTeethFarBelowTheSize) {
  const Boundary given = saw(0.001, 0.001);
  const auto made = without_ragged_runs(given, size, share);
  ASSERT_TRUE(made);
  expect_proper(*made);
  EXPECT_LT(made->loops[0].pieces.size(), given.loops[0].pieces.size() / 2);
  EXPECT_LT(largest_deviation(*made, given, 1e-4), share * 0.1);
  std::set<std::pair<double, double>> vertices;
  for (const geometry::Piece& piece : given.loops[0].pieces)
    vertices.insert({piece.start.x, piece.start.y});
  for (const geometry::Piece& piece : made->loops[0].pieces)
    EXPECT_TRUE(vertices.contains({piece.start.x, piece.start.y}));
}

TEST(RaggedCurves, ThinsDenseLoopsUntilNoVertexGoes) {
  std::vector<Vec2> ring;
  for (int k = 0; k < 20000; ++k) { // 16 of them on the way on which smooth curves are thinned
    const SinCos turn = sin_cos(2 * pi * k / 20000);
    ring.push_back(Vec2{0.5, 0.5} + 0.4 * Vec2{turn.cos, turn.sin});
  }
  const Boundary given = boundary_of({polygon_loop(ring)});
  const auto once = without_ragged_runs(given, size, share, Thinning::once);
  ASSERT_TRUE(once);
  EXPECT_GE(once->loops[0].pieces.size(), ring.size() / 3);
  const auto made = without_ragged_runs(given, size, share, Thinning::to_the_end);
  ASSERT_TRUE(made);
  expect_proper(*made);
  EXPECT_LT(made->loops[0].pieces.size(), ring.size() / 8);
  EXPECT_EQ(without_ragged_runs(*made, size, share), nullptr);
  EXPECT_LT(largest_deviation(*made, given, 1e-4), share * 0.1);
  EXPECT_NEAR(made->area, given.area, 1e-4 * given.area);
}

TEST(RaggedCurves, ThinsLoopsThatAreNotDenseOnceOnly) {
  Boundary given = saw(0.02, 0.02); // nothing is near there
  std::vector<geometry::Piece>& pieces = given.loops[0].pieces;
  std::vector<Vec2> ring;
  for (const geometry::Piece& piece : pieces)
    ring.push_back(piece.start);
  ring.insert(ring.begin() + 1, {ring[0] + Vec2{0.0002, 0.0001}, ring[0] + Vec2{0.0004, 0.0002}}); // three in a row
  given = boundary_of({polygon_loop(ring)});
  const auto once = without_ragged_runs(given, size, share, Thinning::once);
  const auto made = without_ragged_runs(given, size, share, Thinning::to_the_end);
  ASSERT_TRUE(once && made);
  EXPECT_EQ(made->loops[0].pieces.size(), once->loops[0].pieces.size());
}

TEST(RaggedCurves, KeepsVerticesThatTheUserWants) {
  Boundary given = saw(0.001, 0.001);
  for (geometry::Piece& piece : given.loops[0].pieces)
    piece.corner = true;
  EXPECT_EQ(without_ragged_runs(given, size, share), nullptr);
}

TEST(RaggedCurves, KeepsLoopsOfFewVertices) {
  const std::vector<Vec2> tiny{{0.5, 0.5}, {0.501, 0.5}, {0.501, 0.501}, {0.5, 0.501}};
  EXPECT_EQ(without_ragged_runs(boundary_of({polygon_loop(tiny)}), size, share), nullptr);
}

TEST(RaggedCurves, FindsRunsAcrossTheStartOfALoop) {
  std::vector<Vec2> ring = {{0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}};
  for (int k = 0; k < 40; ++k)
    ring.push_back({0.3 + 0.001 * k, k % 2 == 0 ? 0.1 : 0.101});
  std::size_t least = ring.size(), most = 0;
  for (std::size_t first = 0; first < ring.size(); ++first) {
    const auto made = without_ragged_runs(boundary_of({polygon_loop(ring)}), size, share);
    ASSERT_TRUE(made);
    least = std::min(least, made->loops[0].pieces.size());
    most = std::max(most, made->loops[0].pieces.size());
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  }
  EXPECT_LE(most, least + 4); // ties are decided by the order
  EXPECT_LE(most, ring.size() / 2);
}

} // namespace
} // namespace trime::generalise
