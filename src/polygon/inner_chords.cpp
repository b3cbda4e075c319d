// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/inner_chords.hpp"

#include <numeric>

namespace trime::polygon {

void InnerChords::sort_ends() {
  by_end.resize(2 * chords.size());
  std::iota(by_end.begin(), by_end.end(), LocalIndex{0});
  std::stable_sort(by_end.begin(), by_end.end(),
                   [this](LocalIndex a, LocalIndex b) { return geometry::lexicographically_less(end(a), end(b)); });
}

} // namespace trime::polygon
