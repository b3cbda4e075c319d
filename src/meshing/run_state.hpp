// SPDX-License-Identifier: BSD-3-Clause
// All that a run must know to go on as if nothing had happened, but for its sites. What follows from the config alone
// is made again: sizes, boundary, layout. Plain data.
#pragma once

#include "core/state_fields.hpp"
#include "sites/saved_sites.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <cstdint>
#include <vector>

namespace trime::meshing {

/// The same on every rank.
struct RunState {
  StateNumbers numbers; ///< of the classes that take part, see their visit()
  std::vector<sweep::SweepRecord> history;
};

/// A run that was read back. The same on every rank, but for what `load` is asked for.
struct SavedRun {
  RunState state;
  sites::SavedTiles tiles;
  sites::SiteLoader load;
};

} // namespace trime::meshing
