// SPDX-License-Identifier: BSD-3-Clause
// The constrained Delaunay triangulation on which narrow parts are found: valid, locally Delaunay, unique.
#include "generalise/triangulation.hpp"

#include "geometry/predicates.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace trime::generalise {
namespace {

using geometry::orient2d;
using geometry::Vec2;
using testing::unit_lattice;
using HalfEdge = Triangulation::HalfEdge;

const geometry::Box around{{-0.5, -0.5}, {1.5, 1.5}};

/// Orientation, twins, marks, Euler's formula, and Delaunay across every edge without constraint.
void expect_valid(const Triangulation& mesh) {
  std::int64_t border = 0;
  for (HalfEdge e = 0; e < 3 * mesh.triangle_count(); ++e) {
    const Vec2 a = mesh.point(mesh.origin(e)), b = mesh.point(mesh.target(e)),
               c = mesh.point(mesh.origin(Triangulation::previous(e)));
    if (e % 3 == 0) {
      ASSERT_EQ(orient2d(a, b, c), 1) << "triangle " << e / 3;
    }
    const HalfEdge f = mesh.twin(e);
    if (f == Triangulation::none) {
      ++border;
      continue;
    }
    ASSERT_EQ(mesh.twin(f), e);
    ASSERT_EQ(mesh.origin(f), mesh.target(e));
    ASSERT_EQ(mesh.target(f), mesh.origin(e));
    ASSERT_EQ(mesh.is_constrained(e), mesh.is_constrained(f));
    if (mesh.is_constrained(e)) {
      ASSERT_EQ(mesh.mark_of_edge(e), mesh.mark_of_edge(f));
      ASSERT_NE(mesh.mark(e) >= 0, mesh.mark(f) >= 0);
    } else {
      const Vec2 d = mesh.point(mesh.origin(Triangulation::previous(f)));
      ASSERT_LT(geometry::in_circle(a, b, c, d, unit_lattice()), 0) << "edge " << e;
    }
  }
  EXPECT_EQ(border, 4);
  EXPECT_EQ(mesh.triangle_count(), 2 * (mesh.vertex_count() - 4) + 2); // all vertices inside the box but its corners
  for (LocalIndex v = 0; v < mesh.vertex_count(); ++v)
    ASSERT_EQ(mesh.origin(mesh.leaving(v)), v);
}

using Corners = std::array<std::pair<double, double>, 3>;

Corners sorted_corners(Vec2 a, Vec2 b, Vec2 c) {
  Corners corners{std::pair{a.x, a.y}, std::pair{b.x, b.y}, std::pair{c.x, c.y}};
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The triangles by the coordinates of their corners.
std::set<Corners> triangles_of(const Triangulation& mesh) {
  std::set<Corners> result;
  for (HalfEdge e = 0; e < 3 * mesh.triangle_count(); e += 3)
    result.insert(
        sorted_corners(mesh.point(mesh.origin(e)), mesh.point(mesh.origin(e + 1)), mesh.point(mesh.origin(e + 2))));
  return result;
}

/// All triples of different points with an empty circle.
std::set<Corners> triangles_by_brute_force(const std::vector<Vec2>& points) {
  std::set<Corners> result;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        const int turn = orient2d(points[i], points[j], points[k]);
        if (turn == 0)
          continue;
        const Vec2 b = turn > 0 ? points[j] : points[k], c = turn > 0 ? points[k] : points[j];
        bool empty = true;
        for (std::size_t m = 0; m < n && empty; ++m)
          empty = m == i || m == j || m == k || geometry::in_circle(points[i], b, c, points[m], unit_lattice()) < 0;
        if (empty)
          result.insert(sorted_corners(points[i], b, c));
      }
  return result;
}

std::vector<Vec2> places(const mesh::SiteList& sites) {
  std::vector<Vec2> points;
  for (const mesh::Site& site : sites)
    points.push_back(site.position);
  return points;
}

/// Points that are hard in one way each.
std::vector<std::pair<std::string, std::vector<Vec2>>> point_sets() {
  std::vector<Vec2> given_twice = places(testing::random_sites(30, 3));
  given_twice.insert(given_twice.end(), given_twice.begin(), given_twice.begin() + 20);
  return {{"random", places(testing::random_sites(60, 1))},
          {"given twice", given_twice},
          {"collinear", places(testing::collinear(40))},
          {"square lattice", places(testing::square_lattice(6, 0.1))},
          {"hexagonal lattice", places(testing::hexagonal_lattice(6, 0.1))},
          {"wheel", places(testing::wheel(30, {0.5, 0.5}, 0.3))},
          {"cocircular", places(testing::cocircular_rings())},
          {"clusters", places(testing::clusters(50, 2))},
          {"near duplicates", places(testing::near_duplicates(20, 4))}};
}

/// In an order that follows from the seed.
std::vector<Vec2> shuffled(std::vector<Vec2> points, std::uint64_t seed) {
  for (std::size_t k = points.size(); k > 1; --k)
    std::swap(points[k - 1],
              points[static_cast<std::size_t>(random_unit(seed, RandomPurpose::test, k, 7) * static_cast<double>(k))]);
  return points;
}

TEST(Triangulation, EqualsBruteForceInAnyOrder) {
  for (const auto& [name, given] : point_sets()) {
    SCOPED_TRACE(name);
    std::vector<Vec2> points = given;
    std::sort(points.begin(), points.end(), geometry::lexicographically_less);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const std::size_t distinct = points.size();
    points.insert(points.end(), {around.min, {around.max.x, around.min.y}, around.max, {around.min.x, around.max.y}});
    const std::set<Corners> expected = triangles_by_brute_force(points);
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      Triangulation mesh(around, unit_lattice());
      for (const Vec2 p : shuffled(given, seed))
        EXPECT_EQ(mesh.point(mesh.insert(p)), p);
      EXPECT_EQ(static_cast<std::size_t>(mesh.vertex_count()), distinct + 4);
      expect_valid(mesh);
      EXPECT_EQ(triangles_of(mesh), expected);
    }
  }
}

