// SPDX-License-Identifier: BSD-3-Clause
// Makes inner sites on a hexagonal lattice. Each rank makes the sites of its tiles. The set of sites does not depend on
// the ranks.
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

struct RowLattice;

/// Consecutive sites of one row of a lattice in one tile: those of the columns first to last.
struct LatticeRun {
  std::int64_t row, first, last;
};

/// @brief The lattice sites of some tiles, before they are made. A run is a row of a tile, or a part of a row near the
/// boundary, and takes 24 bytes.
struct LatticeRuns {
  double spacing = 0;
  std::vector<std::vector<LatticeRun>> of_tile;

  /// Returns the number of sites.
  std::int64_t count() const;
  /// Returns the number of sites of each tile.
  std::vector<std::int64_t> counts() const;
};

/// @brief A hexagonal lattice of a given spacing whose rows run along the longest straight side of the boundary; the
/// first row is one row height away from it. Without a straight side, rows run along an axis.
///
/// In a periodic container, rows run along a periodic axis, and the lattice is slightly stretched to fit the periods;
/// see fit_to_periods.
class LatticeStart {
public:
  LatticeStart(const geometry::Boundary& boundary, const polygon::BoundaryGuard& guard,
               const geometry::Lattice& lattice);

  /// Returns the sites inside the shape at least PlacingRules::lattice_strip spacings away from its boundary, by tile,
  /// row and column, by all threads.
  LatticeRuns runs(const mesh::TileRange& tiles, double spacing) const;
  /// @brief Makes the sites of the runs, by all threads.
  /// @param more number of sites that will be added later, for which room is reserved
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
  /// If true, along_ is the direction of a straight side; in a periodic container, of a side along an axis.
  bool has_side_ = false;
  geometry::Vec2 origin_, along_;
};

} // namespace trime::placing
