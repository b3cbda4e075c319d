// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the module extraction.
#pragma once

#include <cstddef>

namespace trime::extraction {

/// Numbers that decide which triangles are listed, and which of them are excused by a sharp corner.
struct ExtractionRules {
  /// [1] Triangles with a larger alpha are counted, and the worst of them are listed. They have an angle below 22
  /// degrees or above 98. Not measured.
  static constexpr double listed_alpha = 2;
  /// [triangles] Largest length of the list, so that it fits into the report. Not measured.
  static constexpr std::size_t most_listed = 10;
  /// [degrees] A corner with a smaller angle inside does not hold an equilateral triangle. Not measured.
  static constexpr double sharp_degrees = 60;
  /// [longest edges of the triangle] A triangle within this distance of such a corner is excused. The shells around the
  /// corner, and the triangles that adapt to them, reach about as far. Not measured.
  static constexpr double corner_reach = 3;
  /// [angle of the corner] A vertex that lies so far outside of the lines along the arms is still between them: the
  /// arms are chords, and the boundary may bend. Not measured.
  static constexpr double wedge_slack = 0.5;
};

} // namespace trime::extraction
