// SPDX-License-Identifier: BSD-3-Clause
// Places inner sites along the Hilbert curve. Each rank makes the sites of its tiles. The set of all sites does not
// depend on the number of ranks.
#pragma once

#include "mesh/binned_points.hpp"
#include "mesh/tile_grid.hpp"
#include "placing/lowered_zones.hpp"
#include "polygon/boundary_guard.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <memory>

namespace trime::placing {

/// @brief Places n sites along the Hilbert curve at equal shares of the integral of h^-2: site j lies where the
/// integral reaches (j + 1/2) / n of its total. A strip of 0.43 h along the boundary stays empty. Weights are integers,
/// so the sites are the same on any number of ranks. The number of sites in any interval of the curve is correct to
/// within one, so the density is also correct over long distances.
class HilbertStart {
public:
  /// @brief Computes the integral. Collective (one scan over the ranks).
  /// @pre all arguments outlive this object
  /// @param expected approximate number of sites that will be requested; if it is small, the cells of the integral are
  /// kept in memory
  /// @param coarsening factor for the width of the cells of the integral; with 1 a cell holds a quarter of a site, and
  /// less near the boundary
  /// @param zones where sites are placed; null: everywhere in the shape
  HilbertStart(const comm::Communicator& comm, const mesh::TileRange& tiles, const polygon::BoundaryGuard& guard,
               const sizing::SizeField& size, const geometry::Lattice& lattice, double expected, double coarsening = 1,
               const LoweredZones* zones = nullptr);
  ~HilbertStart();

  /// Returns the number of sites that the size field asks for, over all ranks.
  double wanted() const;
  /// Returns the sites of this rank. Collective.
  /// @param n number of sites over all ranks
  mesh::SiteList sites(std::int64_t n, std::uint64_t seed) const;

private:
  class Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

} // namespace trime::placing
