// SPDX-License-Identifier: BSD-3-Clause
// Faces between regions that are smaller or narrower than the triangles.
#include "shape/small_faces.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace trime::shape {
namespace {

using geometry::Vec2;

/// Collects straight pieces between vertices, which are numbered by their places.
class Faces {
public:
  void add(Vec2 from, Vec2 to, int left, int right) {
    LabelledPiece piece{number(from), number(to), {}, left, right};
    piece.piece.start = from;
    piece.piece.end = to;
    piece.number = static_cast<LocalIndex>(pieces.size());
    pieces.push_back(piece);
  }
  /// A counter-clockwise ring.
  void add_ring(const std::vector<Vec2>& ring, int inside, int outside) {
    for (std::size_t k = 0; k < ring.size(); ++k)
      add(ring[k], ring[(k + 1) % ring.size()], inside, outside);
  }
  std::set<int> labels() const {
    std::set<int> found;
    for (const LabelledPiece& piece : pieces)
      found.insert({piece.left, piece.right});
    return found;
  }
  std::vector<LabelledPiece> pieces;

private:
  LocalIndex number(Vec2 p) {
    for (std::size_t k = 0; k < places_.size(); ++k)
      if (places_[k] == p)
        return static_cast<LocalIndex>(k);
    places_.push_back(p);
    return static_cast<LocalIndex>(places_.size() - 1);
  }
  std::vector<Vec2> places_;
};

/// The unit square with region 0 below, region 2 above, and region 1 between the heights `low` and `high`.
Faces layers(double low, double high) {
  Faces faces;
  faces.add({0, 0}, {1, 0}, 0, -1);
  faces.add({1, 0}, {1, low}, 0, -1);
  faces.add({1, low}, {1, high}, 1, -1);
  faces.add({1, high}, {1, 1}, 2, -1);
  faces.add({1, 1}, {0, 1}, 2, -1);
  faces.add({0, 1}, {0, high}, 2, -1);
  faces.add({0, high}, {0, low}, 1, -1);
  faces.add({0, low}, {0, 0}, 0, -1);
  faces.add({0, low}, {1, low}, 1, 0);
  faces.add({0, high}, {1, high}, 2, 1);
  return faces;
}

TEST(SmallFaces, ASliverGoesToOneNeighbour) {
  Faces faces = layers(0.5, 0.502);
  const geometry::AbsorbedFaces absorbed = absorb_small_faces(faces.pieces, {0, 0.01, 0.01});
  EXPECT_EQ(absorbed.count, 1);
  EXPECT_NEAR(absorbed.area, 0.002, 1e-15);
  EXPECT_EQ(faces.labels(), (std::set<int>{-1, 0, 2}));
  EXPECT_EQ(faces.pieces.size(), 9U); // one of its two borders is gone
}

TEST(SmallFaces, AGapIsAbsorbedWithTheCurveInIt) {
  for (const bool has_gap : {true, false}) {
    Faces faces;
    faces.add_ring({{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}}, 1, -1);
    faces.add_ring({{0, 0.53}, {1, 0.53}, {1, 1}, {0, 1}}, 2, -1);
    faces.pieces[2].right = faces.pieces[4].right = 0; // the rest lies between both
    faces.add({1, 0.5}, {1, 0.53}, 0, -1);
    faces.add({0, 0.53}, {0, 0.5}, 0, -1);
    faces.add({0, 0.5}, {1, 0.53}, 0, 0); // a curve across
    faces.pieces.back().on_curve = true;
    faces.pieces[2].on_curve = true; // and one along the border below
    EXPECT_EQ(absorb_small_faces(faces.pieces, {0, 0.01, has_gap ? 0.035 : 0.01}).count, has_gap ? 1 : 0);
    EXPECT_EQ(faces.labels(), has_gap ? (std::set<int>{-1, 1, 2}) : (std::set<int>{-1, 0, 1, 2}));
  }
}

TEST(SmallFaces, AWideLayerStays) {
  Faces faces = layers(0.5, 0.52);
  EXPECT_EQ(absorb_small_faces(faces.pieces, {0.3, 0.01, 0.01}).count, 0);
  EXPECT_EQ(faces.pieces.size(), 10U);
}

TEST(SmallFaces, CrumbsInCrumbs) {
  Faces faces;
  faces.add_ring({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0, -1);
  faces.add_ring({{0.5, 0.5}, {0.55, 0.5}, {0.55, 0.55}, {0.5, 0.55}}, 1, 0);
  faces.add_ring({{0.51, 0.51}, {0.54, 0.51}, {0.54, 0.54}, {0.51, 0.54}}, 2, 1);
  EXPECT_EQ(absorb_small_faces(faces.pieces, {0.3, 0, 0}).count, 2);
  EXPECT_EQ(faces.labels(), (std::set<int>{-1, 0}));
}

TEST(SmallFaces, AnIslandOfOneRegionStays) {
  Faces faces;
  faces.add_ring({{0, 0}, {0.01, 0}, {0.01, 0.01}, {0, 0.01}}, 1, -1);
  EXPECT_EQ(absorb_small_faces(faces.pieces, {1, 1, 1}).count, 0);
  EXPECT_EQ(faces.pieces.size(), 4U);
}

} // namespace
} // namespace trime::shape
