// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module delaunay. None of them can change a star that a mesh uses, only the time that it
// takes.
#pragma once

#include <cstddef>

namespace trime::delaunay {

/// The numbers of TileWrapper: how far it looks for candidates, and where groups of sites pay.
struct WrapRules {
  /// [spacings] How far beyond the box of a group candidates are looked for first: enough in a relaxed mesh. Not
  /// measured.
  static constexpr double reach_relaxed = 1.5;
  /// [spacings] The next longer reach: enough for most sites of a random start. Not measured.
  static constexpr double reach_random = 2.7;
  /// [spacings] The longest reach; what needs more is left to the search of single stars. Not measured.
  static constexpr double reach_longest = 4;
};

} // namespace trime::delaunay
