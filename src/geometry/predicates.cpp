// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/predicates.hpp"

#include <algorithm>
#include <array>

namespace trime::geometry {
namespace {

__extension__ using Int128 = __int128;

/// Sign of the sum of three products of integers below 2^94 in magnitude, the second factors not negative. Both factors
/// are split at 47 bits; partial sums stay below 2^98 and are carried upwards, so nothing can overflow.
int sign_of_sum(const std::array<Int128, 3>& factors, const std::array<Int128, 3>& squares) {
  constexpr int bits = 47;
  constexpr Int128 mask = (Int128{1} << bits) - 1;
  Int128 low = 0, middle = 0, high = 0;
  for (int k = 0; k < 3; ++k) {
    const Int128 f0 = factors[k] & mask, f1 = factors[k] >> bits; // f1 carries the sign
    const Int128 s0 = squares[k] & mask, s1 = squares[k] >> bits;
    low += f0 * s0;
    middle += f0 * s1 + f1 * s0;
    high += f1 * s1;
  }
  middle += low >> bits;
  low &= mask;
  high += middle >> bits;
  middle &= mask;
  if (high != 0)
    return high > 0 ? 1 : -1;
  return (middle | low) != 0 ? 1 : 0;
}

/// Side of d for four cocircular points: the point latest in lexicographic order is raised most, so the first
/// coefficient of a raised height that is not zero, from the latest point down, decides.
template <class Less>
int perturbed_side(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Less& less) {
  struct Raised {
    Vec2 point;
    int coefficient;
  };
  std::array<Raised, 4> raised{
      {{a, orient2d(b, c, d)}, {b, orient2d(c, a, d)}, {c, orient2d(a, b, d)}, {d, -orient2d(a, b, c)}}};
  std::sort(raised.begin(), raised.end(), [&](const Raised& p, const Raised& q) { return less(q.point, p.point); });
  for (const Raised& r : raised)
    if (r.coefficient != 0)
      return r.coefficient;
  return 0;
}

/// Sign of the determinant, 0 for cocircular points.
int exact_side(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice) {
  const Int128 ax = lattice.steps(a.x - d.x), ay = lattice.steps(a.y - d.y);
  const Int128 bx = lattice.steps(b.x - d.x), by = lattice.steps(b.y - d.y);
  const Int128 cx = lattice.steps(c.x - d.x), cy = lattice.steps(c.y - d.y);
  return sign_of_sum({bx * cy - cx * by, cx * ay - ax * cy, ax * by - bx * ay},
                     {ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy});
}

} // namespace

int in_circle_exact(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice) {
  const int sign = exact_side(a, b, c, d, lattice);
  return sign != 0 ? sign : perturbed_side(a, b, c, d, lexicographically_less);
}

int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice) {
  const int sign = in_circle_filter(a, b, c, d);
  return sign != 0 ? sign : in_circle_exact(a, b, c, d, lattice);
}

bool is_inside_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice) {
  const int sign = in_circle_filter(a, b, c, d);
  return (sign != 0 ? sign : exact_side(a, b, c, d, lattice)) > 0;
}

int in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d, const Lattice& lattice, const Periods& periods) {
  int sign = in_circle_filter(a, b, c, d);
  if (sign == 0)
    sign = exact_side(a, b, c, d, lattice);
  if (sign != 0)
    return sign;
  return perturbed_side(a, b, c, d, [&](Vec2 p, Vec2 q) {
    // Images of one point: any order will do, since no triangle that counts is that large.
    return periods.same_point(p, q) ? lexicographically_less(p, q) : periods.less(p, q);
  });
}

} // namespace trime::geometry