/// Random points and constraints between some of them: those that were taken, as pairs of vertices by mark.
struct Constrained {
  Triangulation mesh{around, unit_lattice()};
  std::map<std::int32_t, std::pair<LocalIndex, LocalIndex>> taken;
  int refused = 0;
};

bool crosses(const Triangulation& mesh, std::pair<LocalIndex, LocalIndex> s, std::pair<LocalIndex, LocalIndex> t) {
  const Vec2 a = mesh.point(s.first), b = mesh.point(s.second), c = mesh.point(t.first), d = mesh.point(t.second);
  return orient2d(a, b, c) * orient2d(a, b, d) < 0 && orient2d(c, d, a) * orient2d(c, d, b) < 0;
}

bool passes(const Triangulation& mesh, std::pair<LocalIndex, LocalIndex> s, LocalIndex v) {
  const Vec2 a = mesh.point(s.first), b = mesh.point(s.second), p = mesh.point(v);
  return v != s.first && v != s.second && orient2d(a, b, p) == 0 && dot(p - a, b - a) > 0 && dot(p - b, a - b) > 0;
}

void constrain_at_random(Constrained& all, int count, std::uint64_t seed) {
  const auto vertex = [&](int k, int slot) {
    return 4 + static_cast<LocalIndex>(random_unit(seed, RandomPurpose::test, static_cast<std::uint64_t>(k), slot) *
                                       (all.mesh.vertex_count() - 4));
  };
  for (std::int32_t mark = 0; mark < count; ++mark) {
    const std::pair<LocalIndex, LocalIndex> ends{vertex(mark, 11), vertex(mark, 12)};
    bool possible = ends.first != ends.second;
    for (const auto& [other, there] : all.taken)
      possible &= !crosses(all.mesh, ends, there) && ends != there && ends != std::pair{there.second, there.first};
    for (LocalIndex v = 4; v < all.mesh.vertex_count(); ++v)
      possible &= !passes(all.mesh, ends, v);
    const std::set<Corners> before = triangles_of(all.mesh);
    ASSERT_EQ(all.mesh.constrain(ends.first, ends.second, mark), possible);
    if (possible) {
      all.taken[mark] = ends;
    } else {
      ++all.refused;
      EXPECT_EQ(triangles_of(all.mesh), before);
    }
  }
}

void expect_constraints(const Constrained& all) {
  for (const auto& [mark, ends] : all.taken) {
    const HalfEdge e = all.mesh.find_edge(ends.first, ends.second);
    ASSERT_NE(e, Triangulation::none);
    EXPECT_EQ(all.mesh.mark(e), mark);
    EXPECT_LT(all.mesh.mark(all.mesh.twin(e)), 0); // in the other direction
    EXPECT_EQ(all.mesh.mark_of_edge(all.mesh.twin(e)), mark);
  }
}

