// SPDX-License-Identifier: BSD-3-Clause
// Steps towards the factor of the size that yields a number of points.
#pragma once

#include "fitting/rules.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cmath>

namespace trime::fitting {

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
    const double root = points > 0 ? 1 / std::sqrt(points) : 0;
    if (last_factor_ > 0 && std::fabs(factor - last_factor_) > apart * factor && root > 0 && last_root_ > 0)
      slope_ =
          std::clamp((root - last_root_) / (factor - last_factor_) * (factor / root), flattest_slope, steepest_slope);
    last_factor_ = factor;
    last_root_ = root;
    if (!(root > 0))
      return factor / FitRules::farthest_step;
    return factor * std::clamp(1 + (goal_ / root - 1) / slope_, 1 / FitRules::farthest_step, FitRules::farthest_step);
  }

private:
  // [1] Least slope that a secant is trusted with, of the inverse root of the points over the factor: 0.075 is that of
  // a power of -0.15.
  static constexpr double flattest_slope = 0.075;
  // [1] The largest one: that of a power of -3.
  static constexpr double steepest_slope = 1.5;
  // [1] Two factors that differ by a smaller share tell nothing of the slope.
  static constexpr double apart = 0.01;
  double goal_;
  double slope_ = 1; // relative change of the inverse root over that of the factor
  double last_factor_ = 0, last_root_ = 0;
};

/// @brief Between which factors of the size the one lies that yields the points asked for: a larger factor makes fewer
/// points.
class FactorBracket {
public:
  /// @param points asked for
  /// @param smallest size for a factor of 1: where even that is far larger than the container, nothing changes
  FactorBracket(double points, double smallest, const geometry::Box& container)
      : wanted_(points), smallest_(smallest), extent_(std::max(container.width(), container.height())),
        largest_(largest_size * (container.width() + container.height()) / smallest) {}

  bool has_lower() const { return low_ > 0; }
  bool has_upper() const { return high_ < INFINITY; }
  /// Takes a trial in. True if it has no more points than asked for, and a smaller factor than the others of that kind.
  bool add(double factor, double points) {
    const bool same = has_upper() && !has_lower() && std::fabs(points - last_points_) < same_points * last_points_;
    saturated_ = same ? saturated_ + 1 : 0;
    last_points_ = points;
    if (points > wanted_) {
      low_ = factor;
      return false;
    }
    if (!(factor <= high_))
      return false;
    high_ = factor;
    return true;
  }
  /// No further trial helps: the bracket is narrow, no site fits into such sizes, or finer ones do not help.
  bool is_closed() const {
    return low_ * smallest_ > extent_ || saturated_ == saturated_trials ||
           (has_upper() && low_ > (1 - closest_factors) * high_);
  }
  /// What to try next, near a guess. @param overfull the last trial had far too many sites
  double next(double factor, double guess, bool overfull) const {
    if (!has_upper())
      return std::max(guess, (overfull ? overfull_step : 1 + FitRules::least_step) * factor);
    if (!has_lower())
      return std::min(guess, (1 - FitRules::least_step) * factor);
    const double margin = FitRules::bracket_margin * (high_ - low_);
    return std::clamp(guess, low_ + margin, high_ - margin);
  }
  /// No factor up to this one has made few enough points, and larger ones change nothing.
  bool is_hopeless(double factor) const { return !has_upper() && factor > largest_; }

private:
  // [trials] After so many in a row that change nothing a finer size does not help. It takes several, since the first
  // may be too coarse for any site inside.
  static constexpr int saturated_trials = 8;
  // [1] Two trials whose numbers of points differ by a smaller share have changed nothing.
  static constexpr double same_points = 1e-3;
  // [1] If the factors on both sides of the goal differ by a smaller share, no trial is made between them: the count
  // jumps there.
  static constexpr double closest_factors = 1e-4;
  // [1] After a trial that was given up, with far too many sites, the factor grows at least by this.
  static constexpr double overfull_step = 1.5;
  // [width + height of the container] Larger sizes change nothing: a bound for the search.
  static constexpr double largest_size = 64;
  double wanted_, smallest_, extent_, largest_;
  double low_ = 0, high_ = INFINITY;
  double last_points_ = 0;
  int saturated_ = 0; // trials in a row that changed nothing
};

} // namespace trime::fitting
