// SPDX-License-Identifier: BSD-3-Clause
// Searches the factor by which the size field is multiplied, so that the mesh has the number of points asked for.
#pragma once

#include "fitting/rules.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cmath>

namespace trime::fitting {

/// Returns the factor by which an estimate is raised for a boundary that will be simplified. @param weight
/// FitRules::limits_on_ragged or limits_on_cornered @param share of the sites that lie on the boundary
inline double larger_for_limits(double weight, double share) {
  return 1 + weight * share * share;
}

/// @brief Assumes that the number of points is a power of the factor, which follows from the last two trials. It uses
/// only + - * / and sqrt, because ranks on different machines must take exactly the same steps. It interpolates the
/// inverse root of the number, which is a straight line for the power -2 and almost one for the others.
class FactorSearch {
public:
  explicit FactorSearch(double goal) : goal_(1 / std::sqrt(goal)) {}

  /// Forgets the trials so far, and assumes this exponent until there are two new trials.
  void expect(double power) {
    slope_ = -0.5 * power;
    last_factor_ = 0;
  }
  /// Returns the factor to try next, at most 4 times larger or smaller.
  double next(double factor, double points) {
    const double root = points > 0 ? 1 / std::sqrt(points) : 0;
    if (last_factor_ > 0 && std::fabs(factor - last_factor_) > apart * factor && root > 0 && last_root_ > 0) {
      const double slope = (root - last_root_) / (factor - last_factor_) * (factor / root);
      if (slope > 0) // else other curves have more points at a larger size, by chance
        slope_ = std::clamp(slope, flattest_slope, steepest_slope);
    }
    last_factor_ = factor;
    last_root_ = root;
    if (!(root > 0))
      return factor / FitRules::farthest_step;
    return factor * std::clamp(1 + (goal_ / root - 1) / slope_, 1 / FitRules::farthest_step, FitRules::farthest_step);
  }

private:
  // [1] Smallest slope of a secant of 1 / sqrt(points) over the factor. It belongs to an exponent of -0.15.
  static constexpr double flattest_slope = 0.075;
  // [1] Largest slope of a secant. It belongs to an exponent of -3.
  static constexpr double steepest_slope = 1.5;
  // [1] No slope is computed from two factors whose relative difference is below this.
  static constexpr double apart = 0.01;
  double goal_;
  double slope_ = 1; // relative change of 1 / sqrt(points) divided by the relative change of the factor
  double last_factor_ = 0, last_root_ = 0;
};

/// @brief Encloses the factor that yields the points asked for between two factors. A larger factor gives fewer points.
class FactorBracket {
public:
  /// @param points number of points asked for
  /// @param smallest smallest size of the field at a factor of 1; once factor times `smallest` is far larger than the
  /// container, a larger factor changes nothing
  FactorBracket(double points, double smallest, const geometry::Box& container)
      : wanted_(points), smallest_(smallest), extent_(std::max(container.width(), container.height())),
        largest_(largest_size * (container.width() + container.height()) / smallest) {}

  bool has_lower() const { return low_ > 0; }
  bool has_upper() const { return high_ < INFINITY; }
  /// Adds a trial. Returns true if the trial has at most the points asked for, and its factor is smaller than those of
  /// all earlier trials with at most that number.
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
  /// Returns true if no further trial helps: the bracket is narrow, no site fits into such large sizes, or smaller
  /// sizes do not change the number of points.
  bool is_closed() const {
    return low_ * smallest_ > extent_ || saturated_ == saturated_trials ||
           (has_upper() && low_ > (1 - closest_factors) * high_);
  }
  /// Returns the factor to try next, near a guess. @param overfull whether the last trial had far too many sites
  double next(double factor, double guess, bool overfull) const {
    if (!has_upper())
      return std::max(guess, (overfull ? overfull_step : 1 + FitRules::least_step) * factor);
    if (!has_lower())
      return std::min(guess, (1 - FitRules::least_step) * factor);
    const double margin = FitRules::bracket_margin * (high_ - low_);
    return std::clamp(guess, low_ + margin, high_ - margin);
  }
  /// Returns true if every trial so far had too many points and a larger factor changes nothing.
  bool is_hopeless(double factor) const { return !has_upper() && factor > largest_; }

private:
  // [trials] After this number of consecutive trials that change nothing, smaller sizes do not help. One such trial is
  // not enough, because the sizes of the first trials may be too large for any inner site.
  static constexpr int saturated_trials = 8;
  // [1] A trial changes nothing if the relative difference between its number of points and that of the trial before is
  // below this.
  static constexpr double same_points = 1e-3;
  // [1] If the relative difference between the two ends of the bracket is below this, no trial is made between them,
  // because the number of points jumps there.
  static constexpr double closest_factors = 1e-4;
  // [1] Smallest ratio of the next factor to this one after a trial that was stopped because it had far too many sites.
  static constexpr double overfull_step = 1.5;
  // [width + height of the container] Largest size that the search tries, because larger sizes change nothing.
  static constexpr double largest_size = 64;
  double wanted_, smallest_, extent_, largest_;
  double low_ = 0, high_ = INFINITY;
  double last_points_ = 0;
  int saturated_ = 0; // consecutive trials that changed nothing
};

} // namespace trime::fitting
