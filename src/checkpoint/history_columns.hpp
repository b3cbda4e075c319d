// SPDX-License-Identifier: BSD-3-Clause
// The history of a run as columns, one for each member of its records.
#pragma once

#include "checkpoint/content_hash.hpp"
#include "trime/io/metadata.hpp"
#include "trime/sweep/sweep_history.hpp"

#include <vector>

namespace trime::checkpoint {

/// The group `history`.
io::MetadataGroup columns_of(const std::vector<sweep::SweepRecord>& history);
/// @throws FileError if columns are missing, or not of one length
std::vector<sweep::SweepRecord> history_of(const io::Metadata& metadata);
/// All members of all records.
void add(const std::vector<sweep::SweepRecord>& history, ContentHash& hash);

} // namespace trime::checkpoint
