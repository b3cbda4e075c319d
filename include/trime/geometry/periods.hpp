// SPDX-License-Identifier: BSD-3-Clause
// The periods of a container, and the images of a point in a periodic strip or torus. Exact on the lattice.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>

namespace trime::geometry {

/// @brief The images of a point are the point shifted by multiples of (x, 0) and (0, y); 0 means "not periodic". The
/// canonical image of a point lies in [min.x, min.x + x) x [min.y, min.y + y) along the periodic axes. `min` and the
/// periods are lattice multiples, so every shift of a lattice point is exact.
struct Periods {
  double x = 0, y = 0;
  Vec2 min;

  /// Returns the periods of a container: its sides rounded to the lattice, from its first lattice point on.
  static Periods of(const Box& container, const Lattice& lattice, bool periodic_x, bool periodic_y) {
    const double inverse = lattice.inverse_step();
    return {periodic_x ? lattice.snap(container.width()) : 0, periodic_y ? lattice.snap(container.height()) : 0,
            lattice.step() * Vec2{std::ceil(container.min.x * inverse), std::ceil(container.min.y * inverse)}};
  }

  bool any() const { return x > 0 || y > 0; }

  /// Returns the canonical image of p.
  Vec2 wrap(Vec2 p) const { return {wrap(p.x, min.x, x), wrap(p.y, min.y, y)}; }
  /// Returns the image of p nearest to `center`: the difference lies in [-period/2, period/2) along each periodic axis.
  Vec2 nearest_image(Vec2 p, Vec2 center) const {
    return {wrap(p.x, center.x - 0.5 * x, x), wrap(p.y, center.y - 0.5 * y, y)};
  }
  /// Returns whether a and b are images of the same point.
  bool same_point(Vec2 a, Vec2 b) const { return wrap(a) == wrap(b); }
  /// Compares the canonical images lexicographically. This order breaks all ties, and is the same for all images of a
  /// point.
  bool less(Vec2 a, Vec2 b) const { return lexicographically_less(wrap(a), wrap(b)); }

private:
  static double wrap(double v, double low, double period) {
    if (period == 0 || (v >= low && v < low + period))
      return v;
    const double shifted = v - period * std::floor((v - low) / period);
    return shifted < low ? shifted + period : shifted >= low + period ? shifted - period : shifted;
  }
};

} // namespace trime::geometry
