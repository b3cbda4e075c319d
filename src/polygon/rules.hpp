// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module polygon.
#pragma once

#include <cstddef>

namespace trime::polygon {

/// Numbers for testing whether sites are too near to the boundary, and for classifying bent and sharp curves.
struct PolygonRules {
  /// [chord lengths] A site that is nearer to a chord than this is too near, even outside of the diametral circle,
  /// which is thin near the ends of the chord.
  static constexpr double near_chord = 0.05;
  /// [chord lengths] Distance from the middle of a chord to which a site in its diametral circle is pushed, and at
  /// which a new site is placed. The radius of the circle is 0.5; from a place just outside of it, the next move would
  /// bring the site back. On a poker card with 1e4 points, pushes ended within five sweeps.
  static constexpr double push_way = 0.6;
  /// [cells] Largest stored distance to the nearest circle. Each strip of rows reads as many rows around it. Not
  /// measured.
  static constexpr int farthest_cell = 15;
  /// [1] Cosine of half a degree. A curve is bent if it has a junction that turns by more; smaller turns occur where a
  /// round curve consists of several pieces.
  static constexpr double cosine_of_bent = 0.99996;
  /// [1] Cosine of 30 degrees, the default of FeatureOptions::corner_angle. A curve is sharp if it has a junction that
  /// turns by more.
  static constexpr double cosine_of_sharp = 0.8660254037844386;
};

} // namespace trime::polygon
