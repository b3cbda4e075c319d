// SPDX-License-Identifier: BSD-3-Clause
// Cells of single sites: inside, at straight and reflex places of the boundary, between regions, on lattices.
#include "dual/site_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trime::dual {
namespace {

using geometry::Vec2;

Vec2 at_angle(double degrees, double radius = 1) {
  const double angle = degrees * std::numbers::pi / 180;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// A site with neighbours in these directions. @param regions by triangle
Surroundings fan(const std::vector<Vec2>& arms, bool is_closed, const std::vector<std::int32_t>& regions) {
  Surroundings around;
  around.is_closed = is_closed;
  around.arms = arms;
  around.regions = regions;
  for (std::size_t k = 0; k < regions.size(); ++k) {
    around.triangles.push_back(static_cast<LocalIndex>(k));
    around.centres.push_back(circumcentre(arms[k], arms[(k + 1) % arms.size()]));
  }
  for (std::size_t k = 0; k < arms.size(); ++k)
    around.ends.push_back(static_cast<LocalIndex>(k + 1));
  return around;
}

Surroundings hexagon(const std::vector<std::int32_t>& regions) {
  std::vector<Vec2> arms;
  for (int k = 0; k < 6; ++k)
    arms.push_back(at_angle(60 * k));
  return fan(arms, true, regions);
}

const double hexagon_area = std::sqrt(3) / 2; // of the cell of neighbours at distance 1

double area_of(const Surroundings& around, const CellPart& part) {
  return moments_of(corners_of(around, part)).area;
}

TEST(Circumcentre, OfARightAngleIsTheMiddleOfTheLongSide) {
  EXPECT_EQ(circumcentre({1, 0}, {0, 1}), (Vec2{0.5, 0.5}));
  EXPECT_EQ(circumcentre({1, 0}, {1, 1}), (Vec2{0.5, 0.5}));
  EXPECT_EQ(circumcentre({3, 0}, {0, 4}), (Vec2{1.5, 2}));
}

TEST(SiteCell, OfAHexagonIsAHexagon) {
  const Surroundings around = hexagon({1, 1, 1, 1, 1, 1});
  const std::vector<CellPart> parts = parts_of(around);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_TRUE(parts[0].is_round);
  EXPECT_EQ(corners_of(around, parts[0]).size(), 6U);
  const Moments moments = moments_of(corners_of(around, parts[0]));
  EXPECT_NEAR(moments.area, hexagon_area, 1e-15);
  EXPECT_NEAR(length(moments.centroid), 0, 1e-15);
  for (std::size_t spoke = 0; spoke < 6; ++spoke) {
    const CellFace face = face_of(around, spoke);
    EXPECT_EQ(face.parts, 1);
    EXPECT_FALSE(face.is_boundary);
    EXPECT_NEAR(face.dual_length(), 1 / std::sqrt(3), 1e-15);
  }
}

TEST(SiteCell, BetweenRegionsHasAPartInEach) {
  const Surroundings around = hexagon({7, 3, 3, 3, 3, 7});
  const std::vector<CellPart> parts = parts_of(around);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].region, 3);
  EXPECT_EQ(parts[0].first_spoke, 1U);
  EXPECT_EQ(parts[0].triangles, 4U);
  EXPECT_EQ(parts[1].region, 7);
  EXPECT_EQ(corners_of(around, parts[0]).size(), 4 + 3U);
  EXPECT_NEAR(area_of(around, parts[0]), hexagon_area * 4 / 6, 1e-15);
  EXPECT_NEAR(area_of(around, parts[1]), hexagon_area * 2 / 6, 1e-15);
  const CellFace face = face_of(around, 1); // region 3 on the left
  ASSERT_EQ(face.parts, 2);
  EXPECT_EQ(face.regions, (std::array{3, 7}));
  EXPECT_NEAR(face.dual_lengths[0], 0.5 / std::sqrt(3), 1e-15);
  EXPECT_NEAR(face.dual_lengths[1], 0.5 / std::sqrt(3), 1e-15);
  EXPECT_EQ(whole_cell(around).region, 3);
  EXPECT_EQ(whole_cell(around).triangles, 6U);
  EXPECT_EQ(whole_cell(hexagon({2, 2, 2, 1, 1, 1})).region, 1) << "equal shares";
}

TEST(SiteCell, ThatTwoPartsOfARegionTouchHasBothOfThem) {
  const std::vector<CellPart> parts = parts_of(hexagon({1, 2, 2, 1, 2, 2}));
  ASSERT_EQ(parts.size(), 4U);
  std::size_t triangles = 0;
  for (const CellPart& part : parts)
    triangles += part.triangles;
  EXPECT_EQ(triangles, 6U);
}

