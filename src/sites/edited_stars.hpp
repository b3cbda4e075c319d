// SPDX-License-Identifier: BSD-3-Clause
// Which stars a few changes of sites may have changed, on this rank and on others: all others stay certain.
#pragma once

#include "delaunay/star_builder.hpp"
#include "mesh/binned_points.hpp"
#include "mesh/local_sizes.hpp"

#include <span>
#include <utility>
#include <vector>

namespace trime::sites {

/// A place at which a site has come, or from which one has gone.
struct ChangedPlace {
  geometry::Vec2 place;
  bool comes;
};

/// The ghosts that a rank knew, to compare them with the ghosts of the same bins that it has fetched again.
class FormerGhosts {
public:
  /// O(ghosts).
  explicit FormerGhosts(const mesh::BinnedPoints& points);

  /// @return by former ghost its local index among `points`, -1 if it has gone
  /// @param changed receives the places of ghosts that have come or gone
  std::vector<LocalIndex> find_in(const mesh::BinnedPoints& points, std::vector<ChangedPlace>& changed) const;

private:
  std::vector<std::pair<mesh::BinRef, mesh::SiteRange>> bins_; // ranges counted from the first ghost
  std::vector<geometry::Vec2> places_;
};

/// @brief Marks stars as uncertain that the changes may have changed. A star without gaps changes only if a site of its
/// ring goes, which the caller must see, or if a site enters the disc of a triangle. A star with gaps may change
/// through anything within twice its cap. O(changes log changes + sites). Uses all threads.
/// @pre h at the owned sites is known; no periods
void doubt_stars(const mesh::BinnedPoints& points, const mesh::LocalSizes& sizes, const delaunay::StarBuilder& builder,
                 std::vector<ChangedPlace> changes, delaunay::StarTable& stars);

} // namespace trime::sites
