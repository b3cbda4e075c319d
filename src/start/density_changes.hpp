// SPDX-License-Identifier: BSD-3-Clause
// Finds which sites of an old mesh must go, and where sites are missing, so that their density becomes that of a size.
#pragma once

#include "sites/stage.hpp"

#include <cstdint>
#include <vector>

namespace trime::start {

/// Which inner sites go and which come.
struct DensityChanges {
  std::vector<LocalIndex> gone; ///< owned sites that are left out, ascending
  mesh::SiteList come;          ///< a share of the new sites on each rank; they may belong to other ranks
  std::int64_t removed = 0;     ///< number of sites that are left out, over all ranks
  std::int64_t inserted = 0;    ///< number of new sites, over all ranks
  bool is_finished = true;      ///< false if the density is still far from the wanted one at some places
};

/// @brief Finds inner sites that are too many, and places for new ones in large triangles. One call
/// changes the density by a factor of four at most. Each tile is walked along the Hilbert curve. The share of a site is
/// the area of its triangles over that of equilateral triangles with the edge h. A site is taken out where the sum of
/// the shares falls behind the number of sites, and a site is put in where the sum is ahead. Collective.
/// @param next stage with size and boundary of the new sites; may be the stage of the view
/// @param wanted number of inner sites over all ranks that corresponds to the size
/// @throws GeometryError on all ranks together if a size is not positive and finite
/// @pre all stars are certain
DensityChanges changes_for_density(const sites::StageView& view, const sites::Stage& next, double wanted);

/// Returns a share of the inner sites after the changes on each rank; they may belong to other ranks.
mesh::SiteList sites_after(const sites::SiteState& state, const DensityChanges& changes);

/// @brief Makes the changes in place, so that the stars far from them stay certain. Collective.
/// @param builder the builder that made the stars
/// @throws GeometryError on all ranks together if the size at a new site is not positive and finite
/// @pre all stars are certain, and sites have not moved since they were sorted
void edit_for_density(sites::Stage& stage, DensityChanges changes, const delaunay::StarBuilder& builder);

} // namespace trime::start
