// SPDX-License-Identifier: BSD-3-Clause
// The small triangulation of a patch: Delaunay by brute force, and the same whatever way led to its points.
#include "cleanup/patch_mesh.hpp"

#include "geometry/predicates.hpp"
#include "support/periodic_shapes.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using testing::unit_lattice;
using Key = std::array<std::pair<double, double>, 3>;

const Vec2 center{0.5, 0.5};
constexpr double half_width = 4;

PatchMesh empty_mesh(const geometry::Periods& periods = {}) {
  PatchMesh mesh(unit_lattice(), periods);
  mesh.start(center, half_width);
  return mesh;
}

PatchMesh mesh_of(const std::vector<Vec2>& points, const geometry::Periods& periods = {}) {
  PatchMesh mesh = empty_mesh(periods);
  for (const Vec2 p : points)
    mesh.insert(p);
  return mesh;
}

std::vector<Vec2> places(const mesh::SiteList& sites) {
  std::vector<Vec2> points;
  for (const mesh::Site& site : sites)
    points.push_back(site.position);
  return points;
}

/// The triangles by their corners, each from its smallest on.
std::set<Key> triangles_of(const PatchMesh& mesh) {
  std::set<Key> all;
  for (const PatchMesh::Triangle& triangle : mesh.triangles()) {
    if (triangle.vertex[0] < 0)
      continue;
    Key key;
    for (std::size_t k = 0; k < 3; ++k)
      key[k] = {mesh.position(triangle.vertex[k]).x, mesh.position(triangle.vertex[k]).y};
    std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
    EXPECT_TRUE(all.insert(key).second) << "one triangle twice";
  }
  return all;
}

/// Triangle k of a vertex and its neighbour know each other, across the same edge.
void expect_mutual_neighbours(const PatchMesh& mesh) {
  int outside = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const PatchMesh::Triangle& triangle = mesh.triangles()[t];
    for (std::size_t k = 0; k < 3 && triangle.vertex[0] >= 0; ++k) {
      const LocalIndex beyond = triangle.neighbour[k];
      if (beyond < 0) {
        ++outside;
        continue;
      }
      const PatchMesh::Triangle& other = mesh.triangles()[static_cast<std::size_t>(beyond)];
      bool found = false;
      for (std::size_t m = 0; m < 3; ++m)
        found |= other.neighbour[m] == static_cast<LocalIndex>(t) &&
                 other.vertex[(m + 1) % 3] == triangle.vertex[(k + 2) % 3] &&
                 other.vertex[(m + 2) % 3] == triangle.vertex[(k + 1) % 3];
      ASSERT_TRUE(found) << "triangle " << t << ", side " << k;
    }
  }
  EXPECT_EQ(outside, 4) << "the sides of the frame";
}

/// @param points that it should have
void expect_delaunay(const PatchMesh& mesh, std::size_t points, const geometry::Periods& periods = {}) {
  std::set<LocalIndex> used;
  std::size_t triangles = 0;
  for (const PatchMesh::Triangle& triangle : mesh.triangles())
    if (triangle.vertex[0] >= 0) {
      ++triangles;
      used.insert(triangle.vertex.begin(), triangle.vertex.end());
    }
  EXPECT_EQ(used.size(), points + 4);
  EXPECT_EQ(triangles, 2 * points + 2) << "Euler";
  expect_mutual_neighbours(mesh);
  for (const PatchMesh::Triangle& triangle : mesh.triangles()) {
    if (triangle.vertex[0] < 0)
      continue;
    const Vec2 a = mesh.position(triangle.vertex[0]), b = mesh.position(triangle.vertex[1]),
               c = mesh.position(triangle.vertex[2]);
    ASSERT_GT(geometry::orient2d(a, b, c), 0);
    for (const LocalIndex v : used) {
      const bool is_corner = std::find(triangle.vertex.begin(), triangle.vertex.end(), v) != triangle.vertex.end();
      ASSERT_TRUE(is_corner || geometry::in_circle(a, b, c, mesh.position(v), unit_lattice(), periods) < 0);
    }
  }
}

/// Many points on each of a few lines.
std::vector<Vec2> rows() {
  std::vector<Vec2> points;
  for (int k = 0; k < 12; ++k)
    for (const double y : {0.25, 0.5, 0.53125})
      points.push_back({0.125 + 0.0625 * k, y});
  return points;
}

