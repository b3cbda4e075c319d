// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the module extraction.
#pragma once

#include <cstddef>

namespace trime::extraction {

/// Numbers that decide which triangles are listed as bad, and for which of them a sharp corner is named as the reason.
struct ExtractionRules {
  /// [1] Triangles with a larger alpha are counted as bad, and the worst of them and of the obtuse ones are listed.
  /// Such a triangle has an angle below 22 degrees or above 98. Not measured.
  static constexpr double listed_alpha = 2;
  /// [triangles] Largest number of listed triangles, so that the list fits into the report. Not measured.
  static constexpr std::size_t most_listed = 10;
  /// [degrees] An equilateral triangle does not fit into a corner with a smaller interior angle. Not measured.
  static constexpr double sharp_degrees = 60;
  /// [h] No edge may be longer, with h at its middle. Measured on 40 meshes of shapes and coasts with 30 to 1e5 points:
  /// 1.2 to 2.2; without a limit of the growth, meshes that had missed a band of small sizes: 5 to 55.
  static constexpr double longest_edge = 4;
  /// [longest edges of the triangle] A corner within this distance counts as the reason for a bad triangle. The sites
  /// at equal distances around the corner (shells), and the triangles that adapt to them, reach about as far. Not
  /// measured.
  static constexpr double corner_reach = 3;
  /// [angle of the corner] A vertex that lies so far outside of the lines along the arms is still between them: the
  /// arms are chords, and the boundary may bend. Not measured.
  static constexpr double wedge_slack = 0.5;
};

} // namespace trime::extraction
