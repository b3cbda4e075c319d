// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the module extraction.
#pragma once

#include <cstddef>

namespace trime::extraction {

/// Decides which triangles are listed, and which of them a corner excuses.
struct ExtractionRules {
  /// [1] Triangles of a larger alpha are counted and the worst of them listed: an angle below 22 degrees or above 98.
  /// Not measured.
  static constexpr double listed_alpha = 2;
  /// [triangles] Largest number in the list: one look at the report. Not measured.
  static constexpr std::size_t most_listed = 10;
  /// [degrees] A corner with a smaller angle inside does not hold an equilateral triangle. Not measured.
  static constexpr double sharp_degrees = 60;
  /// [longest edges of the triangle] So near to such a corner a triangle is excused: shells and the triangles that make
  /// up for them reach so far. Not measured.
  static constexpr double corner_reach = 3;
};

} // namespace trime::extraction
