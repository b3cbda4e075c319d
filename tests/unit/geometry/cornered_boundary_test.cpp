// SPDX-License-Identifier: BSD-3-Clause
// Points that become corners: the same boundary, bit for bit, as by looking at every piece for every point, and the
// work of many points on many pieces.
#include "geometry/cornered_boundary.hpp"

#include "core/angle.hpp"
#include "core/random.hpp"
#include "trime/shape/region_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trime::geometry {
namespace {

using shape::Part;
using shape::RegionShape;

constexpr double tolerance = 1e-10;

double uniform(std::uint64_t key, std::uint64_t slot) {
  return random_unit(13, RandomPurpose::test, key, slot);
}

/// The two parts of a piece, by the definition of an arc.
void divide(std::vector<Piece>& pieces, std::size_t index, Vec2 p) {
  Piece first = pieces[index], second = first;
  first.end = second.start = p;
  if (first.circular) {
    const Vec2 from = first.start - first.center, to = p - first.center;
    double sweep = angle_of(cross(from, to), dot(from, to));
    if (second.sweep > 0 && sweep < 0)
      sweep += 2 * pi;
    if (second.sweep < 0 && sweep > 0)
      sweep -= 2 * pi;
    first.sweep = sweep;
    second.sweep -= sweep;
    second.start_angle = angle_of(to.y, to.x);
  }
  second.corner = true;
  pieces[index] = second;
  pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(index), first);
}

/// By looking at everything.
void add_slowly(Boundary& boundary, Vec2 p) {
  double least = HUGE_VAL;
  Loop* loop = nullptr;
  std::size_t index = 0;
  Vec2 q;
  for (Loop& candidate : boundary.loops)
    for (std::size_t k = 0; k < candidate.pieces.size(); ++k)
      for (const Vec2 shift : images_of(boundary.periods))
        if (const double distance = candidate.pieces[k].distance(p + shift); distance < least) {
          least = distance;
          loop = &candidate;
          index = k;
          q = p + shift;
        }
  std::vector<Piece>& pieces = loop->pieces;
  const bool at_start = length(q - pieces[index].start) <= tolerance;
  if (!at_start && length(q - pieces[index].end) > tolerance)
    return divide(pieces, index, q);
  const std::size_t n = pieces.size(), after = at_start ? index : (index + 1) % n, before = (after + n - 1) % n;
  const Vec2 moved = q - (at_start ? pieces[index].start : pieces[index].end);
  pieces[after].start = pieces[after].start + moved;
  pieces[before].end = pieces[before].end + moved;
  pieces[after].corner = true;
}

void expect_equal(const Boundary& found, const Boundary& expected) {
  ASSERT_EQ(found.loops.size(), expected.loops.size());
  for (std::size_t l = 0; l < found.loops.size(); ++l) {
    ASSERT_EQ(found.loops[l].pieces.size(), expected.loops[l].pieces.size());
    for (std::size_t k = 0; k < found.loops[l].pieces.size(); ++k) {
      const Piece &a = found.loops[l].pieces[k], &b = expected.loops[l].pieces[k];
      EXPECT_EQ(a.start, b.start);
      EXPECT_EQ(a.end, b.end);
      EXPECT_EQ(a.corner, b.corner);
      EXPECT_EQ(a.start_angle, b.start_angle);
      EXPECT_EQ(a.sweep, b.sweep);
    }
  }
}

/// Places on the boundary, many at or near its vertices, and on the first pieces more than on others.
std::vector<Vec2> places_on(const Boundary& boundary, const Lattice& lattice, int count) {
  std::vector<const Piece*> pieces;
  for (const Loop& loop : boundary.loops)
    for (const Piece& piece : loop.pieces)
      pieces.push_back(&piece);
  std::vector<Vec2> places;
  for (int k = 0; k < count; ++k) {
    const auto key = static_cast<std::uint64_t>(k);
    const auto which = static_cast<std::size_t>(static_cast<double>(pieces.size()) * uniform(key, 0));
    const Piece& piece = *pieces[k % 2 == 0 ? 0 : which];
    const double part = k % 7 == 0 ? 0 : uniform(key, 1), off = 0.7 * tolerance * uniform(key, 2);
    const Vec2 p = boundary.periods.wrap(lattice.snap(piece.point(part * piece.length()) + Vec2{off, -off}));
    const bool is_apart = std::all_of(places.begin(), places.end(), [&](Vec2 q) {
      return boundary.periods.any() ? length(boundary.periods.nearest_image(q, p) - p) > 3 * tolerance
                                    : length(q - p) > 3 * tolerance;
    });
    if (is_apart)
      places.push_back(p);
  }
  return places;
}

