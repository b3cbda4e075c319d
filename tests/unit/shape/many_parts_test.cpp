// SPDX-License-Identifier: BSD-3-Clause
// Regions of very many parts, and long slanted edges: the work, and that nothing is missed.
#include "core/random.hpp"
#include "geometry/predicates.hpp"
#include "shape/arrangement.hpp"
#include "shape/region_state.hpp"
#include "unit/shape/boundary_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <span>

namespace trime::shape {
namespace {

using geometry::Box;
using geometry::Frame;
using geometry::Segment;
using geometry::Vec2;

const Frame unit_frame(Box{{0, 0}, {1, 1}});
constexpr int side = 24; // islands in a row

std::vector<Part> islands() {
  std::vector<Part> parts;
  for (int k = 0; k < side * side; ++k) {
    const Vec2 p{(k % side + 0.5) / side, (k / side + 0.5) / side}; // NOLINT(bugprone-integer-division)
    const double r = 0.3 / side;
    const std::string name = fmt::format("p{}", k);
    parts.push_back(k % 2 == 0 ? Part::circle(name, p, r, unit_frame)
                               : Part::rectangle(name, {p - Vec2{r, r}, p + Vec2{r, r}}, unit_frame));
  }
  return parts;
}

std::vector<PlacedPart> placed(const std::vector<Part>& parts) {
  std::vector<PlacedPart> places;
  for (std::size_t k = 0; k < parts.size(); ++k)
    places.push_back({&parts[k], static_cast<int>(k), {}});
  return places;
}

TEST(ManyParts, ThoseApartAreNotCrossed) {
  const std::vector<Part> parts = islands();
  EXPECT_EQ(Arrangement(placed(parts), unit_frame).pairs(), 0);
  std::string names;
  for (const Part& part : parts)
    names += ", " + part.name();
  const RegionShape shape(parts, "difference(domain" + names + ")", unit_frame);
  EXPECT_EQ(shape.boundary().loops.size(), 1u + side * side);
  EXPECT_EQ(shape.boundary().holes(), side * side);
}

/// n teeth, as long as the whole, turned by 45 degrees.
std::vector<Vec2> comb(int n, Vec2 middle) {
  std::vector<Vec2> points;
  const double length = 0.4, width = 0.5 * length / n, turn = std::sqrt(0.5);
  const auto add = [&](double u, double v) {
    u -= length / 2;
    v -= length / 2;
    points.push_back(middle + Vec2{turn * (u - v), turn * (u + v)});
  };
  add(0, -0.05);
  for (int k = 0; k < n; ++k) {
    add(2 * k * width, 0);
    add((2 * k + 0.5) * width, length);
    add((2 * k + 1) * width, 0);
  }
  add(2 * n * width, -0.05);
  return points;
}

Part comb_part(const std::string& name, int n, Vec2 middle) {
  contours::Contour contour;
  contour.source = name;
  contour.rings.push_back({comb(n, middle), std::vector<int>(3 * static_cast<std::size_t>(n) + 2, 1)});
  return Part::contour(name, contour, {}, unit_frame);
}

TEST(ManyParts, CombsThatCrossEverywhere) {
  constexpr int teeth = 100;
  const double moved = 0.25 * 0.5 * 0.4 / teeth * std::sqrt(0.5); // half a tooth: the combs cross everywhere near
  const std::vector<Part> parts{comb_part("a", teeth, {0.5, 0.5}), comb_part("b", teeth, {0.5 + moved, 0.5 + moved})};
  const Arrangement made(placed(parts), unit_frame);
  EXPECT_EQ(made.pairs(), 1);
  std::set<std::pair<LocalIndex, LocalIndex>> pieces;
  for (const Arrangement::Piece& piece : made.pieces())
    pieces.insert({piece.from, piece.to});
  EXPECT_GT(pieces.size(), 2u * 3 * teeth); // they were cut
  expect_valid(RegionShape(parts, "union(a, b)", unit_frame).boundary());
}

/// The second one drawn back along the teeth and half a tooth aside: each tooth crosses another one and a base.
std::vector<Part> combs_moved(int teeth) {
  const double aside = 0.5 * 0.5 * 0.4 / teeth * std::sqrt(0.5);
  return {comb_part("a", teeth, {0.5, 0.5}), comb_part("b", teeth, {0.62 + aside, 0.38 + aside})};
}

TEST(ManyParts, LongSpikesOfTwoPartsLookAtFewOthers) {
  for (const int teeth : {1500, 6000}) {
    const std::vector<Part> parts = combs_moved(teeth);
    const Arrangement made(placed(parts), unit_frame);
    EXPECT_EQ(made.pairs(), 1);
    EXPECT_LT(made.line_pairs(), 60 * 2 * 3 * teeth) << teeth;
    EXPECT_GT(made.pieces().size(), (2u * 3 + 2) * static_cast<std::size_t>(teeth)); // they were cut
  }
}

/// All pairs one by one, against the tree: no crossing is missed, none is made up.
TEST(ManyParts, LongSpikesOfTwoPartsAreCutWhereTheyCross) {
  constexpr int teeth = 400;
  const std::vector<Part> parts = combs_moved(teeth);
  const std::span<const Segment> a = parts[0].as_polygon()->grid.segments(), b = parts[1].as_polygon()->grid.segments();
  std::size_t crossings = 0;
  for (const Segment& s : a)
    for (const Segment& t : b)
      crossings += geometry::orient2d(s.a, s.b, t.a) * geometry::orient2d(s.a, s.b, t.b) < 0 &&
                           geometry::orient2d(t.a, t.b, s.a) * geometry::orient2d(t.a, t.b, s.b) < 0
                       ? 1
                       : 0;
  EXPECT_GT(crossings, std::size_t{teeth});
  EXPECT_EQ(Arrangement(placed(parts), unit_frame).pieces().size(), a.size() + b.size() + 2 * crossings);
}

/// A comb first, and circles among its teeth, each so large that it crosses some of them.
std::vector<Part> comb_with_circles(int teeth) {
  std::vector<Part> parts{comb_part("a", teeth, {0.5, 0.5})};
  const double turn = std::sqrt(0.5), length = 0.4, radius = 0.4 * length / teeth;
  for (int k = 0; k < teeth; ++k) {
    const double u = (k + 0.3) * length / teeth - length / 2, v = 0.3 * length * (k % 3) / 3;
    parts.push_back(
        Part::circle(fmt::format("c{}", k), Vec2{0.5, 0.5} + Vec2{turn * (u - v), turn * (u + v)}, radius, unit_frame));
  }
  return parts;
}

TEST(ManyParts, CirclesLookAtFewLongSpikes) {
  for (const int teeth : {1500, 6000}) {
    const std::vector<Part> parts = comb_with_circles(teeth);
    const Arrangement made(placed(parts), unit_frame);
    EXPECT_LT(made.line_pairs(), 60 * (3 + 1) * teeth) << teeth;
  }
}

/// All pairs one by one, against the tree: the circles are cut wherever a line enters or leaves them.
TEST(ManyParts, CirclesAreCutByLongSpikes) {
  constexpr int teeth = 1500;
  const std::vector<Part> parts = comb_with_circles(teeth);
  const std::span<const Segment> lines = parts[0].as_polygon()->grid.segments();
  std::size_t crossings = 0;
  for (const Part& part : parts)
    if (const Circle* circle = part.as_circle())
      for (const Segment& s : lines) {
        const Vec2 d = s.b - s.a, from = s.a - circle->center;
        const double along = geometry::dot(from, d), whole = geometry::squared_length(d);
        const double root = along * along - whole * (geometry::squared_length(from) - circle->radius * circle->radius);
        for (const double sign : {-1.0, 1.0})
          if (const double t = (-along + sign * std::sqrt(std::fmax(root, 0))) / whole; root > 0 && t > 0 && t < 1)
            ++crossings;
      }
  EXPECT_GT(crossings, 2 * std::size_t{teeth});
  const std::size_t quadrants = 4 * static_cast<std::size_t>(teeth); // of each circle, which are vertices
  EXPECT_EQ(Arrangement(placed(parts), unit_frame).pieces().size(), lines.size() + quadrants + 2 * crossings);
}

TEST(InsideWalk, SaysWhatThePartSays) {
  constexpr int teeth = 3000;
  const Part part = comb_part("a", teeth, {0.5, 0.5});
  const std::span<const Segment> segments = part.as_polygon()->grid.segments();
  InsideWalk walk(part);
  const auto expect_same = [&](Vec2 p) { EXPECT_EQ(walk.inside(p), part.inside(p)) << p.x << " " << p.y; };
  int inside = 0;
  const int rounds = 4;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < segments.size(); ++k) { // on vertices, along spikes, across them, and far jumps
      const Segment& s = segments[k];
      const Vec2 middle = unit_frame.snap(s.a + 0.3 * (s.b - s.a));
      expect_same(middle);
      expect_same({middle.x + unit_frame.step() * static_cast<double>(k % 5), middle.y});
      if (k % 4 == 0)
        expect_same(s.b);
      if (k % 100 == 0)
        expect_same(
            unit_frame.snap({random_unit(5, RandomPurpose::test, k, 0), random_unit(5, RandomPurpose::test, k, 1)}));
      inside += part.inside(middle) ? 1 : 0;
    }
  EXPECT_GT(inside, teeth / 2);
  EXPECT_LT(inside, rounds * 3 * teeth - teeth / 2);
  EXPECT_LT(walk.looked_at(), std::int64_t{60} * rounds * 3 * teeth);
}

std::string random_region(std::uint64_t key, int depth, int parts) {
  const auto pick = [&](std::uint64_t slot, int count) {
    return static_cast<int>(count * random_unit(3, RandomPurpose::test, key, slot));
  };
  if (depth == 0 || pick(0, 4) == 0)
    return fmt::format("p{}", pick(1, parts));
  constexpr const char* words[] = {"union", "intersection", "difference"};
  std::string text = std::string(words[pick(2, 3)]) + "(";
  const int operands = 2 + pick(3, 3);
  for (int k = 0; k < operands; ++k) {
    text += k > 0 ? "," : "";
    text += random_region(5 * key + static_cast<std::uint64_t>(k) + 1, depth - 1, parts);
  }
  text += ")";
  return text;
}

TEST(RegionState, IsTheRegionWhateverComesAndGoes) {
  constexpr int parts = 6;
  std::vector<std::string> names;
  for (int k = 0; k < parts; ++k)
    names.push_back(fmt::format("p{}", k));
  for (std::uint64_t key = 1; key < 60; ++key) {
    const Region region = Region::parse(random_region(key, 4, parts), names);
    RegionState state(region, parts + 1);
    std::vector<int> places(parts, 0);
    for (std::uint64_t step = 0; step < 60; ++step) {
      const auto part = static_cast<std::size_t>(parts * random_unit(4, RandomPurpose::test, key, 2 * step));
      const bool leaves = places[part] > 0 && random_unit(4, RandomPurpose::test, key, 2 * step + 1) < 0.6;
      places[part] += leaves ? -1 : 1;
      if (leaves)
        state.leave(static_cast<int>(part));
      else
        state.enter(static_cast<int>(part));
      EXPECT_EQ(state.contains(), region.contains([&](int k) { return places[static_cast<std::size_t>(k)] > 0; }))
          << region.text();
    }
  }
}

TEST(RegionState, AChangeDoesNotLookAtTheOtherParts) {
  constexpr int parts = 10000;
  std::vector<std::string> names;
  std::string text = "difference(domain";
  for (int k = 0; k < parts; ++k) {
    names.push_back(fmt::format("p{}", k));
    text += "," + names.back();
  }
  text += ")";
  const Region region = Region::parse(text, names);
  RegionState state(region, parts + 1);
  for (int k = 0; k < parts; ++k) {
    state.enter(k);
    EXPECT_FALSE(state.contains());
    state.enter(parts); // the domain
    EXPECT_FALSE(state.contains());
    state.leave(k);
    EXPECT_TRUE(state.contains());
    state.leave(parts);
  }
  EXPECT_LE(state.looked_at(), 8 * parts);
}

} // namespace
} // namespace trime::shape
