// SPDX-License-Identifier: BSD-3-Clause
// The lattice of the container, with a power of two as its step, on which every
// site lies; the periods of the container; and the Frame that holds both. Parts of a shape are made in a Frame. The
// difference of two sites is an exact double: an integer below 2^45 in lattice steps. Because of this bound, the exact
// in-circle test needs a bounded number of bits.
#pragma once

#include "trime/core/sum.hpp"
#include "trime/geometry/vec2.hpp"

#include <cmath>
#include <cstdint>

namespace trime::geometry {

/// All points with coordinates that are multiples of one power of two.
class Lattice {
public:
  /// The step is the smallest power of two that is at least 2^-44 of the longer side of `container` and at least 2^-51
  /// of its largest coordinate. Then every multiple of the step inside the container is a double.
  explicit Lattice(const Box& container) {
    const double side = std::fmax(container.width(), container.height());
    const double extent = std::fmax(std::fmax(std::fabs(container.min.x), std::fabs(container.max.x)),
                                    std::fmax(std::fabs(container.min.y), std::fabs(container.max.y)));
    int exponent = 0;
    std::frexp(std::fmax(side * 0x1p-44, extent * 0x1p-51), &exponent);
    step_ = std::ldexp(1.0, exponent);
    inverse_step_ = std::ldexp(1.0, -exponent);
  }

  double step() const { return step_; }
  double inverse_step() const { return inverse_step_; }
  /// Returns the nearest lattice point, ties to even.
  Vec2 snap(Vec2 p) const { return {snap(p.x), snap(p.y)}; }
  double snap(double v) const {
    const double steps = v * inverse_step_;
    return (std::fabs(steps) <= 0x1p51 ? round_to_integer(steps) : std::nearbyint(steps)) * step_;
  }
  /// Returns a difference of two lattice coordinates in lattice steps; exact.
  std::int64_t steps(double difference) const { return static_cast<std::int64_t>(difference * inverse_step_); }

private:
  double step_, inverse_step_;
};

/// @brief The periods of a container. The images of a point are the point shifted by multiples of (x, 0) and (0, y); a
/// period of 0 means "not periodic". The canonical image of a point lies in [min.x, min.x + x) x [min.y, min.y + y)
/// along the periodic axes. `min` and the periods are lattice multiples, so every shift of a lattice point is exact.
struct Periods {
  double x = 0, y = 0;
  Vec2 min;

  /// Returns the periods of a container: its sides rounded to the lattice. `min` is the first lattice point in the
  /// container.
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
  /// Compares the canonical images lexicographically. The program breaks all ties by this order, which is the same for
  /// all periodic images of a point.
  bool less(Vec2 a, Vec2 b) const { return lexicographically_less(wrap(a), wrap(b)); }

private:
  static double wrap(double v, double low, double period) {
    if (period == 0 || (v >= low && v < low + period))
      return v;
    const double shifted = v - period * std::floor((v - low) / period);
    return shifted < low ? shifted + period : shifted >= low + period ? shifted - period : shifted;
  }
};

/// The default container of a shape that fits into it.
inline constexpr Box unit_square{{0, 0}, {1, 1}};

/// @brief Returns the default container of a shape: the unit square if it contains `box` or `box` has no area,
/// otherwise `box` with a margin of 5 % of its longer side on all sides.
/// @param box the box around the shape: Region::box of the boxes of its parts. A part without a box (the `domain`, a
/// function, a normalised contour) counts as the unit square.
Box container_around(const Box& box);

/// The container with its coordinate lattice and its periods. Immutable; cheap to copy.
class Frame {
public:
  /// @throws GeometryError if the width or the height of `container` is not positive and finite
  explicit Frame(const Box& container, bool periodic_x = false, bool periodic_y = false);

  const Box& container() const { return container_; }
  const Lattice& lattice() const { return lattice_; }
  double step() const { return lattice_.step(); }
  /// The periods; zero unless the container is periodic.
  const Periods& periods() const { return periods_; }

  /// The largest lattice rectangle inside the container; its sides along periodic axes are exactly one period long. The
  /// shape `domain` is this rectangle.
  const Box& inner() const { return inner_; }
  /// The container extended by twice its size on all sides. The exact predicates are valid in this box, so parts of a
  /// shape may reach into it.
  const Box& reach() const { return reach_; }

  /// Returns the nearest lattice point. If rounding moves it out of the container, returns a point on the edge of
  /// inner() instead.
  Vec2 snap(Vec2 p) const { return {snap(p.x, inner_.min.x, inner_.max.x), snap(p.y, inner_.min.y, inner_.max.y)}; }

private:
  double snap(double v, double low, double high) const {
    const double near = lattice_.snap(v);
    return near < low && near >= low - step() ? low : near > high && near <= high + step() ? high : near;
  }

  Box container_;
  Lattice lattice_;
  Periods periods_;
  Box inner_, reach_;
};

} // namespace trime::geometry
