// SPDX-License-Identifier: BSD-3-Clause
// Computes certified Delaunay stars. Each star is computed exactly and independently from the known sites around it, so
// stars of different threads and ranks agree without communication. This file does not use ranks: it reports which bins
// are needed but not known.
#pragma once

#include "delaunay/star_table.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/site.hpp"
#include "trime/geometry/lattice.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace trime::delaunay {

/// Says how a pass treats the star of a site: empty its ring of neighbours (none), compute it, or leave it unchanged.
enum class StarWish : std::uint8_t { none, compute, leave };

/// Counts of the stars in one pass.
struct StarPass {
  std::int64_t computed = 0;  ///< stars that were computed
  std::int64_t rebuilt = 0;   ///< computed stars whose neighbours have changed
  std::int64_t uncertain = 0; ///< stars that need a bin that is not known
  /// Stars, of those computed one by one, at whose place another site lies. Such a star is that of a single site, so
  /// its neighbours have only one of the two in their stars.
  std::int64_t coincident = 0;
};

/// A site whose star must be examined again, because the star of its neighbour `cause` has changed.
struct AffectedStar {
  LocalIndex site, cause;
};

/// @brief The star of a site p is its Voronoi cell, stored as the ring of Delaunay neighbours with the circumcentres
/// between them. The computation starts from the last ring, or from a square of half-width cap around p (four virtual
/// neighbours at the distance 2 cap). Then every site within the security radius 2 R_max cuts the cell (Rycroft 2009
/// for the cell; Shewchuk 2005 for stars that agree). All decisions are exact: a floating-point test with an error
/// bound, then geometry::in_circle with its symbolic tie rule. Most stars are found by a faster method, up to sixteen
/// at a time, with a proof that they are identical.
///
/// Only triangles with a circumradius below the cap count. Only sites within 2 cap can change them, so the search is
/// bounded. Other triangles become gaps of the ring.
///
/// The cap of a star follows the local size, so that search regions and halos stay small where the size varies. A
/// triangle near the cap may then count in one of its stars and not in another. That does no harm: each triangle that
/// counts belongs to the unique Delaunay triangulation, and the mesher raises the caps of sites that have gaps inside
/// the shape. When no site has such a gap, all stars hold the same triangles.
class StarBuilder {
public:
  /// @param cap largest circumradius that counts, in domain units; the same for all stars
  StarBuilder(const geometry::Lattice& lattice, double cap)
      : StarBuilder(lattice, std::numeric_limits<double>::infinity(), cap) {}
  /// @param factor the cap of a star is this factor times the size at its site
  /// @param largest upper bound on the cap, in domain units
  StarBuilder(const geometry::Lattice& lattice, double factor, double largest)
      : lattice_(lattice), factor_(factor), largest_(largest) {}

  /// Returns the largest circumradius that counts at a site with target edge length h.
  double cap(double h = std::numeric_limits<double>::infinity()) const { return std::min(largest_, factor_ * h); }

  /// Returns the cap of a star divided by the size at its site.
  double cap_factor() const { return factor_; }

  /// @brief Returns slightly less than a quarter of the shorter period; infinity if the container is not periodic. No
  /// cap is larger, so edges are shorter than half a period. Then the neighbour at the other end of an edge is the
  /// nearest periodic image of its point, and the vertex ids of a triangle identify it uniquely.
  static double largest_cap(const geometry::Periods& periods);

  /// @brief Computes the star of every owned site that is wanted and not yet certain, from its last ring if it has one.
  /// Threads work on different tiles.
  ///
  /// If many stars of a tile are wanted, most are found together, with or without a last ring. A star then takes 120 ns
  /// in a relaxed mesh and 270 ns in a random one (AVX-512; 160 and 400 ns with AVX2, 200 and 510 ns without). The
  /// other stars are found one by one: in 120 ns from a ring that is still correct, in 500 to 2000 ns from scratch.
  /// @param sizes target edge length h of the owned sites; empty: the largest cap for all sites
  /// @param wanted the action for each site, by local index; empty: all stars are computed
  /// @param missing receives the bins that uncertain stars need, ascending, each once
  StarPass update(const mesh::BinnedPoints& points, StarTable& stars, const mesh::LocalSizes& sizes,
                  std::span<const StarWish> wanted, std::vector<mesh::BinRef>& missing) const;

  /// @brief Computes the stars of these owned sites, even if they are certain. Each site occurs once in the list. Uses
  /// all threads.
  /// @param affected receives the owned sites and ghosts next to stars that this call has changed; a site may occur
  /// several times
  /// @param missing receives the bins that uncertain stars need, as in update
  StarPass certify(const mesh::BinnedPoints& points, StarTable& stars, const mesh::LocalSizes& sizes,
                   std::span<const LocalIndex> sites, std::vector<AffectedStar>& affected,
                   std::vector<mesh::BinRef>& missing) const;

  /// @brief Returns whether the triangle a, b, c (in any order) counts, that is, whether its circumradius is below
  /// `cap`. The circumradius is computed in canonical order of the vertices, so stars with the same cap agree.
  static bool counts(geometry::Vec2 a, geometry::Vec2 b, geometry::Vec2 c, double cap,
                     const geometry::Periods& periods = {});

private:
  double cap_at(const mesh::LocalSizes& sizes, LocalIndex i, double limit) const {
    return std::min(limit, sizes.known(i) ? cap(sizes[i]) : largest_);
  }

  geometry::Lattice lattice_;
  double factor_, largest_;
};

} // namespace trime::delaunay
