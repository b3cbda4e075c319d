// SPDX-License-Identifier: BSD-3-Clause
// The tuned numbers of the module delaunay, and the bounds beyond which the signs of the convexity test are certain.
// Holds no functions, since the vector kernels include it.
#pragma once

#include <cstddef>

namespace trime::delaunay {

/// The numbers of the convexity test in doubles. a, b, q are consecutive spokes of a star, which are exact lattice
/// differences.
struct ConvexityRules {
  /// [1] Bound on the error of the determinant over a^2 b^2 + b^2 q^2 + q^2 a^2. The roundings add up to less than 7 *
  /// 2^-53 of that; the rest is a safety margin.
  static constexpr double error = 20 * 0x1p-53;
  /// [1] Consecutive spokes must have a x b > this (a^2 + b^2). Then the orientation of their triangle is certain, and
  /// its squared circumradius has a relative error below 1e-8. Flatter stars are left to the exact test.
  static constexpr double least_turn = 1e-7;
};

/// The numbers of TileWrapper, which say how far it looks for candidates.
struct WrapRules {
  /// [spacings] First distance beyond the box of a group in which candidates are searched; it suffices in a relaxed
  /// mesh. Not measured.
  static constexpr double reach_relaxed = 1.5;
  /// [spacings] Next distance; it suffices for most sites of a random start. Not measured.
  static constexpr double reach_random = 2.7;
  /// [spacings] Longest distance; stars that need more are searched one by one. Not measured.
  static constexpr double reach_longest = 4;
};

} // namespace trime::delaunay
