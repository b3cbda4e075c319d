// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module cones.
#pragma once

#include <cstddef>

namespace trime::cones {

/// Numbers for quadtrees over cones. The quadtrees only make look-ups faster: these numbers change no result.
struct ConeRules {
  /// [cones] Largest number of cones in the list of a leaf. In the smallest cells with more cones, the tree of cones is
  /// searched instead. Not measured.
  static constexpr std::size_t most_in_leaf = 24;
};

} // namespace trime::cones
