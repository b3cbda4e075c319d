// SPDX-License-Identifier: BSD-3-Clause
// Makes inner sites on a hexagonal lattice in rows, regular in the plane or stretched a little to fit the periods of a
// container. Each rank makes the sites of its tiles; the set does not depend on the ranks.
#pragma once

#include "core/angle.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/tile_grid.hpp"
#include "polygon/boundary_guard.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <cstdint>
#include <vector>

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

struct RowLattice;

/// Neighbouring sites of one row of a lattice, in one tile: those of the columns first to last.
struct LatticeRun {
  std::int64_t row, first, last;
};

/// @brief The lattice sites of some tiles, not yet made: 24 bytes a run, which is a row of a tile, or a part of one
/// near the boundary.
struct LatticeRuns {
  double spacing = 0;
  std::vector<std::vector<LatticeRun>> of_tile;

  /// Number of sites.
  std::int64_t count() const;
  /// Returns the number of sites of each tile.
  std::vector<std::int64_t> counts() const;
};

/// @brief Hexagonal lattice of a given spacing whose rows run along the longest straight side of the boundary, the
/// first row one row height from it (axis-parallel if there is no straight side).
///
/// In a periodic container its rows run along a periodic axis, and it is stretched a little to fit the periods; see
/// fit_to_periods.
class LatticeStart {
public:
  LatticeStart(const geometry::Boundary& boundary, const polygon::BoundaryGuard& guard,
               const geometry::Lattice& lattice);

  /// Returns the sites inside the shape at least PlacingRules::lattice_strip spacings away from its boundary, by tile,
  /// row and column, by all threads.
  LatticeRuns runs(const mesh::TileRange& tiles, double spacing) const;
  /// @brief Makes the sites of the runs, by all threads.
  /// @param more number of sites that will be added, and that need room
  mesh::SiteList sites(const LatticeRuns& runs, std::size_t more = 0) const;
  mesh::SiteList sites(const mesh::TileRange& tiles, double spacing) const { return sites(runs(tiles, spacing)); }

private:
  RowLattice rows_of(double spacing) const;
  bool is_clear(const mesh::TileGrid& grid, LocalIndex tile, double margin) const;
  geometry::Vec2 site(const RowLattice& rows, std::int64_t row, std::int64_t column) const;
  bool is_free(geometry::Vec2 p, double spacing) const;
  void add_row(const RowLattice& rows, LatticeRun row, double spacing, std::vector<LatticeRun>& runs) const;
  std::vector<LatticeRun> runs_in(const mesh::TileGrid& grid, LocalIndex tile, const RowLattice& rows,
                                  double spacing) const;

  const polygon::BoundaryGuard& guard_;
  geometry::Lattice lattice_;
  geometry::Periods periods_;
  bool has_side_ = false; // along_ is the direction of a straight side, in a periodic container of one along an axis
  geometry::Vec2 origin_, along_;
};

} // namespace trime::placing
