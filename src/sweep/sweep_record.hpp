// SPDX-License-Identifier: BSD-3-Clause
// Makes the record of a sweep, summed over all ranks, and formats the record as a line of the log.
#pragma once

#include "sweep/sweep_sums.hpp"
#include "sweep/sweeper.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <string>

namespace trime::sweep {

/// The record of a sweep, together with the sums over all ranks that the next move uses.
struct SweepSummary {
  SweepRecord record;
  SweepSums sums;
};

/// @brief Measures the stars of the inner sites. One reduction carries the quality and the sums that the update rule
/// needs. The caller sets `sweep`, `stage`, `by_bars` and `seconds` of the record. Collective.
/// @param counts counts of moved, pushed and deleted sites since the last record
/// @param typical_size any typical target edge length, used as the unit h_ref of SweepSums
/// @param held number of sites on all ranks that never move: boundary sites and fixed points
SweepSummary summarize_sweep(const sites::SiteState& state, Sweeper& sweeper, const Sweeper::Counts& counts,
                             double typical_size, GlobalId held);

/// Returns the head of the table of sweeps in the log.
std::string table_header();
/// Returns the row of one sweep in the table of the log.
std::string table_row(const SweepRecord& record);
/// Returns the progress text for the last line of a terminal, in at most 60 columns.
std::string live_text(const SweepRecord& record);

} // namespace trime::sweep
