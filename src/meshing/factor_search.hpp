// SPDX-License-Identifier: BSD-3-Clause
// Steps towards the factor of the size that yields a number of points.
#pragma once

#include <algorithm>
#include <cmath>

namespace trime::meshing {

/// @brief Takes the number of points for a power of the factor, which the last two trials tell. By + - * / sqrt alone:
/// ranks on unlike machines must take the same steps to the last bit. What is followed is the inverse root of the
/// number, a straight line for the power -2 and nearly one for the others.
class FactorSearch {
public:
  explicit FactorSearch(double goal) : goal_(1 / std::sqrt(goal)) {}

  /// Forgets the trials so far: the number follows this power, until two new ones tell better.
  void expect(double power) {
    slope_ = -0.5 * power;
    last_factor_ = 0;
  }
  /// What to try next, at most a factor of 4 away.
  double next(double factor, double points) {
    constexpr double farthest = 4, flattest = 0.075, steepest = 1.5; // powers of -0.15 and -3
    constexpr double apart = 0.01; // of the factor: two trials nearer to each other tell nothing
    const double root = points > 0 ? 1 / std::sqrt(points) : 0;
    if (last_factor_ > 0 && std::fabs(factor - last_factor_) > apart * factor && root > 0 && last_root_ > 0)
      slope_ = std::clamp((root - last_root_) / (factor - last_factor_) * (factor / root), flattest, steepest);
    last_factor_ = factor;
    last_root_ = root;
    if (!(root > 0))
      return factor / farthest;
    return factor * std::clamp(1 + (goal_ / root - 1) / slope_, 1 / farthest, farthest);
  }

private:
  double goal_;
  double slope_ = 1; // relative change of the inverse root over that of the factor
  double last_factor_ = 0, last_root_ = 0;
};

} // namespace trime::meshing
