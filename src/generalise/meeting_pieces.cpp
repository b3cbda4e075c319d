// SPDX-License-Identifier: BSD-3-Clause
#include "generalise/meeting_pieces.hpp"

#include "geometry/predicates.hpp"

#include <cmath>
#include <utility>

namespace trime::generalise {
namespace {

using geometry::orient2d;
using geometry::Vec2;

// [radians] Pieces of circles are compared with chords that turn by less than this.
constexpr double chord_turn = 0.05;

/// Do two segments share more than one common end? Exact.
bool meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (b == c || b == d)
    std::swap(a, b);
  if (a == d)
    std::swap(c, d);
  if (a == c)
    return b == d || (orient2d(a, b, d) == 0 && dot(b - a, d - a) > 0);
  const int at_c = orient2d(a, b, c), at_d = orient2d(a, b, d), at_a = orient2d(c, d, a), at_b = orient2d(c, d, b);
  if (at_c != 0 || at_d != 0)
    return at_c * at_d <= 0 && at_a * at_b <= 0;
  const auto overlap = [](double p, double q, double r, double s) {
    return std::fmax(p, q) >= std::fmin(r, s) && std::fmax(r, s) >= std::fmin(p, q);
  };
  return overlap(a.x, b.x, c.x, d.x) && overlap(a.y, b.y, c.y, d.y);
}

} // namespace

bool meet(const geometry::Piece& straight, const geometry::Piece& other) {
  const int parts = other.circular ? 1 + static_cast<int>(std::fabs(other.sweep) / chord_turn) : 1;
  const double whole = other.length();
  Vec2 from = other.start;
  for (int part = 1; part <= parts; ++part) {
    const Vec2 to = part == parts ? other.end : other.point(whole * part / parts);
    if (meet(straight.start, straight.end, from, to))
      return true;
    from = to;
  }
  return false;
}

} // namespace trime::generalise
