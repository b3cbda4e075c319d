// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module shape: what becomes one vertex, and how rings that touch are parted.
#pragma once

#include "trime/core/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace trime::shape {

/// The numbers of parts on the lattice, and of curves that were traced.
struct ShapeRules {
  /// [steps] A vertex that an edge of a contour passes so near by, with a touch or a crossing there, lies on that edge:
  /// snapping moves each end by up to one. Not measured.
  static constexpr double on_edge = 2;
  /// [steps] Distance by which touching rings are separated. At a touch with 64 steps, 4e-12 of the container's side,
  /// triangles on both sides are as good as elsewhere (a largest alpha of 1.12 next to two touching squares). Not
  /// measured.
  static constexpr double touch_gap = 64;
  /// [1] A vertex whose arms enclose a half angle of a smaller sine stays where rings are parted, if another can move.
  /// Not measured.
  static constexpr double sharp_sine = 0.1;
  /// [1] Where rings are parted, a vertex moves into its sector along the middle, or so far from it towards one of the
  /// two arms: the first direction that keeps it out of the discs over other arms. Not measured.
  static constexpr std::array<double, 7> tried_directions{0, 0.5, -0.5, 0.75, -0.75, 0.9, -0.9};
  /// [1] A vertex in a sharper tip is moved no farther than one with a half angle of this sine. Not measured.
  static constexpr double least_sine = 1.0 / 64;
  /// [segments] Size of the chunks in which meetings of segments are searched: the result does not depend on the
  /// threads. Not measured.
  static constexpr LocalIndex meeting_chunk = 2048;
  /// [meetings] The search in a chunk ends at this number: it bounds the memory. Not measured.
  static constexpr std::size_t most_meetings = 8192;
  /// [pairs] With more for each segment in the bins of the grid a tree is built: that costs about as much. Measured:
  /// with bins a ring of 10^6 segments is looked through in a quarter of the time.
  static constexpr std::int64_t enough_pairs = 32;
};

} // namespace trime::shape