TEST(Triangulation, TakesConstraintsThatCrossNothingAndRefusesOthers) {
  for (const auto& [name, given] : point_sets())
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      SCOPED_TRACE(name);
      Constrained all;
      for (const Vec2 p : given)
        all.mesh.insert(p);
      constrain_at_random(all, 80, seed);
      expect_valid(all.mesh);
      expect_constraints(all);
      EXPECT_GT(all.refused, 0);
    }
}

TEST(Triangulation, KeepsConstraintsThroughInsertions) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    Constrained all;
    for (const Vec2 p : places(testing::random_sites(50, seed)))
      all.mesh.insert(p);
    constrain_at_random(all, 40, seed);
    for (const Vec2 p : places(testing::random_sites(200, seed + 100)))
      all.mesh.insert(p);
    expect_valid(all.mesh);
    expect_constraints(all);
  }
}

TEST(Triangulation, TrianglesDoNotDependOnTheOrderOfConstraints) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    Constrained first;
    const std::vector<Vec2> points = places(testing::random_sites(60, seed));
    for (const Vec2 p : points)
      first.mesh.insert(p);
    constrain_at_random(first, 60, seed);
    Triangulation second(around, unit_lattice());
    const std::vector<Vec2> other = shuffled(points, seed);
    for (const Vec2 p : other)
      second.insert(p);
    for (auto entry = first.taken.rbegin(); entry != first.taken.rend(); ++entry) {
      const LocalIndex a = second.insert(first.mesh.point(entry->second.first)),
                       b = second.insert(first.mesh.point(entry->second.second));
      ASSERT_TRUE(second.constrain(a, b, entry->first));
    }
    expect_valid(second);
    EXPECT_EQ(triangles_of(second), triangles_of(first.mesh));
  }
}

TEST(Triangulation, SplitsConstrainedEdgesNearThem) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    Constrained all;
    for (const Vec2 p : places(testing::random_sites(40, seed)))
      all.mesh.insert(p);
    constrain_at_random(all, 40, seed);
    for (const auto& [mark, ends] : all.taken) {
      std::vector<LocalIndex> chain{ends.first, ends.second};
      for (int round = 0; round < 3; ++round)
        for (std::size_t k = 0; k + 1 < chain.size(); k += 2) {
          const HalfEdge e = all.mesh.find_edge(chain[k], chain[k + 1]);
          ASSERT_NE(e, Triangulation::none);
          const Vec2 middle = unit_lattice().snap(0.5 * (all.mesh.point(chain[k]) + all.mesh.point(chain[k + 1])));
          const LocalIndex v = all.mesh.split(e, middle);
          ASSERT_NE(v, Triangulation::none);
          chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(k) + 1, v);
        }
      for (std::size_t k = 0; k + 1 < chain.size(); ++k)
        EXPECT_EQ(all.mesh.mark(all.mesh.find_edge(chain[k], chain[k + 1])), mark);
    }
    expect_valid(all.mesh);
  }
}

TEST(Triangulation, SplitsBesideANeedle) {
  // The middle of an edge moved by a lattice step towards a far vertex, or away from it: the new edge to that vertex
  // may have to flip at once.
  const double step = unit_lattice().step();
  for (const double aside : {-3 * step, -step, 0.0, step, 3 * step}) {
    Triangulation mesh(around, unit_lattice());
    const LocalIndex a = mesh.insert({0.5, 0.5}), b = mesh.insert({0.5 + 64 * step, 0.5});
    mesh.insert({0.5 + 32 * step, 1});
    mesh.insert({0.5 + 32 * step, 0});
    ASSERT_TRUE(mesh.constrain(a, b, 0));
    EXPECT_NE(mesh.split(mesh.find_edge(a, b), {0.5 + 32 * step, 0.5 + aside}), Triangulation::none);
    expect_valid(mesh);
  }
}

TEST(Triangulation, RefusesToSplitWhereATriangleWouldTurnOver) {
  Triangulation mesh(around, unit_lattice());
  const LocalIndex a = mesh.insert({0.25, 0.5}), b = mesh.insert({0.75, 0.5});
  mesh.insert({0.5, 0.5 + 4 * unit_lattice().step()});
  ASSERT_TRUE(mesh.constrain(a, b, 0));
  const std::set<Corners> before = triangles_of(mesh);
  EXPECT_EQ(mesh.split(mesh.find_edge(a, b), {0.5, 0.5 + 4 * unit_lattice().step()}), Triangulation::none);
  EXPECT_EQ(mesh.split(mesh.find_edge(a, b), {0.5, 0.75}), Triangulation::none);
  EXPECT_EQ(triangles_of(mesh), before);
}

} // namespace
} // namespace trime::generalise
