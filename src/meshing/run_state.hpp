// SPDX-License-Identifier: BSD-3-Clause
// The state, except the sites, that a run needs to continue from a checkpoint as if nothing had happened. Sizes,
// boundary and layout follow from the config and are computed again. Plain data.
#pragma once

#include "core/state_fields.hpp"
#include "sites/saved_sites.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <cstdint>
#include <vector>

namespace trime::meshing {

/// State that is the same on every rank.
struct RunState {
  StateNumbers numbers; ///< numbers of the classes that have a function visit()
  std::vector<sweep::SweepRecord> history;
};

/// A run that was read from a checkpoint. All members are the same on every rank, and so are the sites that `load`
/// gives for the same arguments.
struct SavedRun {
  RunState state;
  sites::SavedTiles tiles;
  sites::SiteLoader load;
};

} // namespace trime::meshing
