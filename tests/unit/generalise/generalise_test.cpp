// SPDX-License-Identifier: BSD-3-Clause
// Boundaries at the resolution of a mesh: what stays, what goes, and what must hold for every shape.
#include "generalise/generalise.hpp"

#include "boundary_properties.hpp"
#include "generalise/curve_map.hpp"
#include "generalise/narrow_parts.hpp"
#include "generalise/rules.hpp"
#include "generalise_shapes.hpp"
#include "trime/core/error.hpp"

#include <gtest/gtest.h>

namespace trime::generalise {
namespace {

using testing::circle_loop;
using testing::unit_lattice;

const geometry::Box unit_box{{0, 0}, {1, 1}};

std::unique_ptr<const Generalised> at_size(const Boundary& boundary, double h, bool closes_narrow = false,
                                           const std::vector<Vec2>& inside = {}) {
  return generalise(boundary, sizing::UniformSize(h), unit_lattice(), {closes_narrow}, inside);
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
    for (const bool closes_narrow : {false, true}) {
      EXPECT_EQ(at_size(boundary_of({box({0.1, 0.1}, {0.9, 0.9})}), h, closes_narrow), nullptr);
      EXPECT_EQ(at_size(boundary_of({circle_loop({0.5, 0.5}, 0.4)}), h, closes_narrow), nullptr);
      EXPECT_EQ(at_size(boundary_of({gear()}), h, closes_narrow), nullptr);
    }
}

TEST(Generalise, KeepsSharpCornersOfTheShape) {
  EXPECT_EQ(at_size(boundary_of({polygon_loop({{0.1, 0.5}, {0.9, 0.45}, {0.9, 0.55}})}), 0.05), nullptr);
  const std::vector<Vec2> notch{{0.1, 0.1}, {0.9, 0.1}, {0.9, 0.48}, {0.3, 0.5}, {0.9, 0.52}, {0.9, 0.9}, {0.1, 0.9}};
  EXPECT_EQ(at_size(boundary_of({polygon_loop(notch)}), 0.05), nullptr);
}

TEST(Generalise, LeavesPeriodicAndEmptyBoundariesAlone) {
  EXPECT_EQ(at_size(Boundary{}, 0.1), nullptr);
  Draws draws(1);
  Boundary periodic = crack(draws);
  periodic.periods.x = 1;
  EXPECT_EQ(at_size(periodic, 0.1), nullptr);
}

Choice cutting() {
  Choice choice;
  choice.keeps_joining = false;
  return choice;
}

/// Two squares joined by a bar of this width, from the right one a thin spit.
Boundary squares_and_bar(double width) {
  const double top = 0.5 + width;
  return boundary_of({polygon_loop({{0.1, 0.3},
                                    {0.4, 0.3},
                                    {0.4, 0.5},
                                    {0.6, 0.5},
                                    {0.6, 0.3},
                                    {0.8, 0.3},
                                    {0.8, 0.45},
                                    {0.9, 0.45},
                                    {0.9, 0.46},
                                    {0.8, 0.46},
                                    {0.8, 0.7},
                                    {0.6, 0.7},
                                    {0.6, top},
                                    {0.4, top},
                                    {0.4, 0.7},
                                    {0.1, 0.7}})});
}

TEST(Generalise, KeepsANeckBetweenLargeBodies) {
  for (const double width : {0.018, 0.01, 0.001, 1e-6}) {
    const double h = 0.05;
    const Boundary given = squares_and_bar(width);
    const auto made = at_size(given, h);
    ASSERT_TRUE(made);
    EXPECT_EQ(made->counts.cut, 1) << "the spit";
    EXPECT_EQ(made->counts.severed, 0);
    EXPECT_GE(made->counts.held, 1);
    expect_proper(made->boundary);
    ASSERT_EQ(made->boundary.loops.size(), 1u);
    const geometry::SegmentGrid curves(segments_of(made->boundary));
    const Vec2 middle{0.5, 0.5 + 0.5 * width};
    EXPECT_TRUE(curves.inside(unit_lattice().snap(middle)));
    EXPECT_NEAR(2 * std::sqrt(curves.nearest(middle).squared_distance),
                std::fmax(width, GeneraliseRules::joining_width * h), 0.02 * h);
  }
}

TEST(Generalise, CutsANeckToABodyBelowTheResolution) {
  // A bar with a bulge at its end: less than h squared.
  const Boundary given = boundary_of({polygon_loop({{0.1, 0.3},
                                                    {0.4, 0.3},
                                                    {0.4, 0.5},
                                                    {0.6, 0.5},
                                                    {0.6, 0.47},
                                                    {0.66, 0.47},
                                                    {0.66, 0.53},
                                                    {0.6, 0.53},
                                                    {0.6, 0.51},
                                                    {0.4, 0.51},
                                                    {0.4, 0.7},
                                                    {0.1, 0.7}})});
  const auto made = at_size(given, 0.07);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->counts.held, 0);
  ASSERT_EQ(made->boundary.loops.size(), 1u) << "the bulge goes, too";
  EXPECT_NEAR(made->boundary.area, 0.3 * 0.4, 1e-4);
  const auto finer = at_size(given, 0.03);
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->boundary.loops.size(), 1u);
  EXPECT_GE(finer->counts.held, 1) << "here it is above the resolution";
  EXPECT_GT(finer->boundary.area, 0.3 * 0.4 + 0.06 * 0.06);
}

