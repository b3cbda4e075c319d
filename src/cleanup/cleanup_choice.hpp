// SPDX-License-Identifier: BSD-3-Clause
// Chooses the patches that are tried in a round, so that they are far enough from each other. The choice is the same
// for any partition.
#pragma once

#include "cleanup/cleanup_sites.hpp"
#include "comm/neighbours.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::cleanup {

/// A place that may become the middle of a patch.
struct Contender {
  geometry::Vec2 place; ///< place inside the container, not its periodic image
  double separation;    ///< within this distance of a chosen contender no other one may be chosen
  std::uint64_t order;  ///< rank in the order of choice: the lowest number comes first; the coordinates decide between
                        ///< equal numbers
};

/// A contender that was chosen, with its rank and its number among the contenders of that rank.
struct ChosenContender {
  Contender contender;
  std::int32_t rank, number;
};

/// The result of a choice on one rank.
struct Choice {
  std::vector<ChosenContender> own; ///< chosen contenders of this rank, by number
  std::vector<ChosenContender>
      near; ///< chosen contenders of other ranks whose separation reaches tiles of this rank; by rank and number
  std::vector<int> partners; ///< ranks that own a contender in `near`, and ranks whose tiles a contender in `own`
                             ///< reaches; if rank a is a partner of rank b, then b is a partner of a
  bool is_whole = true; ///< false if a contender of this rank reaches tiles of a rank that is not a neighbour; then the
                        ///< choice is invalid
};

/// @brief Chooses contenders of all ranks so that no two of them are closer together than the larger of their
/// separations (Luby 1986). In each of a few passes, a contender is chosen if it comes before all others around it, and
/// those near it are excluded. All ranks take part; each rank exchanges one message with its neighbours, and further
/// messages only if contenders reach tiles of other ranks.
Choice choose_apart(const comm::Communicator& comm, const comm::Neighbours& neighbours, const CleanupSites& sites,
                    const geometry::Periods& periods, std::span<const Contender> contenders);

} // namespace trime::cleanup
