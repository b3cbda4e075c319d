// SPDX-License-Identifier: BSD-3-Clause
// Changes local indices after a few sites were removed and a few were inserted. The other sites keep their order, and
// their indices shift in runs.
#pragma once

#include "trime/core/types.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace trime::mesh {

/// The old and the new indices of a list from which some entries are removed and into which others are inserted.
class IndexShift {
public:
  /// @param before length of the list before the change
  /// @param gone indices of the removed entries, ascending, each once
  /// @param places for each inserted entry, the old index of the entry before which it is inserted, or `before` for the
  /// end; ascending
  IndexShift(LocalIndex before, std::span<const LocalIndex> gone, std::span<const LocalIndex> places);

  LocalIndex before() const { return before_; }
  LocalIndex after() const { return after_; }
  /// Returns the old indices of the removed entries.
  std::span<const LocalIndex> gone() const { return gone_; }
  /// Returns the new indices of the inserted entries, in the order of `places`.
  std::span<const LocalIndex> come() const { return come_; }

  /// Returns the new index of each old entry; -1 for removed entries. Cost: O(list).
  std::vector<LocalIndex> new_indices() const;

  /// @brief Moves the entries of a vector in place. Inserted entries are not set. Cost: O(entries after the first
  /// change).
  /// @pre the vector has `before` entries
  template <class Vector>
  void move(Vector& values) const;

private:
  /// Consecutive entries that stay in the list.
  struct Run {
    LocalIndex from, to, count;
  };
  LocalIndex before_, after_ = 0;
  std::vector<LocalIndex> gone_, come_;
  std::vector<Run> runs_; // ascending
};

template <class Vector>
void IndexShift::move(Vector& values) const {
  values.resize(at(std::max(before_, after_)));
  const auto begin = values.begin();
  // A run ends before the next one begins, so a run that moves down cannot overwrite a run that has not moved yet.
  for (const auto& [from, to, count] : runs_)
    if (to < from)
      std::copy(begin + from, begin + from + count, begin + to);
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run)
    if (run->to > run->from)
      std::copy_backward(begin + run->from, begin + run->from + run->count, begin + run->to + run->count);
  values.resize(at(after_));
}

} // namespace trime::mesh
