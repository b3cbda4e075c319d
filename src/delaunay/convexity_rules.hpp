// SPDX-License-Identifier: BSD-3-Clause
// When the signs of the convexity test are beyond doubt: for the exact kernel and for those of the sweeps. Holds no
// functions, since the vector kernels include it.
#pragma once

namespace trime::delaunay {

/// The numbers of the convexity test in doubles. a, b, q are neighbouring spokes of a star, exact lattice differences.
struct ConvexityRules {
  /// [1] Bound on the error of the determinant over a^2 b^2 + b^2 q^2 + q^2 a^2. Its roundings add up to less than 7
  /// units of 2^-53 of that; the rest is safety.
  static constexpr double error = 20 * 0x1p-53;
  /// [1] A spoke must turn against the one before by a x b > this (a^2 + b^2), which leaves no doubt about the
  /// orientation of its triangle, and the squared circumradius is known to 1e-8 of itself. Flatter stars are left to
  /// the exact test.
  static constexpr double least_turn = 1e-7;
};

} // namespace trime::delaunay
