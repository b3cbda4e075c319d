// SPDX-License-Identifier: BSD-3-Clause
// Interpolates between the values of a raster.
#pragma once

#include "fields/raster.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstddef>
#include <optional>

namespace trime::fields {

/// @brief The bilinear function of the values at the centres of the cells. Outside of all centres it has the value of
/// the nearest place between them. Where a value was filled, only the others count, in proportion to their weights; the
/// filled value counts if there is no other one. Thread-safe.
class Field {
public:
  /// @pre the raster has a value for each cell, none of them NaN
  /// @param period of x; 0: none @param middle places are looked up in the period around this coordinate
  /// @param smooth low-pass of the raster, from which gradients come; it has the same axes
  Field(Raster raster, double period, double middle, std::optional<Raster> smooth = std::nullopt);

  /// Returns the value at a place in the coordinates of the raster.
  double value(geometry::Vec2 p) const;
  /// Returns the gradient of the bilinear function of the smooth raster, if it exists, or else of the raster, per unit
  /// of the coordinates of the raster; filled values count. Across an axis it is 0 outside of all centres.
  geometry::Vec2 gradient(geometry::Vec2 p) const;
  const Raster& raster() const { return raster_; }
  std::size_t bytes() const { return raster_.bytes() + (smooth_ ? smooth_->bytes() : 0); }

private:
  Raster raster_;
  std::optional<Raster> smooth_;
  double period_, middle_;
};

} // namespace trime::fields
