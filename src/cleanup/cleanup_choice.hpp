// SPDX-License-Identifier: BSD-3-Clause
// Which patches of a round are tried: a set of places that keep their distances, the same for any partition.
#pragma once

#include "cleanup/cleanup_sites.hpp"
#include "comm/neighbours.hpp"

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

/// A contender that was chosen, by its number among those of its rank.
struct ChosenContender {
  Contender contender;
  std::int32_t rank, number;
};

/// The knowledge of a rank about a choice.
struct Choice {
  std::vector<ChosenContender> own;  ///< by number
  std::vector<ChosenContender> near; ///< of other ranks, whose separation reaches to tiles of this one; by rank, number
  std::vector<int> partners; ///< ranks that `near` comes from or `own` reaches to: they are each other's partners
  bool is_whole =
      true; ///< false: an own contender reaches to a rank that is no neighbour, and the choice is worth nothing
};

/// @brief Chooses a set of contenders of all ranks, with no two of them within the larger of their separations, as
/// large as a few passes make it (Luby 1986). In each pass a contender that is the first of its surroundings is chosen,
/// and those near it are excluded. All ranks take part; each exchanges one message with its neighbours, and more only
/// where contenders reach to each other's tiles.
Choice choose_apart(const comm::Communicator& comm, const comm::Neighbours& neighbours, const CleanupSites& sites,
                    const geometry::Periods& periods, std::span<const Contender> contenders);

} // namespace trime::cleanup
