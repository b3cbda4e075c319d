// SPDX-License-Identifier: BSD-3-Clause
// Helps tests that move all sites of a state at once.
#pragma once

#include "sites/site_state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::testing {

/// Moves owned site i to the position of sites[i], or removes it if deleted[i] is set. Further elements of `sites` are
/// new sites. Collective.
/// @pre except for their positions, the elements equal the owned sites
inline void move_sites(sites::SiteState& state, std::span<const mesh::Site> sites,
                       std::span<const std::uint8_t> deleted) {
  const std::size_t owned = static_cast<std::size_t>(state.points().owned());
  prepare_to_stay(state.points());
  for (std::size_t i = 0; i < owned; ++i)
    state.points().next().positions()[i] = sites[i].position;
  mesh::SiteList more;
  for (std::size_t i = owned; i < sites.size(); ++i)
    if (!deleted[i])
      more.push_back(sites[i]);
  state.move_sites({deleted.begin(), deleted.begin() + static_cast<std::ptrdiff_t>(owned)}, more);
}

} // namespace trime::testing
