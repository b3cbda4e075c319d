// SPDX-License-Identifier: BSD-3-Clause
// Finds the stars that may have changed after a few sites were inserted and removed. All other stars stay certain.
#pragma once

#include "delaunay/star_builder.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/site.hpp"

#include <span>
#include <utility>
#include <vector>

namespace trime::sites {

/// A position at which a site was inserted (`comes`) or removed.
struct ChangedPlace {
  geometry::Vec2 place;
  bool comes;
};

/// Remembers the ghosts before a change, to compare them later with the ghosts of the same bins.
class FormerGhosts {
public:
  /// Copies the positions of the ghosts. Cost: O(ghosts).
  explicit FormerGhosts(const mesh::BinnedPoints& points);

  /// Finds the former ghosts again.
  /// @return the local index in `points` of each former ghost; -1 if it does not exist there
  /// @param changed receives the positions of new and of removed ghosts
  std::vector<LocalIndex> find_in(const mesh::BinnedPoints& points, std::vector<ChangedPlace>& changed) const;

private:
  std::vector<std::pair<mesh::BinRef, mesh::SiteRange>> bins_; // ranges of indices into places_
  std::vector<geometry::Vec2> places_;
};

/// @brief Marks all stars as uncertain that the changes may have changed. A star without gaps changes only if one of
/// its neighbours is removed, which the caller must handle, or if a site enters the circumcircle of one of its
/// triangles. A star with gaps may change if a change happens within twice its cap. Cost: O(changes log changes +
/// sites). Uses all threads.
/// @pre h at the owned sites is known; the container is not periodic
void doubt_stars(const mesh::BinnedPoints& points, const mesh::LocalSizes& sizes, const delaunay::StarBuilder& builder,
                 std::vector<ChangedPlace> changes, delaunay::StarTable& stars);

} // namespace trime::sites
