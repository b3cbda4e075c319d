// SPDX-License-Identifier: BSD-3-Clause
// The cells of the guard as plain numbers, for loops that look for the clear ones themselves.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>

namespace trime::polygon {

/// Rows of `columns` cells from `corner` on. Points into the guard.
struct GuardCells {
  const std::int8_t* states = nullptr; ///< a point in a cell above 0 needs no push; null without sites: nor does any
  geometry::Vec2 corner;
  double inverse_side = 1;
  int columns = 0, rows = 0;
};

} // namespace trime::polygon
