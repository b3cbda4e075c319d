// SPDX-License-Identifier: BSD-3-Clause
// Where the inner sites start. Each rank makes the sites of its own tiles; the set does not depend on the ranks.
#pragma once

#include "mesh/binned_points.hpp"
#include "mesh/tile_range.hpp"
#include "polygon/boundary_guard.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace trime::start {

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
  /// The same of each tile.
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

  /// Sites inside the shape at least 0.45 spacings away from its boundary, by tile, row and column. Threads.
  LatticeRuns runs(const mesh::TileRange& tiles, double spacing) const;
  /// @brief Makes them. Threads.
  /// @param more room for so many sites is left, that will be added
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

/// @brief Quantiles of the integral of h^-2 along the Hilbert curve, outside a strip of 0.43 h along the boundary: site
/// j sits where the integral passes (j + 1/2) / n of its total. Weights are integers, so the sites are the same on any
/// ranks; the count error in any interval of the curve is at most one, so long waves start quiet.
class HilbertStart {
public:
  /// @brief Takes the integral. Collective (one scan). @pre the other arguments outlive this object
  /// @param expected about so many sites will be asked for: of few, the cells of the integral are kept for them
  /// @param coarsening of the integral's cells, which else take a quarter of a site, and less near the boundary
  HilbertStart(const comm::Communicator& comm, const mesh::TileRange& tiles, const polygon::BoundaryGuard& guard,
               const sizing::SizeField& size, const geometry::Lattice& lattice, double expected, double coarsening = 1);
  ~HilbertStart();

  /// So many sites the size asks for, over all ranks.
  double wanted() const;
  /// The sites of this rank. Collective.
  /// @param n number of sites over all ranks
  mesh::SiteList sites(std::int64_t n, std::uint64_t seed) const;

private:
  class Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

} // namespace trime::start
