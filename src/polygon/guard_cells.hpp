// SPDX-License-Identifier: BSD-3-Clause
// The cells of the guard as plain arrays, for vectorised loops that look for clear cells themselves.
#pragma once

#include "trime/geometry/vec2.hpp"

#include <cstdint>

namespace trime::polygon {

/// Rows of `columns` cells, beginning at `corner`. The pointer points into the guard.
struct GuardCells {
  /// A point in a cell with a positive state needs no push. Null if there are no sites, when no point needs one.
  const std::int8_t* states = nullptr;
  geometry::Vec2 corner;
  double inverse_side = 1;
  int columns = 0, rows = 0;
};

} // namespace trime::polygon
