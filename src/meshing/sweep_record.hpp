// SPDX-License-Identifier: BSD-3-Clause
// What one sweep did, summed over all ranks.
#pragma once

#include "meshing/layout.hpp"
#include "meshing/sweeper.hpp"
#include "trime/meshing/options.hpp"
#include "trime/meshing/update_rule.hpp"

#include <string>

namespace trime::meshing {

/// A line of the history, and the sums that steer the next move.
struct SweepSummary {
  SweepRecord record;
  SweepSums sums;
};

/// @brief Measures the stars of the inner sites, with one packed reduction of quality and sums for the rule. Leaves
/// `sweep`, `stage`, `by_bars` and `seconds` of the record to the caller. Collective.
/// @param counts of the sweeps since the last record
SweepSummary summarize_sweep(const comm::Communicator& comm, const Layout& layout, Sweeper& sweeper,
                             const Sweeper::Counts& counts);

/// The line of the log.
std::string to_string(const SweepRecord& record);

} // namespace trime::meshing