TEST(Generalise, KeepsBothChannelsAroundALargeIslandOnly) {
  for (const double side : {0.3, 0.02}) {
    const double low = 0.5 - side / 2, high = 0.5 + side / 2; // a canal of that height, an island nearly as high
    const Boundary given = boundary_of({polygon_loop({{0.05, 0.2},
                                                      {0.3, 0.2},
                                                      {0.3, low},
                                                      {0.7, low},
                                                      {0.7, 0.2},
                                                      {0.95, 0.2},
                                                      {0.95, 0.8},
                                                      {0.7, 0.8},
                                                      {0.7, high},
                                                      {0.3, high},
                                                      {0.3, 0.8},
                                                      {0.05, 0.8}}),
                                        box({0.45, low + 0.004}, {0.45 + side / 2, high - 0.003}, true, 2)});
    const auto made = at_size(given, 0.05);
    ASSERT_TRUE(made);
    expect_proper(made->boundary);
    EXPECT_EQ(made->boundary.components(), 1);
    EXPECT_EQ(made->boundary.holes(), side == 0.3 ? 1 : 0);
    EXPECT_EQ(made->counts.severed, 0);
  }
}

TEST(Generalise, ClosesNoDamBetweenTwoWaters) {
  const Boundary given = boundary_of({box({0.1, 0.1}, {0.499, 0.9}), box({0.501, 0.1}, {0.9, 0.9}, false, 2)});
  const auto made = at_size(given, 0.05, true);
  ASSERT_TRUE(made);
  expect_proper(made->boundary);
  EXPECT_EQ(made->boundary.components(), 2);
  const auto joined =
      generalise(given, sizing::UniformSize(0.05), unit_lattice(), {true, false}, std::span<const Vec2>{});
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->boundary.components(), 1);
  EXPECT_EQ(joined->counts.severed, 1);
  EXPECT_NEAR(joined->counts.widest_severed, 0.002 / 0.05, 1e-6);
}

TEST(Generalise, CutsASpitAndANeck) {
  const Boundary given = squares_and_bar(0.01);
  const auto made = generalise(given, sizing::UniformSize(0.05), unit_lattice(), cutting(), {});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->counts.cut, 2);
  EXPECT_EQ(made->counts.severed, 1);
  EXPECT_NEAR(made->counts.widest_severed, 0.2, 1e-6);
  EXPECT_NEAR(made->counts.severed_place.y, 0.505, 1e-6);
  EXPECT_NEAR(made->counts.cut_area, 0.2 * 0.01 + 0.1 * 0.01, 1e-5);
  expect_proper(made->boundary);
  ASSERT_EQ(made->boundary.loops.size(), 2u);
  EXPECT_EQ(made->boundary.loops[0].tag, 1);
  EXPECT_EQ(made->boundary.loops[1].tag, 2);
  EXPECT_NEAR(made->boundary.area, 0.3 * 0.4 + 0.2 * 0.4, 1e-5);
  EXPECT_EQ(at_size(given, 0.0099), nullptr); // they are as wide as h
}

TEST(Generalise, WidensACrackOrClosesIt) {
  const std::vector<Vec2> ring{{0.1, 0.1},    {0.9, 0.1},    {0.9, 0.5}, {0.5, 0.5},
                               {0.5, 0.5001}, {0.9, 0.5001}, {0.9, 0.9}, {0.1, 0.9}};
  const Boundary given = boundary_of({polygon_loop(ring)});
  const double h = 0.02;
  const auto widened = at_size(given, h, false);
  ASSERT_TRUE(widened);
  EXPECT_GE(widened->counts.widened, 1);
  EXPECT_EQ(widened->counts.closed, 0);
  expect_proper(widened->boundary);
  ASSERT_EQ(widened->boundary.loops.size(), 1u);
  const geometry::SegmentGrid curves(segments_of(widened->boundary));
  EXPECT_NEAR(2 * std::sqrt(curves.nearest({0.7, 0.50005}).squared_distance), GeneraliseRules::narrow_outside * h,
              0.01 * h);
  const auto closed = at_size(given, h, true);
  ASSERT_TRUE(closed);
  EXPECT_GE(closed->counts.closed, 1);
  EXPECT_EQ(closed->counts.widened, 0);
  EXPECT_NEAR(closed->boundary.area, 0.64, 1e-12);
  expect_proper(closed->boundary);
}