std::vector<std::vector<Vec2>> point_sets() {
  return {places(testing::random_sites(120, 1)),
          places(testing::square_lattice(9, 0.0625)),
          places(testing::hexagonal_lattice(9, 0.07)),
          places(testing::collinear(25)),
          places(testing::cocircular_rings()),
          places(testing::wheel(30, center, 0.25)),
          places(testing::near_duplicates(40, 2)),
          rows(),
          {{0.5, 0.5}}};
}

TEST(PatchMesh, IsDelaunayWhateverThePoints) {
  int number = 0;
  for (const std::vector<Vec2>& points : point_sets()) {
    SCOPED_TRACE("set " + std::to_string(number++));
    const std::set<Vec2, decltype(&geometry::lexicographically_less)> different(points.begin(), points.end(),
                                                                                &geometry::lexicographically_less);
    const PatchMesh mesh = mesh_of(points);
    expect_delaunay(mesh, different.size());
    std::vector<Vec2> backwards(points.rbegin(), points.rend());
    EXPECT_TRUE(triangles_of(mesh) == triangles_of(mesh_of(backwards))) << "the order of the points is to be seen";
    PatchMesh at_once = empty_mesh();
    LocalIndex v = PatchMesh::frame;
    for (const Vec2 p : different)
      EXPECT_EQ(at_once.append(p), v++) << "numbers are those of the order in which the points came";
    at_once.connect_all();
    expect_delaunay(at_once, different.size());
    EXPECT_TRUE(triangles_of(mesh) == triangles_of(at_once)) << "points connected along a curve";
  }
}

TEST(PatchMesh, ATieOfAllImagesOfFourPointsIsDecidedInOneWay) {
  const geometry::Periods periods = testing::unit_torus().periods();
  const std::vector<Vec2> points = places(testing::square_lattice(5, 0.0625, {0.875, 0.375}));
  expect_delaunay(mesh_of(points, periods), points.size(), periods);
  std::vector<Vec2> moved;
  for (const Vec2 p : points)
    moved.push_back(p - Vec2{1, 0});
  PatchMesh there(unit_lattice(), periods);
  there.start(center - Vec2{1, 0}, half_width);
  for (const Vec2 p : moved)
    there.insert(p);
  const PatchMesh here = mesh_of(points, periods);
  ASSERT_EQ(here.triangles().size(), there.triangles().size());
  for (std::size_t t = 0; t < here.triangles().size(); ++t)
    EXPECT_EQ(here.triangles()[t].vertex, there.triangles()[t].vertex);
}

TEST(PatchMesh, RefusesAPointThatIsThereAlready) {
  PatchMesh mesh = mesh_of(rows());
  const std::set<Key> before = triangles_of(mesh);
  const LocalIndex vertices = mesh.vertices();
  for (const Vec2 p : rows())
    EXPECT_EQ(mesh.insert(p), -1);
  EXPECT_EQ(mesh.insert(center + Vec2{half_width, half_width}), -1) << "a corner of the frame";
  EXPECT_EQ(mesh.vertices(), vertices);
  EXPECT_TRUE(triangles_of(mesh) == before);
  EXPECT_EQ(mesh.insert({0.51, 0.7}), vertices);
}

TEST(PatchMesh, TheRingGoesAroundCounterClockwise) {
  const PatchMesh mesh = mesh_of(places(testing::wheel(7, center, 0.25)));
  std::vector<LocalIndex> ring{99};
  mesh.collect_ring(PatchMesh::frame, ring);
  EXPECT_EQ(mesh.degree(PatchMesh::frame), 7);
  ASSERT_EQ(ring.size(), 7u);
  for (std::size_t k = 0; k < 7; ++k)
    EXPECT_GT(geometry::orient2d(center, mesh.position(ring[k]), mesh.position(ring[(k + 1) % 7])), 0);
}

