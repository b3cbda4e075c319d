// SPDX-License-Identifier: BSD-3-Clause
// orient2d and in_circle against big integers, on sets of points that make floating-point predicates fail.
#include "core/random.hpp"
#include "geometry/predicates.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace trime::geometry {
namespace {

using Big = boost::multiprecision::cpp_int;
using Four = std::array<Vec2, 4>;

/// A number in [0, n).
std::int64_t draw(std::uint64_t key, std::uint64_t slot, std::int64_t n) {
  return static_cast<std::int64_t>(random_bits(3, RandomPurpose::test, key, slot) % static_cast<std::uint64_t>(n));
}

/// Containers whose lattices are limited by their size, by their offset, and far from 1 either way.
std::vector<Box> containers() {
  return {{{0, 0}, {1, 1}},         {{1e6, -1e6}, {1e6 + 1, -1e6 + 2}}, {{0, 0}, {1e-9, 3e-9}},
          {{-1e9, -1e9}, {5e9, 0}}, {{0.1, 0.2}, {0.7, 0.3}},           {{-1e-30, 0}, {1e-30, 1e-30}}};
}

struct BigPoint {
  Big x, y;
};

/// Lattice steps from the origin: a scaling by a power of two, exact.
BigPoint big(Vec2 p, const Lattice& lattice) {
  const auto steps = [&](double v) {
    const double s = v / lattice.step();
    EXPECT_EQ(s, std::nearbyint(s)) << "not on the lattice";
    return Big(static_cast<std::int64_t>(s));
  };
  return {steps(p.x), steps(p.y)};
}

int sign(const Big& v) {
  return v.sign();
}

int oracle_orientation(Vec2 a, Vec2 b, Vec2 c, const Lattice& lattice) {
  const BigPoint p = big(a, lattice), q = big(b, lattice), r = big(c, lattice);
  return sign((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
}

/// The lifted determinant with heights that really are raised, by numbers so far apart that they act like
/// infinitesimals: the tie rule without symbols.
int oracle_in_circle(const Four& points, const Lattice& lattice) {
  std::array<int, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return lexicographically_less(points[i], points[j]); });
  std::array<Big, 4> x, y, z;
  const BigPoint origin = big(points[3], lattice);
  for (std::size_t k = 0; k < 4; ++k) {
    const BigPoint p = big(points[k], lattice);
    x[k] = p.x - origin.x;
    y[k] = p.y - origin.y;
    const auto rank = std::find(order.begin(), order.end(), static_cast<int>(k)) - order.begin();
    z[k] = ((x[k] * x[k] + y[k] * y[k]) << 500) + (Big(1) << (120 * static_cast<unsigned>(rank)));
  }
  const auto minor = [&](std::size_t i, std::size_t j) -> Big { return x[i] * y[j] - x[j] * y[i]; };
  for (std::size_t k = 0; k < 3; ++k)
    z[k] -= z[3];
  return sign(z[0] * minor(1, 2) + z[1] * minor(2, 0) + z[2] * minor(0, 1));
}

/// Four different points on the lattice of a container, of one of many kinds.
Four make_points(const Lattice& lattice, const Box& container, std::uint64_t key) {
  const double step = lattice.step();
  const Vec2 middle = lattice.snap(0.5 * (container.min + container.max));
  const double side = std::max(container.width(), container.height());
  const auto unit = [&](std::uint64_t slot) { return random_unit(5, RandomPurpose::test, key, slot) - 0.5; };
  Four p;
  for (std::size_t k = 0; k < 4; ++k)
    p[k] = lattice.snap(middle + side * Vec2{unit(2 * k), unit(2 * k + 1)});
  switch (key % 6) {
  case 0: // anywhere
    break;
  case 1: // as far as the predicates allow
    for (Vec2& q : p)
      q = middle + 5.0 * (q - middle);
    break;
  case 2: // lattice neighbours, far from the origin of the lattice
    for (std::size_t k = 0; k < 4; ++k)
      p[k] = p[0] + step * Vec2{static_cast<double>(draw(key, 20 + k, 4)), static_cast<double>(draw(key, 30 + k, 4))};
    break;
  case 3: { // on a line, up to one step
    const Vec2 slope{static_cast<double>(draw(key, 40, 1000) - 500), static_cast<double>(draw(key, 41, 1000) - 500)};
    for (std::size_t k = 1; k < 4; ++k)
      p[k] = p[0] + (step * static_cast<double>(draw(key, 50 + k, 1 << 24) - (1 << 23))) * slope +
             step * Vec2{0, static_cast<double>(draw(key, 60 + k, 2))};
    break;
  }
  default: { // on a circle through integers, up to one step in half of the cases
    const double a = static_cast<double>(draw(key, 70, 1 << 26)), b = static_cast<double>(draw(key, 71, 1 << 26));
    const std::array<Vec2, 8> circle{{{a, b}, {b, a}, {-b, a}, {-a, b}, {-a, -b}, {-b, -a}, {b, -a}, {a, -b}}};
    const std::size_t first = static_cast<std::size_t>(draw(key, 72, 8));
    for (std::size_t k = 0; k < 4; ++k)
      p[k] = middle + step * circle[(first + k * static_cast<std::size_t>(1 + draw(key, 73, 1))) % 8];
    if (key % 6 == 5)
      p[static_cast<std::size_t>(draw(key, 74, 4))].x += step;
  }
  }
  return p;
}

bool all_different(const Four& p) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (p[i] == p[j])
        return false;
  return true;
}

