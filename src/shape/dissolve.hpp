// SPDX-License-Identifier: BSD-3-Clause
// Unites polygons of one map that share borders, overlap or lie in each other.
#pragma once

#include "shape/lattice_rings.hpp"
#include "trime/geometry/lattice.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace trime::shape {

/// The outline of united polygons, with the numbers for the report.
struct Dissolved {
  std::vector<LatticeRing> rings; ///< may touch themselves or each other at vertices
  std::size_t polygons = 0;       ///< number of united polygons
  double shared_length = 0;       ///< length of the borders that two or more polygons share
  double overlap = 0;             ///< sum of the areas of the polygons minus the area of their union
  /// A line of each polygon that lies inside of others, so that nothing of it remains; ascending.
  std::vector<int> covered{};
  std::size_t gaps = 0; ///< number of narrow gaps between polygons that were closed
  double gap_area = 0;  ///< sum of their areas
};

/// How polygons are united, and how messages name the file and places in it.
struct DissolveOptions {
  std::string source; ///< name of the file, for messages
  /// Gaps that two or more polygons enclose are closed if their mean width is smaller: maps whose polygons were
  /// digitised one by one have thousands of them.
  double widest_gap = 0;
  std::function<std::string(geometry::Vec2)> in_file; ///< names a place for the user
};

/// @brief Returns the rings around the union of polygons. The rings of one polygon have the same number
/// (LatticeRing::polygon); within it a ring inside an odd number of other rings is a hole. Each edge keeps line and
/// marker of the edge from which it comes. A gap with an island inside stays.
///
/// Cost: O(M log M) for M vertices of any number of polygons, if few of them overlap at one place.
/// @throws GeometryError where borders are nearer to each other than some steps of the lattice, but not equal
Dissolved dissolve(const std::vector<LatticeRing>& rings, const geometry::Frame& frame, const DissolveOptions& options);

} // namespace trime::shape
