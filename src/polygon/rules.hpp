// SPDX-License-Identifier: BSD-3-Clause
// The numbers by which the guard of the boundary is built and asked.
#pragma once

#include <cstddef>

namespace trime::polygon {

/// The numbers of the polygon module.
struct PolygonRules {
  /// [chord lengths] A site nearer to a chord than this encroaches, though it may lie outside of the disc: near the
  /// ends of a chord its disc is thin.
  static constexpr double near_chord = 0.05;
  /// [chord lengths] So far from the middle of a chord a site in its disc is pushed, and a new one placed: the radius
  /// is 0.5, and just outside of it the next move would bring the site back. With it, pushes on a poker of 1e4 points
  /// ended within five sweeps.
  static constexpr double push_way = 0.6;
  /// [cells] The way to the nearest disc is counted up to here; strips of rows read as many rows around them. Not
  /// measured.
  static constexpr int farthest_cell = 15;
  /// [1] Cosine of half a degree: a curve with a junction that turns by more is bent. Less is a round curve in pieces.
  static constexpr double cosine_of_bent = 0.99996;
  /// [1] Cosine of 30 degrees: a curve with a junction that turns by more is sharp. The same angle as the default of
  /// FeatureOptions::corner_angle.
  static constexpr double cosine_of_sharp = 0.8660254037844386;
};

} // namespace trime::polygon
