// SPDX-License-Identifier: BSD-3-Clause
// Hexagonal lattices in rows, which are regular or slightly stretched to fit the periods of a container.
#pragma once

#include "core/angle.hpp"
#include "trime/geometry/periods.hpp"

#include <cstdint>

namespace trime::placing {

/// @brief A lattice of rows. Site i of row j lies at origin + (i + shift(j)) * spacing along the rows and j * height
/// across them.
///
/// With `columns` or `rows` > 0 the lattice repeats itself after that number; the caller then wraps sites.
struct RowLattice {
  geometry::Vec2 origin, along{1, 0};
  double spacing = 1, height = row_height;
  std::int64_t columns = 0, rows = 0;
  std::int64_t skew = 0; ///< number of spacings by which all rows together shift

  /// Returns the shift of a row in spacings, 0 <= shift < 1. If the rows do not repeat, every second row is shifted by
  /// a half.
  double shift(std::int64_t row) const {
    return rows == 0 ? 0.5 * static_cast<double>(row & 1)
                     : static_cast<double>(row * skew % rows) / static_cast<double>(rows);
  }
};

/// @brief Returns the lattice with about one site per two equilateral triangles of side `spacing`, and rows along the
/// axis `along`.
///
/// If both axes are periodic, the numbers of columns and rows give at most as many sites as asked for, almost as many,
/// and almost equilateral triangles: 2 % of stretch count like 0.2 % of missing sites. An odd number of rows needs a
/// small shear. With one period, the columns fit the period and the rows keep the density. If no site fits, spacing is
/// 0. O(sqrt(sites)).
RowLattice fit_to_periods(const geometry::Periods& periods, double spacing, geometry::Vec2 along);

/// Returns the better of the fits with rows along x and along y. @pre both axes are periodic
RowLattice fit_to_periods(const geometry::Periods& periods, double spacing);

} // namespace trime::placing
