// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module polygon.
#pragma once

#include <cstddef>

namespace trime::polygon {

/// Numbers for the guard of the boundary, and for bent and sharp curves.
struct PolygonRules {
  /// [chord lengths] A site nearer to a chord than this encroaches, even outside the disc, which is thin near the ends
  /// of the chord.
  static constexpr double near_chord = 0.05;
  /// [chord lengths] Distance from the middle of a chord to which a site in its disc is pushed, and at which a new site
  /// is placed. The radius of the disc is 0.5; just outside it the next move would bring the site back. On a poker of
  /// 1e4 points, pushes ended within five sweeps.
  static constexpr double push_way = 0.6;
  /// [cells] Largest distance to the nearest disc that is stored. Each strip of rows reads as many rows around it. Not
  /// measured.
  static constexpr int farthest_cell = 15;
  /// [1] Cosine of half a degree. A curve with a junction that turns by more is bent; smaller turns occur where a round
  /// curve consists of pieces.
  static constexpr double cosine_of_bent = 0.99996;
  /// [1] Cosine of 30 degrees, the default of FeatureOptions::corner_angle. A curve with a junction that turns by more
  /// is sharp.
  static constexpr double cosine_of_sharp = 0.8660254037844386;
};

} // namespace trime::polygon
