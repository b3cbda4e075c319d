// SPDX-License-Identifier: BSD-3-Clause
// Places inner sites on a hexagonal lattice. Each rank makes the sites of its tiles. The set of all sites does not
// depend on the number of ranks.
#pragma once

#include "core/angle.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/tile_grid.hpp"
#include "placing/lowered_zones.hpp"
#include "polygon/boundary_guard.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"

#include <cstdint>
#include <vector>

namespace trime::placing {

/// @brief A lattice of parallel rows. Site i of row j lies at origin + (i + shift(j)) * spacing along the rows and j *
/// height across them.
///
/// If `columns` or `rows` is positive, the lattice repeats itself after that number; then the caller must wrap the
/// sites into the container.
struct RowLattice {
  geometry::Vec2 origin, along{1, 0};
  double spacing = 1, height = row_height;
  std::int64_t columns = 0, rows = 0;
  std::int64_t skew = 0; ///< number of spacings by which the rows are shifted after all rows

  /// Returns the shift of a row in spacings, 0 <= shift < 1. If the rows do not repeat, every second row is shifted by
  /// half a spacing.
  double shift(std::int64_t row) const {
    return rows == 0 ? 0.5 * static_cast<double>(row & 1)
                     : static_cast<double>(row * skew % rows) / static_cast<double>(rows);
  }
};

/// @brief Returns the lattice that has about one site per two equilateral triangles of side `spacing`, with rows along
/// the axis `along`, and fits the periods.
///
/// If both axes are periodic, the numbers of columns and rows are chosen so that there are almost as many sites as
/// requested, but not more, and triangles are almost equilateral. In this choice, 2 % of stretch counts as much as 0.2
/// % of missing sites. An odd number of rows needs a small shear. If one axis is periodic, the columns fit its period
/// and the distance of the rows keeps the density. If no site fits, spacing is 0. Cost: O(sqrt(sites)).
RowLattice fit_to_periods(const geometry::Periods& periods, double spacing, geometry::Vec2 along);

/// Returns the better of two lattices, with rows along x or along y.
/// @pre both axes are periodic
RowLattice fit_to_periods(const geometry::Periods& periods, double spacing);

struct RowLattice;

/// Consecutive sites of one row of the lattice in one tile, from column `first` to column `last`.
struct LatticeRun {
  std::int64_t row, first, last;
};

/// @brief The lattice sites of some tiles in a compact form. A run is a row of a tile, or a part of a row near the
/// boundary, and takes 24 bytes.
struct LatticeRuns {
  double spacing = 0;
  std::vector<std::vector<LatticeRun>> of_tile;

  /// Returns the number of sites.
  std::int64_t count() const;
  /// Returns the number of sites of each tile.
  std::vector<std::int64_t> counts() const;
};

/// @brief A hexagonal lattice with a given spacing. The rows of the lattice are parallel to the longest straight side
/// of the boundary; the first row is one row height away from this side. If no side is straight, rows are parallel to
/// an axis.
///
/// In a periodic container, rows are parallel to a periodic axis, and the lattice is stretched slightly to fit the
/// periods; see fit_to_periods.
class LatticeStart {
public:
  /// @param zones where no sites are placed; null: there are no such zones
  LatticeStart(const geometry::Boundary& boundary, const polygon::BoundaryGuard& guard,
               const geometry::Lattice& lattice, const LoweredZones* zones = nullptr);

  /// Returns the sites inside the shape that are at least PlacingRules::lattice_strip spacings away from its boundary,
  /// ordered by tile, row and column. Uses all threads.
  LatticeRuns runs(const mesh::TileRange& tiles, double spacing) const;
  /// @brief Makes the sites of the runs, by all threads.
  /// @param more number of sites that the caller will append; memory for them is reserved
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
  const LoweredZones* zones_;
  geometry::Lattice lattice_;
  geometry::Periods periods_;
  /// True means that along_ is the direction of a straight side; in a periodic container, of a straight side along an
  /// axis.
  bool has_side_ = false;
  geometry::Vec2 origin_, along_;
};

} // namespace trime::placing
