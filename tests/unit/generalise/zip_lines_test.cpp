// SPDX-License-Identifier: BSD-3-Clause
// Tests that lines become one where they come near each other between their vertices, and stay two elsewhere.
#include "generalise/zip_lines.hpp"

#include "arc_paths.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

namespace trime::generalise {
namespace {

using geometry::InnerArc;
using geometry::Vec2;

constexpr double h = 0.05;

class ZipLines : public ::testing::Test {
protected:
  Vec2 at(double x, double y) const { return lattice_.snap({x, y}); }
  /// The unit square, with an interface at half of its height and region 0 above.
  std::optional<Partition> zipped(const std::vector<Vec2>& curve, int region) const {
    Partition given;
    given.curves.names = {"fault"};
    given.curves.arcs = {arc_of(curve, 0, region, region), arc_of({at(0, 0.5), at(1, 0.5)}, -1, 0, 1)};
    std::vector<geometry::Piece>& rim = given.boundary.loops.emplace_back().pieces;
    rim = pieces_of({at(0, 0.5), {0, 0}, {1, 0}, at(1, 0.5)}, 0, 1);
    for (const geometry::Piece& piece : pieces_of({at(1, 0.5), {1, 1}, {0, 1}, at(0, 0.5)}, 0, 0))
      rim.push_back(piece);
    const std::array<std::array<int, 2>, 1> pairs{{{0, 1}}};
    return zip_lines(given, {sizing::UniformSize(h), lattice_, {}}, pairs);
  }
  static double length_on_interface(const Partition& partition) {
    double sum = 0;
    for (const InnerArc& one : partition.curves.arcs)
      for (const geometry::Piece& piece : one.pieces)
        sum += piece.part == 0 && one.left != one.right ? piece.length() : 0;
    return sum;
  }

private:
  const geometry::Lattice lattice_ = geometry::Frame(geometry::Box{{0, 0}, {1, 1}}).lattice();
};

TEST_F(ZipLines, ALongEdgeJoinsTheInterfaceThatItFollows) {
  const std::vector<Vec2> fault{at(0.2, 0.5 + 0.1 * h), at(0.8, 0.5 + 0.1 * h)};
  const std::optional<Partition> result = zipped(fault, 0);
  ASSERT_TRUE(result);
  EXPECT_NEAR(length_on_interface(*result), 0.6, 0.1); // not yet thinned
  EXPECT_GT(result->joined.vertices, 2);
  EXPECT_LT(result->joined.farthest, 0.2 * h);
  double lost = 0;
  for (const geometry::RegionLoss& loss : result->curves.losses)
    lost += loss.loser == 0 ? loss.area : -loss.area;
  EXPECT_GT(lost, 0.6 * 0.05 * h); // the interface has gone up to the fault
  EXPECT_LT(lost, 0.6 * 0.11 * h);
}

TEST_F(ZipLines, LinesThatDivergeSlowlyAreOneWhileTheyAreNear) {
  const std::optional<Partition> result = zipped({at(0.1, 0.5 + 0.05 * h), at(0.9, 0.5 + 2 * h)}, 0);
  ASSERT_TRUE(result);
  EXPECT_GT(result->joined.vertices, 0);
  EXPECT_LT(length_on_interface(*result), 0.3);
}

TEST_F(ZipLines, LinesFartherApartStay) {
  EXPECT_FALSE(zipped({at(0.2, 0.5 + 0.3 * h), at(0.8, 0.5 + 0.3 * h)}, 0));
  EXPECT_FALSE(zipped({at(0.5, 0.5 - 0.3 * h), at(0.5, 0.2)}, 1));
}

} // namespace
} // namespace trime::generalise
