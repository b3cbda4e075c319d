// SPDX-License-Identifier: BSD-3-Clause
// Interpolates between the values of a raster.
#pragma once

#include "fields/raster.hpp"
#include "trime/geometry/vec2.hpp"

namespace trime::fields {

/// @brief The bilinear function of the values at the centres of the cells. Outside of all centres it has the value of
/// the nearest place between them. Where a value was filled, only the others count, in proportion to their weights; the
/// filled value counts if there is no other one. Thread-safe.
class Field {
public:
  /// @pre the raster has a value for each cell, none of them NaN
  /// @param period of x; 0: none @param middle places are looked up in the period around this coordinate
  Field(Raster raster, double period, double middle);

  /// Returns the value at a place in the coordinates of the raster.
  double value(geometry::Vec2 p) const;
  /// Returns the gradient of the bilinear function, per unit of the coordinates of the raster; filled values count.
  /// Across an axis it is 0 outside of all centres.
  geometry::Vec2 gradient(geometry::Vec2 p) const;
  const Raster& raster() const { return raster_; }

private:
  Raster raster_;
  double period_, middle_;
};

} // namespace trime::fields
