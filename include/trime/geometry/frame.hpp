// SPDX-License-Identifier: BSD-3-Clause
// The container rectangle and its lattice: all that the parts of a shape need to know of the world around them.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// Immutable; cheap to copy.
class Frame {
public:
  /// @pre width and height of `container` are positive and finite
  explicit Frame(const Box& container, bool periodic_x = false, bool periodic_y = false);

  const Box& container() const { return container_; }
  const Lattice& lattice() const { return lattice_; }
  double step() const { return lattice_.step(); }
  /// Which points of the plane are one point; no periods by default.
  const Periods& periods() const { return periods_; }

  /// Largest lattice rectangle inside the container; exactly one period long on periodic axes. The shape `domain`.
  const Box& inner() const { return inner_; }
  /// The container and twice its size around it: where the exact predicates hold, so where parts may lie.
  const Box& reach() const { return reach_; }

  /// Nearest lattice point; one that rounding carried out of the container comes back onto its inner rectangle.
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
