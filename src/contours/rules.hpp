// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module contours: limits of coordinates, and the size of normalised contours.
#pragma once

namespace trime::contours {

/// Limits and sizes for contours.
struct ContourRules {
  /// [1] Size of a normalised contour divided by the shorter side of the container. This size leaves a margin on all
  /// sides.
  static constexpr double normalized_share = 0.8;
  /// [file units] Larger coordinates are refused in contours and containers, so that squares of coordinates stay
  /// finite. Not measured.
  static constexpr double largest_coordinate = 1e30;
  /// [file units] A contour that is normalised must be wider or higher than this, so that the scale stays finite. Not
  /// measured.
  static constexpr double smallest_normalized = 1e-30;
  /// [diagonal of the box around the lines] If the two free ends of open lines are nearer to each other, the lines are
  /// probably a ring with a gap, which a repair must not leave out. Not measured.
  static constexpr double nearly_closed = 0.1;
  /// [size of the ring] A repair takes a vertex that is nearer to an edge of its ring as a vertex on that edge. This is
  /// some steps of the coordinate lattice. Not measured.
  static constexpr double repaired_share = 1e-12;
};

} // namespace trime::contours
