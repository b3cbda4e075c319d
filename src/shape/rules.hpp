// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module shape: which points become one vertex, and how touching rings are separated.
#pragma once

#include "trime/core/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace trime::shape {

/// Numbers for parts whose coordinates are rounded to the coordinate lattice.
struct ShapeRules {
  /// [lattice steps] If an edge touches or crosses another within this distance of a vertex, the vertex counts as lying
  /// on the edge. Rounding moves each end by up to one step. Not measured.
  static constexpr double on_edge = 2;
  /// [lattice steps] Distance by which touching rings are separated. With 64 steps, which are 4e-12 of the container's
  /// side, triangles next to the touch are as good as elsewhere (a largest alpha of 1.12 next to two touching squares).
  /// Not measured.
  static constexpr double touch_gap = 64;
  /// [1] Where rings that are separated farther would cross, the distance becomes smaller by this factor. Not measured.
  static constexpr double smaller_gap = 0.125;
  /// [shortest edge at the touch] A vertex moves no farther than this. Not measured.
  static constexpr double farthest_move = 0.25;
  /// [1] Where rings are separated, a vertex stays if the sine of half its angle is below this number and another
  /// vertex can move. Not measured.
  static constexpr double sharp_sine = 0.1;
  /// [1] Where rings are separated, a vertex moves into its sector along the bisector (0), or along a direction between
  /// the bisector and one of the two edges (1 or -1). These directions are tried in order; the first one that keeps the
  /// vertex out of the diametral circles of other edges is used. Not measured.
  static constexpr std::array<double, 7> tried_directions{0, 0.5, -0.5, 0.75, -0.75, 0.9, -0.9};
  /// [1] A vertex in a sharper tip moves no farther than a vertex whose half angle has this sine. Not measured.
  static constexpr double least_sine = 1.0 / 64;
  /// [segments] Number of segments in a chunk, in which one thread searches meetings. The number is fixed, so that the
  /// result does not depend on the number of threads. Not measured.
  static constexpr LocalIndex meeting_chunk = 2048;
  /// [meetings] The search in a chunk ends after this number of meetings, which bounds the memory. Not measured.
  static constexpr std::size_t most_meetings = 8192;
  /// [pairs] If the bins of the grid hold more pairs of segments than this per segment, a search tree finds the
  /// meetings, because a test of all these pairs would cost about as much as the tree. Measured on a ring of 10^6
  /// segments: the search in the bins takes a quarter of the time that the search by the tree takes.
  static constexpr std::int64_t enough_pairs = 32;
};

} // namespace trime::shape