TEST(SiteCell, AtAStraightBoundaryEndsAtTheMiddlesOfItsEdges) {
  const Surroundings around = fan({at_angle(0), at_angle(60), at_angle(120), at_angle(180)}, false, {1, 1, 1});
  const std::vector<CellPart> parts = parts_of(around);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_FALSE(parts[0].is_round);
  const std::vector<Vec2> corners = corners_of(around, parts[0]);
  ASSERT_EQ(corners.size(), 6U);
  EXPECT_EQ(corners.front(), (Vec2{0.5, 0}));
  EXPECT_EQ(corners.back(), (Vec2{0, 0}));
  EXPECT_NEAR(area_of(around, parts[0]), hexagon_area / 2, 1e-15);
  EXPECT_TRUE(face_of(around, 0).is_boundary);
  EXPECT_TRUE(face_of(around, 3).is_boundary);
  EXPECT_FALSE(face_of(around, 1).is_boundary);
  EXPECT_NEAR(face_of(around, 3).dual_length(), 0.5 / std::sqrt(3), 1e-15);
}

TEST(SiteCell, AtAReflexCornerIsNotConvexButHasItsArea) {
  const Surroundings around = fan(
      {at_angle(0), at_angle(60), at_angle(120), at_angle(180), at_angle(240), at_angle(300)}, false, {1, 1, 1, 1, 1});
  const std::vector<CellPart> parts = parts_of(around);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(corners_of(around, parts[0]).size(), 5 + 3U);
  EXPECT_NEAR(area_of(around, parts[0]), hexagon_area * 5 / 6, 1e-15);
}

TEST(SiteCell, AtARightAngledCornerIsARectangle) {
  const Surroundings around = fan({{2, 0}, {0, 1}}, false, {1}); // the circumcentre lies on the third side
  const Moments moments = moments_of(corners_of(around, parts_of(around)[0]));
  EXPECT_EQ(moments.area, 0.5);
  EXPECT_EQ(moments.centroid, (Vec2{0.5, 0.25}));
  EXPECT_EQ(face_of(around, 0).dual_length(), 0.5);
  EXPECT_EQ(face_of(around, 1).dual_length(), 1);
}

TEST(SiteCell, OfASquareLatticeHasEdgesOfLengthZeroAtDiagonals) {
  const Surroundings around = fan({{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}}, true, {1, 1, 1, 1, 1, 1});
  EXPECT_EQ(area_of(around, parts_of(around)[0]), 1);
  EXPECT_EQ(face_of(around, 0).dual_length(), 1);
  EXPECT_EQ(face_of(around, 1).dual_length(), 0);
}

TEST(SiteCell, ShowsAnObtuseAngleAtAnEdgeByANegativeHalf) {
  const Surroundings around = fan({{1, 0}, {0.5, 0.2}, {-1, 0}}, false, {1, 1});
  EXPECT_LT(half_dual_length(around, 0, 0), 0);
  EXPECT_NEAR(half_dual_length(around, 0, 0), around.centres[0].y, 1e-15);
}

TEST(Kites, AddUpToTheTriangleAndToTheCell) {
  for (const auto& [b, c] :
       {std::pair{Vec2{3, 0}, Vec2{0, 4}}, {Vec2{2, 0.1}, Vec2{0.7, 1.3}}, {Vec2{4, 0}, Vec2{1, 1}}}) {
    const std::array<double, 3> kites = kites_of(b, c);
    EXPECT_NEAR(kites[0] + kites[1] + kites[2], 0.5 * cross(b, c), 1e-15);
  }
  EXPECT_EQ(kites_of({3, 0}, {0, 4}), (std::array<double, 3>{3, 1.5, 1.5}));    // the circumcentre is (1.5, 2)
  EXPECT_EQ(kites_of({4, 0}, {1, 1}), (std::array<double, 3>{-0.25, 0.25, 2})); // obtuse at the third corner
  double sum = 0;
  for (const double kite : kites_around(hexagon({1, 1, 1, 1, 1, 1}))) {
    EXPECT_NEAR(kite, hexagon_area / 6, 1e-15);
    sum += kite;
  }
  EXPECT_NEAR(sum, hexagon_area, 1e-15);
}

TEST(Difference, IsTheShortestOneAcrossTheBorder) {
  EXPECT_EQ(difference({0.9375, 0.5}, {0.0625, 0.25}, {1, 0}), (Vec2{-0.125, 0.25}));
  EXPECT_EQ(difference({0.9375, 0.5}, {0.0625, 0.25}, {0, 0}), (Vec2{0.875, 0.25}));
}

TEST(Shares, ReturnTheRankWhoseRangeHasANumber) {
  for (const GlobalId total : {1, 2, 5, 7, 100})
    for (const int ranks : {1, 2, 3, 7, 13}) {
      const Shares shares{total, ranks};
      for (GlobalId number = 0; number < total; ++number) {
        const int rank = shares.rank_of(number);
        EXPECT_GE(number, shares.first(rank));
        EXPECT_LT(number, shares.first(rank + 1));
      }
    }
}

} // namespace
} // namespace trime::dual
