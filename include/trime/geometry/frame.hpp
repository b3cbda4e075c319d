// SPDX-License-Identifier: BSD-3-Clause
// The container rectangle with its lattice and periods. Parts of a shape are made in a Frame.
#pragma once

#include "trime/geometry/lattice.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::geometry {

/// The container of a shape that fits into it, where the user gives none.
inline constexpr Box unit_square{{0, 0}, {1, 1}};

/// @brief The container of a shape where the user gives none: the unit square if it contains `box` or `box` has no
/// area, else `box` with a margin of 5 % of its longer side all around.
/// @param box around the shape: Region::box of the boxes of its parts. A part without a box of its own counts as the
/// unit square: the `domain`, a function, a contour that is normalised.
Box container_around(const Box& box);

/// The container with its lattice and periods. Immutable; cheap to copy.
class Frame {
public:
  /// @throws GeometryError if the width or the height of `container` is not positive and finite
  explicit Frame(const Box& container, bool periodic_x = false, bool periodic_y = false);

  const Box& container() const { return container_; }
  const Lattice& lattice() const { return lattice_; }
  double step() const { return lattice_.step(); }
  /// The periods; none by default.
  const Periods& periods() const { return periods_; }

  /// The largest lattice rectangle inside the container; exactly one period long on periodic axes. It is the shape
  /// `domain`.
  const Box& inner() const { return inner_; }
  /// The container and twice its size around it. The exact predicates are valid here, so parts may lie here.
  const Box& reach() const { return reach_; }

  /// Returns the nearest lattice point. If rounding moves it out of the container, returns a point on the edge of
  /// inner().
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
