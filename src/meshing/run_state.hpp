// SPDX-License-Identifier: BSD-3-Clause
// The state that a run needs to continue as if nothing had happened, except its sites. Whatever follows from the config
// alone is computed again: sizes, boundary, layout. Plain data.
#pragma once

#include "core/state_fields.hpp"
#include "sites/saved_sites.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <cstdint>
#include <vector>

namespace trime::meshing {

/// State that is the same on every rank.
struct RunState {
  StateNumbers numbers; ///< of the classes that take part, see their visit()
  std::vector<sweep::SweepRecord> history;
};

/// A run that was read back. All members are the same on every rank; `load` depends on its arguments.
struct SavedRun {
  RunState state;
  sites::SavedTiles tiles;
  sites::SiteLoader load;
};

} // namespace trime::meshing