TEST(Generalise, FillsSmallHolesAndKeepsOthersBitForBit) {
  std::vector<Loop> loops{box({0.1, 0.1}, {0.9, 0.9}), circle_loop({0.3, 0.5}, 0.01, true, 4, 2),
                          circle_loop({0.7, 0.5}, 0.05, true, 4, 3)};
  const Boundary given = boundary_of(loops);
  const auto made = at_size(given, 0.05);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->counts.filled, 1);
  ASSERT_EQ(made->boundary.loops.size(), 2u);
  EXPECT_TRUE(are_equal(made->boundary.loops[0], given.loops[0]));
  EXPECT_TRUE(are_equal(made->boundary.loops[1], given.loops[2]));
  loops[1].pieces[2].corner = true; // the user wants that vertex
  EXPECT_EQ(at_size(boundary_of(loops), 0.05), nullptr);
}

TEST(Generalise, DoesNotCutWhatHoldsAPointThatMustStayInside) {
  const std::vector<Vec2> ring{{0.1, 0.1},  {0.5, 0.1},  {0.5, 0.3}, {0.9, 0.3},
                               {0.9, 0.31}, {0.5, 0.31}, {0.5, 0.9}, {0.1, 0.9}};
  const Boundary given = boundary_of({polygon_loop(ring)});
  ASSERT_TRUE(at_size(given, 0.05));
  const auto held = at_size(given, 0.05, false, {unit_lattice().snap({0.8, 0.305})});
  if (held) { // its end may go
    EXPECT_TRUE(geometry::SegmentGrid(segments_of(held->boundary)).inside({0.8, 0.305}));
  }
  const Vec2 outside{0.7, 0.7}, twice{0.25, 0.25}, on_curve{0.25, 0.1};
  const auto made = at_size(given, 0.05, false, {outside, twice, twice, unit_lattice().snap(on_curve)});
  ASSERT_TRUE(made);
  EXPECT_TRUE(are_equal(made->boundary, at_size(given, 0.05)->boundary));
}

TEST(Generalise, KeepsABluntTipThatHoldsAPoint) {
  const double blunt = 4e-6;
  const std::vector<Vec2> ring{{0.1, 0.1},         {0.6, 0.1}, {0.6, 0.4}, {0.9, 0.5 - blunt}, {0.9 + 0.4 * blunt, 0.5},
                               {0.9, 0.5 + blunt}, {0.6, 0.6}, {0.6, 0.9}, {0.1, 0.9}};
  const Vec2 p =
      unit_lattice().snap({0.9 + 0.1 * blunt, 0.5}); // beyond the box of the shape without the outermost vertex
  const Boundary given = boundary_of({polygon_loop(ring)});
  ASSERT_TRUE(at_size(given, 0.006));
  EXPECT_LT(at_size(given, 0.006)->boundary.bounding_box().max.x, p.x);
  if (const auto made = at_size(given, 0.006, false, {p})) {
    EXPECT_TRUE(geometry::SegmentGrid(segments_of(made->boundary)).inside(p));
  }
}

TEST(Generalise, MovesNothingOutOfItsBounds) {
  // A bar along the side on which the world ends is narrow all over, and is widened.
  const Boundary given = boundary_of({box({0, 0}, {1, 0.005})});
  Choice choice;
  const auto anywhere = generalise(given, sizing::UniformSize(0.03), unit_lattice(), choice, {});
  ASSERT_TRUE(anywhere);
  EXPECT_LT(anywhere->boundary.bounding_box().min.y, 0) << "the test shows nothing";
  choice.bounds = unit_box;
  const auto made = generalise(given, sizing::UniformSize(0.03), unit_lattice(), choice, {});
  ASSERT_TRUE(made);
  expect_proper(made->boundary);
  for (const Loop& loop : made->boundary.loops)
    for (const geometry::Piece& piece : loop.pieces)
      EXPECT_TRUE(unit_box.contains(piece.start)) << piece.start.x << " " << piece.start.y;
}

