// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module tracing: how functions become curves.
#pragma once

#include <cstddef>

namespace trime::tracing {

/// The numbers of tracing and thinning the zero set of a function.
struct TracingRules {
  /// [halvings] From the coarse grid, whose cells are looked at first, to the fine one. Not measured.
  static constexpr int grid_levels = 2;
  /// [cells] Smallest number of cells of the coarse grid along a side. Not measured.
  static constexpr int fewest_coarse_cells = 16;
  /// [cells] Largest number of cells of the coarse grid along a side: it bounds time and memory. Not measured.
  static constexpr int most_coarse_cells = 4096;
  /// [cells] Fine cells that the zero set may meet, at most: it bounds the memory.
  static constexpr std::size_t most_near_zero = std::size_t{1} << 25;
  /// [1] Slopes of a formula are taken so much larger than they were sampled.
  static constexpr double slope_margin = 1.25;
  /// [rad] Corners are looked for where two chords turn by more than this, about 4 degrees.
  static constexpr double smallest_turn = 0.07;
  /// [halvings] A chord is halved so often at most.
  static constexpr int deepest_chord = 48;
  /// [vertices] Largest number in one chord, before thinning.
  static constexpr std::size_t most_in_chord = 4096;
  /// [vertices] Largest number for a formula, before thinning: it bounds the memory.
  static constexpr std::size_t most_vertices = std::size_t{1} << 23;
  /// [1] The curve strays from a chord by this share of its length at most: turns stay below 9 degrees.
  static constexpr double stray_share = 0.02;
  /// [chords] Distance from the middle of a chord up to which the curve is searched: it may be far in a sharp tip.
  static constexpr double farthest_beside = 16;
  /// [chords] A corner is looked for so far from its chord at most.
  static constexpr double farthest_corner = 64;
  /// [1] Each look at the arms of a supposed corner is so much nearer than the last.
  static constexpr double nearer = 0.125;
  /// [1] Lines whose directions differ by a smaller sine do not meet.
  static constexpr double nearly_parallel = 1e-3;
  /// [1] Vertices of a traced curve so near to each other are one, as a share of the longer side.
  static constexpr double same_place = 1e-9;
};

} // namespace trime::tracing