/// Each vertex of each set goes and leaves the triangulation of the others, ties and straight rows included.
TEST(PatchMesh, RemovalLeavesTheTriangulationOfTheOthers) {
  int number = 0;
  for (const std::vector<Vec2>& points : point_sets()) {
    SCOPED_TRACE("set " + std::to_string(number++));
    const PatchMesh whole = mesh_of(points);
    if (points.size() == 1)
      continue; // which diagonal of the frame is left is of no interest
    for (LocalIndex v = PatchMesh::frame; v < whole.vertices(); v += 3) {
      PatchMesh mesh = whole;
      ASSERT_TRUE(mesh.remove(v)) << "vertex " << v;
      std::vector<Vec2> others;
      for (LocalIndex u = PatchMesh::frame; u < whole.vertices(); ++u)
        if (u != v)
          others.push_back(whole.position(u));
      ASSERT_TRUE(triangles_of(mesh) == triangles_of(mesh_of(others))) << "vertex " << v;
    }
  }
}

TEST(PatchMesh, EverythingCanBeRemovedInAnyOrder) {
  int number = 0;
  for (const std::vector<Vec2>& points : point_sets()) {
    SCOPED_TRACE("set " + std::to_string(number++));
    PatchMesh mesh = mesh_of(points);
    std::vector<LocalIndex> order;
    for (LocalIndex v = PatchMesh::frame; v < mesh.vertices(); ++v)
      order.push_back(v);
    std::sort(order.begin(), order.end(), [](LocalIndex a, LocalIndex b) {
      return mix_bits(static_cast<std::uint64_t>(a)) < mix_bits(static_cast<std::uint64_t>(b));
    });
    std::size_t left = order.size();
    for (const LocalIndex v : order) {
      ASSERT_TRUE(mesh.remove(v)) << left << " left";
      if (--left % 16 == 0)
        expect_delaunay(mesh, left);
    }
    EXPECT_EQ(triangles_of(mesh).size(), 2u) << "the frame";
  }
}

/// A vertex where the diagonals of a square meet: no flip leaves it strictly inside of a triangle.
TEST(PatchMesh, RemovesTheMiddleOfASquare) {
  const std::vector<Vec2> corners{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}};
  PatchMesh mesh = mesh_of(corners);
  const LocalIndex v = mesh.insert(center);
  ASSERT_EQ(mesh.degree(v), 4);
  ASSERT_TRUE(mesh.remove(v));
  EXPECT_TRUE(triangles_of(mesh) == triangles_of(mesh_of(corners)));
}

TEST(PatchMesh, AMoveThatTurnsATriangleOverIsRefused) {
  PatchMesh mesh = mesh_of(places(testing::wheel(6, center, 0.25)));
  const std::set<Key> before = triangles_of(mesh);
  EXPECT_FALSE(mesh.move(PatchMesh::frame, {0.9, 0.9}));
  EXPECT_FALSE(mesh.move(PatchMesh::frame, mesh.position(PatchMesh::frame + 1))) << "onto another one";
  EXPECT_TRUE(triangles_of(mesh) == before);
  EXPECT_TRUE(mesh.move(PatchMesh::frame, unit_lattice().snap(Vec2{0.6, 0.55})));
  EXPECT_EQ(mesh.position(PatchMesh::frame), unit_lattice().snap(Vec2{0.6, 0.55}));
  expect_delaunay(mesh, 7);
}

/// Along a straight row the triangles on one side may have no area left on the way: out and in again.
TEST(PatchMesh, VerticesOfAStraightRowAreReplacedAlongIt) {
  std::vector<Vec2> points = rows();
  PatchMesh mesh = mesh_of(points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].x += k % 2 == 0 ? 0.03125 : -0.015625;
    ASSERT_TRUE(mesh.replace(static_cast<LocalIndex>(k) + PatchMesh::frame, points[k])) << k;
    ASSERT_TRUE(triangles_of(mesh) == triangles_of(mesh_of(points))) << k;
  }
  EXPECT_FALSE(mesh.replace(PatchMesh::frame, points[5])) << "another one lies there";
}

