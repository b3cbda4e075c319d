// SPDX-License-Identifier: BSD-3-Clause
// Checks the stars of any set of points, by exact predicates and brute force.
#pragma once

#include "delaunay/star_builder.hpp"
#include "geometry/predicates.hpp"
#include "support/point_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace trime::testing {

using Triangle = std::array<geometry::Vec2, 3>;

struct LexicographicOrder {
  bool operator()(geometry::Vec2 a, geometry::Vec2 b) const { return geometry::lexicographically_less(a, b); }
  bool operator()(const Triangle& a, const Triangle& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), geometry::lexicographically_less);
  }
};
using TriangleSet = std::set<Triangle, LexicographicOrder>;

/// Returns the triangle with its smallest vertex first, in the same orientation.
inline Triangle canonical(geometry::Vec2 a, geometry::Vec2 b, geometry::Vec2 c) {
  Triangle t{a, b, c};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end(), geometry::lexicographically_less), t.end());
  return t;
}

/// Calls visit(a, b) for each triangle (i, a, b) of the star of site i.
template <class Visit>
void for_each_triangle(const delaunay::StarTable& stars, LocalIndex i, const Visit& visit) {
  const std::span<const LocalIndex> ring = stars.ring(i);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LocalIndex a = ring[k], b = ring[(k + 1) % ring.size()];
    if (a != delaunay::gap && b != delaunay::gap)
      visit(a, b);
  }
}

/// Returns all triangles in the stars of the owned sites.
inline TriangleSet triangles_of(const mesh::BinnedPoints& points, const delaunay::StarTable& stars) {
  TriangleSet all;
  for (LocalIndex i = 0; i < points.owned(); ++i)
    for_each_triangle(stars, i, [&](LocalIndex a, LocalIndex b) {
      all.insert(canonical(points.position(i), points.position(a), points.position(b)));
    });
  return all;
}

/// Checks that every ring of neighbours is counter-clockwise, starts at the smallest neighbour, and has neither
/// repeated neighbours nor two gaps in a row.
inline void expect_well_formed(const mesh::BinnedPoints& points, const delaunay::StarTable& stars) {
  for (LocalIndex i = 0; i < points.owned(); ++i) {
    const std::span<const LocalIndex> ring = stars.ring(i);
    if (ring.empty())
      continue;
    ASSERT_NE(ring[0], delaunay::gap);
    std::set<LocalIndex> seen;
    double turned = 0;
    const auto angle = [&](LocalIndex a) {
      const geometry::Vec2 d = points.position(a) - points.position(i);
      return angle_of(d.y, d.x);
    };
    LocalIndex last = -1;
    for (std::size_t k = 0; k <= ring.size(); ++k) {
      const LocalIndex a = ring[k % ring.size()];
      if (a == delaunay::gap) {
        EXPECT_NE(ring[(k + 1) % ring.size()], delaunay::gap) << "double gap";
        continue;
      }
      if (k < ring.size()) {
        EXPECT_TRUE(seen.insert(a).second) << "named twice";
        EXPECT_FALSE(k > 0 && geometry::lexicographically_less(points.position(a), points.position(ring[0])));
      }
      if (last >= 0)
        turned += angle(a) - angle(last) + (angle(a) > angle(last) ? 0 : 2 * pi);
      last = a;
    }
    EXPECT_NEAR(turned, 2 * pi, 1e-6) << "site " << i << " does not wind once";
    for_each_triangle(stars, i, [&](LocalIndex a, LocalIndex b) {
      EXPECT_EQ(geometry::orient2d(points.position(i), points.position(a), points.position(b)), 1);
    });
  }
}

/// Checks that each triangle is listed by the stars of all its corners that are owned.
inline void expect_consistent(const mesh::BinnedPoints& points, const delaunay::StarTable& stars) {
  const auto has = [&](LocalIndex i, LocalIndex a, LocalIndex b) {
    bool found = false;
    for_each_triangle(stars, i, [&](LocalIndex c, LocalIndex d) { found |= c == a && d == b; });
    return found;
  };
  for (LocalIndex i = 0; i < points.owned(); ++i)
    for_each_triangle(stars, i, [&](LocalIndex a, LocalIndex b) {
      EXPECT_TRUE(a >= points.owned() || has(a, b, i)) << i << ' ' << a << ' ' << b;
      EXPECT_TRUE(b >= points.owned() || has(b, i, a)) << i << ' ' << a << ' ' << b;
    });
}

/// Checks by the exact predicate that no site lies inside the circumcircle of any triangle. Cost: O(n^2).
inline void expect_empty_discs(const mesh::BinnedPoints& points, const delaunay::StarTable& stars,
                               const geometry::Lattice& lattice) {
  for (LocalIndex i = 0; i < points.owned(); ++i)
    for_each_triangle(stars, i, [&](LocalIndex a, LocalIndex b) {
      if (std::max(a, b) > i) // each triangle once
        return;
      for (LocalIndex q = 0; q < points.size(); ++q) {
        if (q == i || q == a || q == b)
          continue;
        ASSERT_LT(geometry::in_circle(points.position(i), points.position(a), points.position(b), points.position(q),
                                      lattice),
                  0);
      }
    });
}

/// Checks that two tables have the same rings, compared by positions.
/// @pre both hold the same sites in the same order
inline void expect_same_rings(const delaunay::StarTable& a, const delaunay::StarTable& b) {
  ASSERT_EQ(a.size(), b.size());
  for (LocalIndex i = 0; i < a.size(); ++i) {
    const std::span<const LocalIndex> one = a.ring(i), other = b.ring(i);
    EXPECT_TRUE(std::equal(one.begin(), one.end(), other.begin(), other.end())) << "site " << i;
  }
}

} // namespace trime::testing
