// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module delaunay. None of them can change a star of a mesh; they change only the time that it
// takes.
#pragma once

#include <cstddef>

namespace trime::delaunay {

/// The numbers of TileWrapper, which say how far it looks for candidates.
struct WrapRules {
  /// [spacings] First distance beyond the box of a group in which candidates are searched; it suffices in a relaxed
  /// mesh. Not measured.
  static constexpr double reach_relaxed = 1.5;
  /// [spacings] Next distance; it suffices for most sites of a random start. Not measured.
  static constexpr double reach_random = 2.7;
  /// [spacings] Longest distance; stars that need more are searched one by one. Not measured.
  static constexpr double reach_longest = 4;
};

} // namespace trime::delaunay
