// SPDX-License-Identifier: BSD-3-Clause
// Makes the record of a sweep, summed over all ranks, and its line in the log.
#pragma once

#include "sweep/sweep_sums.hpp"
#include "sweep/sweeper.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <string>

namespace trime::sweep {

/// A line of the history, and the sums that the next move uses.
struct SweepSummary {
  SweepRecord record;
  SweepSums sums;
};

/// @brief Measures the stars of the inner sites, with one packed reduction of quality and sums for the rule. Leaves
/// `sweep`, `stage`, `by_bars` and `seconds` of the record to the caller. Collective.
/// @param counts counts of the sweeps since the last record
/// @param typical_size any typical h, see SweepSums
/// @param held sites on all ranks that never move: boundary sites and fixed points
SweepSummary summarize_sweep(const sites::SiteState& state, Sweeper& sweeper, const Sweeper::Counts& counts,
                             double typical_size, GlobalId held);

/// Return the head of the table of sweeps in a log, and a row of it.
std::string table_header();
std::string table_row(const SweepRecord& record);
/// Returns the text for the live line of a terminal, in at most 60 columns.
std::string live_text(const SweepRecord& record);

} // namespace trime::sweep
