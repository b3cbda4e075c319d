// SPDX-License-Identifier: BSD-3-Clause
// Centroids of Voronoi cells.
#include "trime/meshing/update_rule.hpp"

#include <algorithm>

namespace trime::meshing {
namespace {

using geometry::Vec2;

/// Circumcentre of the triangle (0, u, v). @pre u and v are not parallel
Vec2 circumcenter(Vec2 u, Vec2 v) {
  const double twice = 2 * geometry::cross(u, v), u2 = geometry::squared_length(u), v2 = geometry::squared_length(v);
  return {(u2 * v.y - v2 * u.y) / twice, (v2 * u.x - u2 * v.x) / twice};
}

double power(double base, int exponent) {
  double result = 1;
  for (; exponent > 0; --exponent)
    result *= base;
  return result;
}

/// Integral of a weight and of the weight times the place, over triangles with one corner at the origin.
struct Moments {
  double mass = 0;
  Vec2 first;

  /// Linear weight: `origin`, `at_a`, `at_b` at the corners.
  void add(Vec2 a, Vec2 b, double origin, double at_a, double at_b) {
    const double twice_area = geometry::cross(a, b), all = origin + at_a + at_b;
    mass += twice_area * all / 6;
    first = first + (twice_area / 24) * ((all + at_a) * a + (all + at_b) * b);
  }
};

} // namespace

Vec2 CvdRule::centroid(const StarView& view, LocalIndex i) const {
  const std::span<const LocalIndex> ring = view.stars.ring(i);
  const std::size_t n = ring.size();
  if (n < 3 || std::find(ring.begin(), ring.end(), delaunay::gap) != ring.end())
    return {};
  const bool weighted = !view.is_uniform() && exponent_ != 0;
  const Vec2 p = view.points.position(i);
  const double own = view.size(i), thrice_own = 3 * own;
  // The corner of the cell between neighbours k and k + 1, and its weight relative to that of the site.
  const auto corner = [&](LocalIndex a, LocalIndex b) {
    return circumcenter(view.points.position(a) - p, view.points.position(b) - p);
  };
  const auto weight = [&](LocalIndex a, LocalIndex b) {
    return weighted ? power(thrice_own / (own + view.size(a) + view.size(b)), exponent_) : 1;
  };
  Moments moments;
  Vec2 last = corner(ring[n - 1], ring[0]);
  double last_weight = weight(ring[n - 1], ring[0]);
  for (std::size_t k = 0; k < n; ++k) {
    const LocalIndex a = ring[k], b = ring[k + 1 == n ? 0 : k + 1];
    const Vec2 next = corner(a, b);
    const double next_weight = weight(a, b);
    moments.add(last, next, 1, last_weight, next_weight);
    last = next;
    last_weight = next_weight;
  }
  return moments.mass > 0 ? (1 / moments.mass) * moments.first : Vec2{};
}

void CvdRule::begin_sweep(const SweepSums& sums) {
  momentum_.begin_sweep(sums);
}

Step CvdRule::step(const StarView& view, LocalIndex i) const {
  return momentum_.step(view, i, centroid(view, i));
}

} // namespace trime::meshing
