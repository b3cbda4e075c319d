// SPDX-License-Identifier: BSD-3-Clause
// The numbers by which the guard of the boundary is built and asked.
#pragma once

#include <cstddef>

namespace trime::polygon {

/// The numbers of the polygon module.
struct PolygonRules {
  /// [chord lengths] A site nearer to a chord than this encroaches, though it may lie outside of the disc. Not
  /// measured.
  static constexpr double near_chord = 0.05;
  /// [chord lengths] A site in a disc is pushed so far from the middle of the chord: the radius is 0.5. Not measured.
  static constexpr double push_way = 0.6;
  /// [1] Cells of the guard's grid for each chord: most places then answer by one look-up. Not measured.
  static constexpr double cells_per_chord = 64;
  /// [1] Cells of the guard's grid at most: 4 MiB. Not measured.
  static constexpr double most_cells = 0x1p22;
  /// [cells] The way to the nearest disc is counted up to here; beyond, nobody asks. Not measured.
  static constexpr int farthest_cell = 15;
  /// [1] Entries of all lists of discs together that are always allowed. Not measured.
  static constexpr double entries = 0x1p22;
  /// [1] Entries of these lists that each chord adds to what is allowed. Not measured.
  static constexpr double entries_per_chord = 64;
  /// [1] Entries of these lists at most: 128 MiB. Not measured.
  static constexpr double most_entries = 0x1p25;
};

} // namespace trime::polygon
