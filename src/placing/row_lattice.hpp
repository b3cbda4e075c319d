// SPDX-License-Identifier: BSD-3-Clause
// Hexagonal lattices in rows, regular in the plane or stretched a little to fit the periods of a container.
#pragma once

#include "core/angle.hpp"
#include "trime/geometry/lattice.hpp"

#include <cstdint>

namespace trime::placing {

/// @brief Site i of row j lies at origin + (i + shift(j)) * spacing along the rows and j * height across them.
///
/// With `columns` or `rows` > 0 the lattice repeats itself after that number; the caller then wraps sites.
struct RowLattice {
  geometry::Vec2 origin, along{1, 0};
  double spacing = 1, height = row_height;
  std::int64_t columns = 0, rows = 0;
  std::int64_t skew = 0; ///< number of spacings by which all rows together shift

  /// Shift of a row in spacings, 0 <= shift < 1; every other row by a half if the rows do not repeat themselves.
  double shift(std::int64_t row) const {
    return rows == 0 ? 0.5 * static_cast<double>(row & 1)
                     : static_cast<double>(row * skew % rows) / static_cast<double>(rows);
  }
};

/// @brief The lattice of about one site per equilateral triangle pair of side `spacing`, rows along `along` (an axis).
///
/// Where both axes are periodic, columns and rows are the pair with at most as many sites as asked for, nearly as many
/// and nearly equilateral: 2 % of stretch count like 0.2 % of missing sites. An odd number of rows takes a little
/// shear. With one period the columns fit and the rows keep the density. If not even one site fits, spacing is 0.
/// O(sqrt(sites)).
RowLattice fit_to_periods(const geometry::Periods& periods, double spacing, geometry::Vec2 along);

/// The better of the fits with rows along x and along y; both axes must be periodic.
RowLattice fit_to_periods(const geometry::Periods& periods, double spacing);

} // namespace trime::placing
