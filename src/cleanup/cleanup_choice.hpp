// SPDX-License-Identifier: BSD-3-Clause
// Chooses the patches that are tried in a round: places that are far enough apart. The choice is the same for any
// partition.
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
  std::uint64_t order;  ///< the lower number comes first; the place decides between equal numbers
};

/// A contender that was chosen, by its number among those of its rank.
struct ChosenContender {
  Contender contender;
  std::int32_t rank, number;
};

/// The result of a choice on one rank.
struct Choice {
  std::vector<ChosenContender> own; ///< by number
  std::vector<ChosenContender>
      near; ///< contenders of other ranks whose separation reaches tiles of this one; by rank and number
  std::vector<int>
      partners; ///< ranks from which `near` comes, and ranks whose tiles `own` reaches; the relation is symmetric
  bool is_whole =
      true; ///< false if a contender of this rank reaches a rank that is not a neighbour; then the choice is invalid
};

/// @brief Chooses contenders of all ranks so that no two of them are within the larger of their separations (Luby
/// 1986). In each of a few passes, a contender is chosen if it comes before all others around it, and those near it are
/// excluded. All ranks take part; each exchanges one message with its neighbours, and more only where contenders reach
/// tiles of other ranks.
Choice choose_apart(const comm::Communicator& comm, const comm::Neighbours& neighbours, const CleanupSites& sites,
                    const geometry::Periods& periods, std::span<const Contender> contenders);

} // namespace trime::cleanup