template <class Visit>
void for_each_case(const Visit& visit) {
  for (const Box& container : containers()) {
    const Lattice lattice(container);
    for (std::uint64_t key = 0; key < 600; ++key) {
      const Four p = make_points(lattice, container, key);
      if (all_different(p))
        visit(p, lattice);
    }
  }
}

TEST(Predicates, OrientationIsExactAndAntisymmetric) {
  int collinear = 0;
  for_each_case([&](const Four& p, const Lattice& lattice) {
    const int side = orient2d(p[0], p[1], p[2]);
    ASSERT_EQ(side, oracle_orientation(p[0], p[1], p[2], lattice));
    EXPECT_EQ(orient2d(p[1], p[2], p[0]), side);
    EXPECT_EQ(orient2d(p[1], p[0], p[2]), -side);
    EXPECT_EQ(orient2d(p[0], p[1], p[1]), 0);
    collinear += side == 0;
  });
  EXPECT_GT(collinear, 100) << "the hard cases are missing";
}

TEST(Predicates, InCircleIsExactWithAndWithoutFilterAndBreaksTiesByTheRaisedHeights) {
  int ties = 0;
  for_each_case([&](const Four& p, const Lattice& lattice) {
    if (orient2d(p[0], p[1], p[2]) == 0)
      return;
    const int expected = oracle_in_circle(p, lattice);
    ASSERT_NE(expected, 0);
    ASSERT_EQ(in_circle_exact(p[0], p[1], p[2], p[3], lattice), expected);
    ASSERT_EQ(in_circle(p[0], p[1], p[2], p[3], lattice), expected);
    std::array<BigPoint, 4> q;
    for (std::size_t k = 0; k < 4; ++k)
      q[k] = big(p[k] - p[3], lattice);
    const auto square = [&](std::size_t k) -> Big { return q[k].x * q[k].x + q[k].y * q[k].y; };
    const auto minor = [&](std::size_t i, std::size_t j) -> Big { return q[i].x * q[j].y - q[j].x * q[i].y; };
    ties += Big(square(0) * minor(1, 2) + square(1) * minor(2, 0) + square(2) * minor(0, 1)).is_zero();
  });
  EXPECT_GT(ties, 300) << "the hard cases are missing";
}

TEST(Predicates, InCircleChangesItsSignWithEveryOddPermutationOfAllFourPoints) {
  for_each_case([&](const Four& p, const Lattice& lattice) {
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    if (orient2d(p[0], p[1], p[2]) == 0 || orient2d(p[0], p[1], p[3]) == 0 || orient2d(p[0], p[2], p[3]) == 0 ||
        orient2d(p[1], p[2], p[3]) == 0)
      return;
    const int side = in_circle(p[0], p[1], p[2], p[3], lattice);
    do {
      int inversions = 0;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
          inversions += order[j] < order[i];
      ASSERT_EQ(in_circle(p[order[0]], p[order[1]], p[order[2]], p[order[3]], lattice),
                inversions % 2 == 0 ? side : -side);
    } while (std::next_permutation(order.begin(), order.end()));
  });
}

TEST(Predicates, ACocircularQuadrilateralHasExactlyOneDiagonalWhereverItLies) {
  const Lattice lattice(Box{{0, 0}, {1, 1}});
  const std::vector<Four> shapes{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
                                 {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}},
                                 {{{5, 0}, {3, 4}, {-3, 4}, {-4, -3}}},
                                 {{{0, -5}, {4, 3}, {0, 5}, {-5, 0}}}};
  for (const Four& shape : shapes) {
    int first_answer = 0;
    for (std::uint64_t key = 0; key < 20; ++key) {
      const Vec2 at = lattice.snap(Vec2{random_unit(1, RandomPurpose::test, key, 0), 0.3});
      Four p;
      for (std::size_t k = 0; k < 4; ++k)
        p[k] = at + (lattice.step() * 1024) * shape[k];
      // Diagonal 0-2 is Delaunay if point 3 lies outside the triangle 0 1 2, diagonal 1-3 if point 0 lies outside 1
      // 2 3.
      const bool diagonal_02 = in_circle(p[0], p[1], p[2], p[3], lattice) < 0;
      const bool diagonal_13 = in_circle(p[1], p[2], p[3], p[0], lattice) < 0;
      EXPECT_NE(diagonal_02, diagonal_13);
      EXPECT_EQ(in_circle(p[2], p[3], p[0], p[1], lattice) < 0, diagonal_02) << "the other triangle disagrees";
      const int answer = diagonal_02 ? 1 : -1;
      first_answer = key == 0 ? answer : first_answer;
      EXPECT_EQ(answer, first_answer) << "the answer moved with the points";
    }
  }
}

TEST(InsideCircle, LeavesOutCocircularPointsAndTakesTheNextOnes) {
  const Lattice lattice(unit_square);
  const double r = 1024 * lattice.step();
  const Vec2 at = lattice.snap(Vec2{0.3, 0.7}), inward{lattice.step(), 0};
  const Vec2 a = at + r * Vec2{0, -5}, b = at + r * Vec2{4, 3}, c = at + r * Vec2{-5, 0};
  for (const Vec2 d : {at + r * Vec2{0, 5}, at + r * Vec2{3, 4}, at + r * Vec2{5, 0}})
    EXPECT_FALSE(is_inside_circle(a, b, c, d, lattice));
  EXPECT_TRUE(is_inside_circle(a, b, c, at + r * Vec2{5, 0} - inward, lattice));
  EXPECT_FALSE(is_inside_circle(a, b, c, at + r * Vec2{5, 0} + inward, lattice));
}

} // namespace
} // namespace trime::geometry