TEST(Thinned, KeepsPointsInside) {
  std::vector<Vec2> ring{{0.9, 0.1}, {0.9, 0.9}, {0.1, 0.9}};
  for (int k = 0; k < 100; ++k)
    ring.push_back({0.3 + 0.001 * k, k % 2 == 0 ? 0.1 : 0.099});
  const Boundary given = boundary_of({polygon_loop(ring)});
  const sizing::UniformSize size(0.1);
  const auto made = thinned(given, size, unit_lattice(), {});
  ASSERT_TRUE(made);
  expect_proper(*made);
  std::vector<Vec2> points; // in the teeth
  for (int k = 1; k < 99; k += 2)
    points.push_back(unit_lattice().snap({0.3 + 0.001 * k, 0.09901}));
  EXPECT_FALSE(CurveMap(*made, size, unit_lattice(), points).is_valid()); // it has left some out
  const auto around = thinned(given, size, unit_lattice(), points);
  ASSERT_TRUE(around);
  EXPECT_TRUE(CurveMap(*around, size, unit_lattice(), points).is_valid());
  const std::vector<Vec2> elsewhere{{0.25, 0.25}, {0.5, 0.5}, {0.015625, 0.5}}; // the last is not inside
  const auto other = thinned(given, size, unit_lattice(), elsewhere);
  ASSERT_TRUE(other);
  EXPECT_TRUE(are_equal(*other, *made));
}

TEST(Generalise, GoesByTheLocalSize) {
  class Graded final : public sizing::SizeField {
  public:
    double size(Vec2 p) const override { return p.x < 0.5 ? 0.005 : 0.1; }
  };
  // A bar with a spit on either side.
  const std::vector<Vec2> ring{{0.3, 0.1}, {0.7, 0.1}, {0.7, 0.5},  {0.9, 0.5},  {0.9, 0.51}, {0.7, 0.51},
                               {0.7, 0.9}, {0.3, 0.9}, {0.3, 0.51}, {0.1, 0.51}, {0.1, 0.5},  {0.3, 0.5}};
  const auto made = generalise(boundary_of({polygon_loop(ring)}), Graded(), unit_lattice(), {}, {});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->boundary.bounding_box().min.x, unit_lattice().snap(0.1));
  EXPECT_EQ(made->boundary.bounding_box().max.x, unit_lattice().snap(0.7));
}

/// A shape of a class, how it is generalised, and what becomes of it.
struct Case {
  Boundary given;
  double h = 0;
  Choice choice;
  std::vector<Vec2> inside;
  std::unique_ptr<const Generalised> made;
};

/// Every other seed keeps what joins and separates.
Case make_case(const ShapeClass& shape, std::uint64_t seed, bool may_keep_joining = true) {
  Draws draws(seed);
  Case it{shape.make(draws), draws.log_between(5e-3, 0.2), {}, {}, nullptr};
  it.choice.closes_narrow = draws.unit() < 0.3;
  it.choice.cuts_thin_components = draws.unit() < 0.3;
  it.choice.keeps_joining = may_keep_joining && seed % 2 == 0;
  for (Loop& loop : it.given.loops)
    for (geometry::Piece& piece : loop.pieces)
      piece.corner = draws.unit() < 0.01;
  if (draws.unit() < 0.5) {
    const geometry::SegmentGrid curves(segments_of(it.given));
    for (int k = 0; k < 20; ++k) // most of them near the curves
      if (const auto& s =
              curves.segments()[static_cast<std::size_t>(draws.unit() * static_cast<double>(curves.segments().size()))];
          s.a != s.b) {
        const Vec2 along = s.b - s.a,
                   away = (draws.log_between(1e-3, 0.5) * it.h / length(along)) * geometry::left_normal(along);
        const Vec2 p = unit_lattice().snap(s.a + draws.unit() * along + away);
        if (unit_box.contains(p) && curves.inside(p))
          it.inside.push_back(p);
      }
  }
  it.made = generalise(it.given, sizing::UniformSize(it.h), unit_lattice(), it.choice, it.inside);
  return it;
}

