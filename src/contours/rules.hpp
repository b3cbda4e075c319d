// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the module contours: limits of coordinates, and where the normalisation puts them.
#pragma once

namespace trime::contours {

/// The numbers of reading contours.
struct ContourRules {
  /// [1] A contour that is normalised takes this share of the container's shorter side, so that a margin is left on all
  /// sides.
  static constexpr double normalized_share = 0.8;
  /// [file units] Larger coordinates of a contour are refused, as those of a container are: squares stay finite.
  /// Not measured.
  static constexpr double largest_coordinate = 1e30;
  /// [file units] A contour that is normalised is so wide or high at least: its inverse stays finite. Not measured.
  static constexpr double smallest_normalized = 1e-30;
};

} // namespace trime::contours