/// Whatever the change: a triangle with other vertices than before is gone or listed.
TEST(PatchMesh, TellsWhichTrianglesHaveChanged) {
  PatchMesh mesh = mesh_of(places(testing::random_sites(60, 8)));
  std::vector<LocalIndex> shifted;
  std::size_t listed = 0;
  for (std::uint64_t step = 0; step < 200; ++step) {
    mesh.forget_changes();
    ASSERT_TRUE(mesh.changed().empty());
    const std::vector<PatchMesh::Triangle> before(mesh.triangles().begin(), mesh.triangles().end());
    const LocalIndex v = PatchMesh::frame + static_cast<LocalIndex>(step % 50);
    const Vec2 p = testing::random_vec2(9, step);
    const Vec2 near = unit_lattice().snap(mesh.position(v) + 0.03 * (p - center));
    if (step % 4 == 0)
      mesh.insert(p);
    else if (step % 4 == 1)
      mesh.replace(v, p);
    else if (step % 4 == 2)
      mesh.move(v, near);
    else if (mesh.degree(v) > 2) { // as relaxed vertices: within the star, then flips
      std::vector<LocalIndex> ring;
      mesh.collect_ring(v, ring);
      bool stays_inside = true;
      for (std::size_t k = 0; k < ring.size(); ++k)
        stays_inside &=
            geometry::orient2d(near, mesh.position(ring[k]), mesh.position(ring[(k + 1) % ring.size()])) > 0;
      if (stays_inside) {
        mesh.shift(v, near);
        shifted.assign(1, v);
        mesh.restore(shifted);
      }
    }
    const PatchMesh copy = mesh;
    const std::span<const LocalIndex> changed = copy.changed();
    listed += changed.size();
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
      const bool is_same = t < before.size() && before[t].vertex == mesh.triangles()[t].vertex;
      const bool is_listed = std::find(changed.begin(), changed.end(), static_cast<LocalIndex>(t)) != changed.end();
      ASSERT_TRUE(is_same || is_listed || mesh.triangles()[t].vertex[0] < 0) << "step " << step << " triangle " << t;
    }
  }
  EXPECT_GT(listed, 1000U);
}

/// Hundreds of changes of all kinds end in the triangulation of what is left.
TEST(PatchMesh, OnlyThePointsCountNotTheWay) {
  for (const bool on_a_coarse_lattice : {false, true}) { // then nearly all is a tie
    const auto random = [&](std::uint64_t key) {
      const Vec2 p = testing::random_vec2(on_a_coarse_lattice ? 5 : 6, key);
      return on_a_coarse_lattice ? Vec2{std::round(16 * p.x) / 16, std::round(16 * p.y) / 16} : p;
    };
    PatchMesh mesh = empty_mesh();
    std::vector<LocalIndex> alive;
    std::array<int, 4> done{};
    for (std::uint64_t step = 0; step < 600; ++step) {
      const Vec2 p = random(step);
      const std::uint64_t dice = mix_bits(step) % 8;
      const bool taken = std::any_of(alive.begin(), alive.end(), [&](LocalIndex v) { return mesh.position(v) == p; });
      if (alive.size() < 20 || dice < 3) {
        const LocalIndex v = mesh.insert(p);
        ASSERT_EQ(v < 0, taken);
        if (v >= 0)
          alive.push_back(v);
        ++done[0];
        continue;
      }
      const std::size_t which = mix_bits(step + 1000) % alive.size();
      const LocalIndex v = alive[which];
      if (dice < 5) {
        ASSERT_TRUE(mesh.remove(v)) << step;
        alive.erase(alive.begin() + static_cast<std::ptrdiff_t>(which));
        ++done[1];
      } else if (dice < 7) {
        const Vec2 near = mesh.position(v) + 0.0625 * (p - center);
        done[2] += mesh.move(v, on_a_coarse_lattice ? mesh.position(v) : unit_lattice().snap(near));
      } else if (!taken) {
        ASSERT_TRUE(mesh.replace(v, p)) << step;
        ++done[3];
      }
      if (step % 60 == 0)
        expect_delaunay(mesh, alive.size());
    }
    EXPECT_GT(*std::min_element(done.begin(), done.end()), 50);
    expect_delaunay(mesh, alive.size());
    std::vector<Vec2> points;
    for (const LocalIndex v : alive)
      points.push_back(mesh.position(v));
    EXPECT_TRUE(triangles_of(mesh) == triangles_of(mesh_of(points)));
    const PatchMesh copy = mesh;
    mesh.insert({0.3712158203125, 0.66552734375});
    EXPECT_TRUE(triangles_of(copy) != triangles_of(mesh)) << "a copy is taken back to";
  }
}

} // namespace
} // namespace trime::cleanup
