// SPDX-License-Identifier: BSD-3-Clause
// Which patches of a round are tried: a set of places that keep their distances, the same for any partition.
#pragma once

#include "cleanup/cleanup_sites.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// A place that would like to be chosen.
struct Contender {
  geometry::Vec2 place; ///< canonical
  double separation;    ///< no other contender may be chosen within this distance
  std::uint64_t order;  ///< the lower one comes first; then the place decides
};

/// @brief Of the contenders of all ranks a set of which no two lie within the larger of their separations, as large as
/// a few passes make it (Luby 1986): in each pass a contender that is the first of its surroundings is chosen, and
/// those near it are excluded. Collective.
/// @return indices of the own ones that are chosen, ascending
std::vector<std::size_t> choose_apart(const comm::Communicator& comm, const CleanupSites& sites,
                                      const geometry::Periods& periods, std::span<const Contender> contenders);

} // namespace trime::cleanup
