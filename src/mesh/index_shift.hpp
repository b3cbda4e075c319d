// SPDX-License-Identifier: BSD-3-Clause
// Changes of local indices when a few sites go and a few come: the others keep their order, and move up or down in
// runs.
#pragma once

#include "trime/core/types.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace trime::mesh {

/// The old and the new indices of a list in which some entries go and others come between those that stay.
class IndexShift {
public:
  /// @param before length of the list
  /// @param gone indices of those that go, ascending, each once
  /// @param places of each that comes, the index of the entry before which it comes, or `before`; ascending
  IndexShift(LocalIndex before, std::span<const LocalIndex> gone, std::span<const LocalIndex> places);

  LocalIndex before() const { return before_; }
  LocalIndex after() const { return after_; }
  /// Old indices of those that go.
  std::span<const LocalIndex> gone() const { return gone_; }
  /// New indices of those that come, in the order in which they were named.
  std::span<const LocalIndex> come() const { return come_; }

  /// By old index the new one, -1 where the entry goes. O(list).
  std::vector<LocalIndex> new_indices() const;

  /// @brief Moves the entries of a vector in place. Those that come are not set. O(entries behind the first change), at
  /// the speed of memory. @pre it has `before` entries
  template <class Vector>
  void move(Vector& values) const;

private:
  /// Entries that stay, one after the other.
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
  // A run ends where the next one begins or before, so none that moves down covers one that is still to move.
  for (const auto& [from, to, count] : runs_)
    if (to < from)
      std::copy(begin + from, begin + from + count, begin + to);
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run)
    if (run->to > run->from)
      std::copy_backward(begin + run->from, begin + run->from + run->count, begin + run->to + run->count);
  values.resize(at(after_));
}

} // namespace trime::mesh
