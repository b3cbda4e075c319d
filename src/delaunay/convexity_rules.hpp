// SPDX-License-Identifier: BSD-3-Clause
// Says when the signs of the convexity test in doubles are certain, for the exact kernel and for those of the sweeps.
// Has no functions, because the vector kernels include it.
#pragma once

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

} // namespace trime::delaunay
