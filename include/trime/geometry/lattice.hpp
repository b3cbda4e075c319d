// SPDX-License-Identifier: BSD-3-Clause
// The power-of-two lattice of the container on which every site lies. Differences of sites are then exact doubles:
// integers below 2^45 in lattice steps. So an exact in-circle test has a bounded size.
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
  /// of its largest coordinate. Then every multiple of it inside the container is a double.
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

} // namespace trime::geometry