std::vector<Vec2> circle_of_vertices(int count) {
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k)
    points.push_back({0.5 + 0.3 * std::cos(2 * pi * k / count), 0.5 + 0.3 * std::sin(2 * pi * k / count)});
  return points;
}

Part polygon(const std::vector<Vec2>& points, const Frame& frame) {
  contours::Contour contour;
  contour.source = "a.xy";
  contour.rings.push_back({points, std::vector<int>(points.size(), 1)});
  return Part::contour("p", contour, {}, frame);
}

TEST(CorneredBoundary, IsThatOfALookAtEveryPiece) {
  const Frame plane(Box{{0, 0}, {1, 1}}), torus(Box{{0, 0}, {1, 1}}, true, true);
  const RegionShape shapes[] = {
      RegionShape(
          {Part::rectangle("r", {{0.25, 0.25}, {0.75, 0.75}}, plane), Part::circle("c", {0.5, 0.5}, 0.125, plane)},
          "difference(r, c)", plane),
      RegionShape({polygon(circle_of_vertices(37), plane)}, "p", plane),
      RegionShape({Part::circle("c", {0.95, 0.02}, 0.2, torus)}, "difference(domain, c)", torus),
      RegionShape({Part::rectangle("r", {{-0.5, 0.3}, {1.5, 0.6}}, torus)}, "r", torus)};
  for (const RegionShape& shape : shapes) {
    const Boundary& boundary = shape.boundary();
    const PieceTree tree(boundary);
    CorneredBoundary cornered(boundary, tree, tolerance);
    Boundary expected = boundary;
    for (const Vec2 p : places_on(boundary, shape.frame().lattice(), 400)) {
      cornered.add_corner(p);
      add_slowly(expected, p);
    }
    expect_equal(cornered.result(), expected);
  }
}

/// A circle is one piece in the shapes of others.
TEST(CorneredBoundary, AWholeTurnIsOnePiece) {
  Boundary boundary;
  for (const double sweep : {2 * pi, -2 * pi}) {
    Piece piece;
    piece.circular = true;
    piece.radius = 0.25;
    piece.center = {0.5, 0.5};
    piece.start = piece.end = {0.75, 0.5};
    piece.sweep = sweep;
    boundary.loops = {Loop{{piece}}};
    const PieceTree tree(boundary);
    CorneredBoundary cornered(boundary, tree, tolerance);
    Boundary expected = boundary;
    for (const double angle : {4.0, 1.0, 0.0, 6.2, 3.0, 2.0, 5.0}) {
      const Vec2 p = piece.center + Vec2{piece.radius * std::cos(angle), piece.radius * std::sin(angle)};
      cornered.add_corner(p);
      add_slowly(expected, p);
    }
    EXPECT_EQ(cornered.result().loops[0].pieces.size(), 7u);
    expect_equal(cornered.result(), expected);
  }
}

TEST(CorneredBoundary, TheWorkDoesNotGrowAsTheProduct) {
  const Frame plane(Box{{0, 0}, {1, 1}});
  constexpr int many = 5000;
  const RegionShape round({polygon(circle_of_vertices(many), plane)}, "p", plane),
      square({Part::rectangle("r", {{0.25, 0.25}, {0.75, 0.75}}, plane)}, "r", plane);
  std::vector<Vec2> vertices, side;
  for (const Piece& piece : round.boundary().loops[0].pieces)
    vertices.push_back(piece.start);
  for (int k = 0; k < many; ++k)
    side.push_back(plane.lattice().snap({0.25, 0.25 + 0.5 * (k + 0.5) / many}));
  for (const auto& [boundary, points] : {std::pair{&round.boundary(), vertices}, std::pair{&square.boundary(), side}}) {
    const PieceTree tree(*boundary);
    CorneredBoundary cornered(*boundary, tree, tolerance);
    for (const Vec2 p : points)
      cornered.add_corner(p);
    EXPECT_LE(cornered.distances(), 3 * many);
  }
}

} // namespace
} // namespace trime::geometry
