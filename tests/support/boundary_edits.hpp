// SPDX-License-Identifier: BSD-3-Clause
// Applies edits to boundary sites with a BoundaryChain, and returns the result.
#pragma once

#include "polygon/boundary_chain.hpp"

#include <vector>

namespace trime::testing {

struct EditedBoundary {
  polygon::BoundarySites sites; ///< the sites after the edits, numbered along the loops
  std::vector<LocalIndex>
      new_index; ///< new index of each old site, then of each new site in the order of BoundaryChain
};
inline EditedBoundary edited(const polygon::BoundarySites& sites, const polygon::BoundaryCurve& curve,
                             const std::vector<polygon::BoundaryEdit>& edits) {
  polygon::BoundaryChain chain(sites, curve);
  chain.apply(edits);
  std::vector<LocalIndex> new_index = chain.renumber();
  return {chain.sites(), std::move(new_index)};
}

/// Returns the loop of a site.
/// @pre sites are numbered along the loops
inline LocalIndex loop_of(const polygon::BoundarySites& sites, LocalIndex site) {
  LocalIndex loop = 0;
  while (sites.loop_start[static_cast<std::size_t>(loop) + 1] <= site)
    ++loop;
  return loop;
}

} // namespace trime::testing
