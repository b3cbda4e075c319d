// SPDX-License-Identifier: BSD-3-Clause
// Which vertices of ragged runs go, and which stay.
#include "generalise/ragged_curves.hpp"

#include "boundary_properties.hpp"
#include "core/angle.hpp"
#include "generalise/curve_map.hpp"
#include "generalise_shapes.hpp"

#include <gtest/gtest.h>

namespace trime::generalise {
namespace {

const sizing::UniformSize size(0.1);
constexpr double share = 0.05; // what is nearer than 0.005 is near

std::unique_ptr<Boundary> thin(const Boundary& boundary, Thinning::Extent extent = Thinning::once) {
  return without_ragged_runs(boundary, size, testing::unit_lattice(), {}, {share, extent});
}

/// A square; its lower side goes to and fro by so much at every step.
Boundary saw(double height, double step) {
  std::vector<Vec2> ring;
  for (int k = 0; 0.1 + step * k < 0.9; ++k)
    ring.push_back({0.1 + step * k, k % 2 == 0 ? 0.1 : 0.1 + height});
  ring.insert(ring.end(), {{0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}});
  return boundary_of({polygon_loop(ring)});
}

TEST(RaggedCurves, LeavesSmoothCurvesAlone) {
  EXPECT_EQ(thin(boundary_of({testing::circle_loop({0.5, 0.5}, 0.4)})), nullptr);
  EXPECT_EQ(thin(boundary_of({polygon_loop({{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}})})), nullptr);
  EXPECT_EQ(thin(saw(0.02, 0.02)), nullptr); // no two vertices are near
}

TEST(RaggedCurves, ThinsTeethFarBelowTheSize) {
  const Boundary given = saw(0.001, 0.001);
  const auto made = thin(given);
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
  const auto once = thin(given, Thinning::once);
  ASSERT_TRUE(once);
  EXPECT_GE(once->loops[0].pieces.size(), ring.size() / 3);
  const auto made = thin(given, Thinning::to_the_end);
  ASSERT_TRUE(made);
  expect_proper(*made);
  EXPECT_LT(made->loops[0].pieces.size(), ring.size() / 8);
  EXPECT_EQ(thin(*made), nullptr);
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
  const auto once = thin(given, Thinning::once);
  const auto made = thin(given, Thinning::to_the_end);
  ASSERT_TRUE(once && made);
  EXPECT_EQ(made->loops[0].pieces.size(), once->loops[0].pieces.size());
}

TEST(RaggedCurves, KeepsVerticesThatTheUserWants) {
  Boundary given = saw(0.001, 0.001);
  for (geometry::Piece& piece : given.loops[0].pieces)
    piece.corner = true;
  EXPECT_EQ(thin(given), nullptr);
}

/// Two combs whose teeth, far below the size, stand between each other.
std::vector<Vec2> comb(double from, double to, double step, double tip, double base) {
  std::vector<Vec2> ring;
  for (int k = 0; from + step * k < to; ++k)
    ring.insert(ring.end(), {{from + step * k, base}, {from + step * (k + 0.5), tip}});
  return ring;
}

TEST(RaggedCurves, KeepsCurvesSimpleVertexByVertex) {
  constexpr double step = 0.0005;
  std::vector<Vec2> lower = comb(0.3, 0.6, step, 0.5, 0.498), upper = comb(0.30025, 0.5995, step, 0.4985, 0.5005);
  lower.insert(lower.end(), {{0.8, 0.498}, {0.8, 0.1}, {0.2, 0.1}, {0.2, 0.498}});
  std::reverse(lower.begin(), lower.end());
  upper.insert(upper.end(), {{0.59975, 0.5005}, {0.8, 0.5005}, {0.8, 0.9}, {0.2, 0.9}, {0.2, 0.5005}});
  for (int k = 1; k < 400; ++k) // saws beside the combs: the thinning of these has a way
    upper.insert(upper.end() - 2, {0.8 - 0.001 * k, k % 2 == 0 ? 0.9 : 0.901});
  Boundary given = boundary_of({polygon_loop(lower), polygon_loop(upper)});
  given.loops[1].tag = 2;
  expect_proper(given);
  for (const Thinning::Extent extent : {Thinning::once, Thinning::to_the_end, Thinning::dense}) {
    const auto made = thin(given, extent);
    ASSERT_TRUE(made);
    expect_proper(*made);
    EXPECT_LT(made->loops[1].pieces.size(), given.loops[1].pieces.size() - 150);
  }
}

TEST(RaggedCurves, LeavesPointsOnTheirSide) {
  const Boundary given = saw(0.001, 0.001);
  const geometry::Lattice& lattice = testing::unit_lattice();
  std::vector<Vec2> inside; // each between two teeth
  for (int k = 2; k < 798; k += 2)
    inside.push_back(lattice.snap({0.1 + 0.001 * k, 0.1003}));
  const auto made = without_ragged_runs(given, size, lattice, inside, {share, Thinning::to_the_end});
  const auto without = thin(given, Thinning::to_the_end);
  ASSERT_TRUE(without);
  EXPECT_LT(without->loops[0].pieces.size(), given.loops[0].pieces.size() / 2);
  ASSERT_TRUE(made);
  EXPECT_TRUE(CurveMap(*made, size, lattice, inside).is_valid());
  EXPECT_FALSE(CurveMap(*without, size, lattice, inside).is_valid());
}

TEST(RaggedCurves, KeepsLoopsOfFewVertices) {
  const std::vector<Vec2> tiny{{0.5, 0.5}, {0.501, 0.5}, {0.501, 0.501}, {0.5, 0.501}};
  EXPECT_EQ(thin(boundary_of({polygon_loop(tiny)})), nullptr);
}

TEST(RaggedCurves, FindsRunsAcrossTheStartOfALoop) {
  std::vector<Vec2> ring = {{0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}};
  for (int k = 0; k < 40; ++k)
    ring.push_back({0.3 + 0.001 * k, k % 2 == 0 ? 0.1 : 0.101});
  std::size_t least = ring.size(), most = 0;
  for (std::size_t first = 0; first < ring.size(); ++first) {
    const auto made = thin(boundary_of({polygon_loop(ring)}));
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
