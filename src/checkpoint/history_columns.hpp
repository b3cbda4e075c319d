// SPDX-License-Identifier: BSD-3-Clause
// Stores the history of a run as columns, one for each member of its records.
#pragma once

#include "checkpoint/content_hash.hpp"
#include "trime/io/metadata.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <vector>

namespace trime::checkpoint {

/// Returns the group `history`.
io::MetadataGroup columns_of(const std::vector<sweep::SweepRecord>& history);
/// @throws FileError if columns are missing or have different lengths
std::vector<sweep::SweepRecord> history_of(const io::Metadata& metadata);
/// Adds all members of all records to a hash.
void add(const std::vector<sweep::SweepRecord>& history, ContentHash& hash);

} // namespace trime::checkpoint
