// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module delaunay, and the bounds beyond which the signs in the convexity test are certain.
// Holds no functions, because the vector kernels include this file.
#pragma once

#include <cstddef>

namespace trime::delaunay {

/// The bounds for testing in double precision whether a star is convex. Let a, b, q be the vectors from a site to three
/// consecutive neighbours, which are exact differences of lattice points.
struct ConvexityRules {
  /// [1] Bound on the error of the determinant, divided by a^2 b^2 + b^2 q^2 + q^2 a^2. Rounding errors add up to less
  /// than 7 * 2^-53 of that; the rest is a safety margin.
  static constexpr double error = 20 * 0x1p-53;
  /// [1] The test requires a x b > least_turn (a^2 + b^2). Then the orientation of the triangle is certain, and its
  /// squared circumradius has a relative error below 1e-8. Flatter triangles are left to the exact test.
  static constexpr double least_turn = 1e-7;
};

/// The numbers that say how far TileWrapper searches for possible neighbours (candidates) of a group of sites.
struct WrapRules {
  /// [spacings] Distance around the box of a group in which candidates are searched first; it suffices in a relaxed
  /// mesh. Not measured.
  static constexpr double reach_relaxed = 1.5;
  /// [spacings] Second distance for the search; it suffices for most sites at random places. Not measured.
  static constexpr double reach_random = 2.7;
  /// [spacings] Longest distance for the search; stars that need candidates farther away are computed one by one. Not
  /// measured.
  static constexpr double reach_longest = 4;
};

} // namespace trime::delaunay