/// Whatever the shape: proper, near the given curves, corners and points kept, wide parts on their side.
void expect_generalised(const Case& it, std::uint64_t seed) {
  const Boundary& made = it.made->boundary;
  expect_proper(made);
  EXPECT_LT(largest_deviation(made, it.given, 0.05 * it.h), 0.5 * it.h);
  const auto given_corners = corners_of(it.given), corners = corners_of(made);
  EXPECT_TRUE(std::includes(corners.begin(), corners.end(), given_corners.begin(), given_corners.end()));
  const geometry::SegmentGrid before(segments_of(it.given)), after(segments_of(made));
  for (const Vec2 p : it.inside)
    EXPECT_TRUE(after.inside(p)) << p.x << " " << p.y;
  Draws draws(seed + 1000);
  for (int k = 0; k < 300; ++k) {
    const Vec2 p = unit_lattice().snap(Vec2{draws.unit(), draws.unit()});
    if (before.nearest(p).squared_distance > 0.36 * it.h * it.h) {
      EXPECT_EQ(before.inside(p), after.inside(p)) << p.x << " " << p.y;
    }
  }
}

TEST(Generalise, HoldsItsPromisesOnEveryClassOfShapes) {
  std::size_t all_changed = 0;
  for (const ShapeClass& shape : shape_classes()) {
    int changed = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      SCOPED_TRACE(std::string(shape.name) + " " + std::to_string(seed));
      const Case it = make_case(shape, seed);
      ASSERT_EQ(first_meeting(segments_of(it.given)), ""); // the shape itself is in order
      if (it.made) {
        ++changed;
        expect_generalised(it, seed);
      }
    }
    all_changed += changed > 0;
  }
  EXPECT_GE(all_changed, shape_classes().size() - 1); // near vertices alone may be left to the layout
}

/// Parts inside that are clearly narrow, more than roughness, and no corner; none of them holds what is to be kept.
std::size_t narrow_parts(const Case& it, const Boundary& boundary) {
  const sizing::UniformSize size(it.h);
  CurveMap map(boundary, size, unit_lattice(), it.inside);
  EXPECT_TRUE(map.is_valid());
  add_nodes_to_narrow_parts(map);
  const Triangulation& mesh = map.mesh();
  std::size_t count = 0;
  for (const NarrowPart& part : find_narrow_parts(map, map.inside(), true, GeneraliseRules::narrow_inside)) {
    double shallow = GeneraliseRules::least_depth * it.h;
    if (part.lids.size() == 1)
      shallow =
          std::fmax(shallow, length(mesh.point(mesh.target(part.lids[0])) - mesh.point(mesh.origin(part.lids[0]))));
    count += !part.holds_kept && !part.is_corner && !(part.lids.size() == 1 && part.depth <= shallow) &&
             part.width <= GeneraliseRules::clearly_narrow;
  }
  return count;
}

TEST(Generalise, LeavesHardlyAnythingNarrowInside) {
  std::size_t before = 0, after = 0;
  for (const ShapeClass& shape : shape_classes())
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(std::string(shape.name) + " " + std::to_string(seed));
      const Case it = make_case(shape, seed, false);
      if (!it.made)
        continue;
      before += narrow_parts(it, it.given);
      const std::size_t left = narrow_parts(it, it.made->boundary);
      EXPECT_LE(left, 2u); // between others that cannot be moved apart
      after += left;
    }
  EXPECT_LT(after, before / 100) << before << " before";
}

TEST(Generalise, ComesToAnEnd) {
  for (const ShapeClass& shape : shape_classes())
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      SCOPED_TRACE(std::string(shape.name) + " " + std::to_string(seed));
      const Case it = make_case(shape, seed);
      if (!it.made)
        continue;
      const Boundary& once = it.made->boundary;
      const auto twice = generalise(once, sizing::UniformSize(it.h), unit_lattice(), it.choice, it.inside);
      if (!twice)
        continue;
      EXPECT_LT(std::fabs(twice->boundary.area - once.area),
                0.1 * std::fabs(once.area - it.given.area) + 0.01 * it.h * once.length());
      EXPECT_LT(largest_deviation(twice->boundary, once, 0.05 * it.h), 0.3 * it.h); // it is smoothed a little more
    }
}

TEST(Generalise, GivesTheSameBitsAgain) {
  for (const ShapeClass& shape : shape_classes()) {
    const Case first = make_case(shape, 5), second = make_case(shape, 5);
    ASSERT_EQ(first.made == nullptr, second.made == nullptr);
    if (first.made) {
      EXPECT_TRUE(are_equal(first.made->boundary, second.made->boundary)) << shape.name;
    }
  }
}

TEST(Generalise, FailsForASizeThatIsNone) {
  EXPECT_THROW(at_size(boundary_of({box({0.1, 0.1}, {0.9, 0.9})}), 0), GeometryError);
  EXPECT_THROW(at_size(boundary_of({box({0.1, 0.1}, {0.9, 0.9})}), INFINITY), GeometryError);
}

} // namespace
} // namespace trime::generalise
