// SPDX-License-Identifier: BSD-3-Clause
// Finds the stars that a few inserted and removed sites may have changed. All other stars stay certain.
#pragma once

#include "delaunay/star_builder.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/site.hpp"

#include <span>
#include <utility>
#include <vector>

namespace trime::sites {

/// A place where a site was inserted or removed.
struct ChangedPlace {
  geometry::Vec2 place;
  bool comes;
};

/// The ghosts before a change, to be compared with the ghosts of the same bins after it.
class FormerGhosts {
public:
  /// O(ghosts).
  explicit FormerGhosts(const mesh::BinnedPoints& points);

  /// @return the local index among `points` of each former ghost, -1 if it is gone
  /// @param changed receives the places of ghosts that are new or gone
  std::vector<LocalIndex> find_in(const mesh::BinnedPoints& points, std::vector<ChangedPlace>& changed) const;

private:
  std::vector<std::pair<mesh::BinRef, mesh::SiteRange>> bins_; // ranges count from the first ghost
  std::vector<geometry::Vec2> places_;
};

/// @brief Marks as uncertain all stars that the changes may have changed. A star without gaps changes only if a site of
/// its ring is removed, which the caller must handle, or if a site enters the disc of a triangle. A star with gaps may
/// change through any change within twice its cap. O(changes log changes + sites). Uses all threads.
/// @pre h at the owned sites is known; no periods
void doubt_stars(const mesh::BinnedPoints& points, const mesh::LocalSizes& sizes, const delaunay::StarBuilder& builder,
                 std::vector<ChangedPlace> changes, delaunay::StarTable& stars);

} // namespace trime::sites
