// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/index_shift.hpp"

namespace trime::mesh {

IndexShift::IndexShift(LocalIndex before, std::span<const LocalIndex> gone, std::span<const LocalIndex> places)
    : before_(before), gone_(gone.begin(), gone.end()) {
  LocalIndex next = 0; // old index
  auto next_gone = gone.begin();
  const auto keep_until = [&](LocalIndex end) {
    while (next < end) {
      const LocalIndex stop = next_gone != gone.end() && *next_gone < end ? *next_gone : end;
      if (stop > next)
        runs_.push_back({next, after_, stop - next});
      after_ += stop - next;
      next = stop;
      if (stop < end) {
        ++next;
        ++next_gone;
      }
    }
  };
  for (const LocalIndex place : places) {
    keep_until(place);
    come_.push_back(after_++);
  }
  keep_until(before);
}

std::vector<LocalIndex> IndexShift::new_indices() const {
  std::vector<LocalIndex> indices(at(before_), -1);
  for (const auto& [from, to, count] : runs_)
    for (LocalIndex k = 0; k < count; ++k)
      indices[at(from + k)] = to + k;
  return indices;
}

} // namespace trime::mesh
