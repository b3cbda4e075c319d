// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the cells that answer for the lower envelope of cones.
#pragma once

#include <cstddef>

namespace trime::cones {

/// The numbers of cones. Cells only make look-ups faster: none of these numbers changes an answer.
struct ConeRules {
  /// [cones] Largest number in the list of a leaf; for the smallest cells with more, the tree is searched. Not
  /// measured.
  static constexpr std::size_t most_in_leaf = 24;
};

} // namespace trime::cones
