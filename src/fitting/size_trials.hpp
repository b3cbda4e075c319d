// SPDX-License-Identifier: BSD-3-Clause
// Lays out the boundary for one factor of the size after the other, during the search for the factor that yields the
// points asked for.
#pragma once

#include "fitting/density_integral.hpp"
#include "fitting/few_points.hpp"
#include "fitting/layout.hpp"
#include "fitting/stage_fit.hpp"
#include "sizing/lowered_size.hpp"

#include <utility>
#include <vector>

namespace trime::fitting {

/// The result of a trial with one factor of the size.
struct SizeTrial {
  StageFit fit;
  FittedSize fitted;
  DensityTotals totals;
  double points = 0; ///< number of points on the boundary and inside
};

/// @brief Lays out the boundary at a factor and counts the points. The limits and samples of the size that one trial
/// finds are kept for the next trial, unless the curves are simplified again: new curves get new limits. All methods
/// that lay out or count are collective.
class SizeTrials {
public:
  /// @param points about the number of points asked for @param coarsening factor on the width of the cells of the
  /// integral
  SizeTrials(const LayoutContext& context, double points, double coarsening)
      : context_(context), points_(points), coarsening_(coarsening) {}

  /// Begins with curves that were simplified before. Local.
  void begin_with(const FittedSize& fitted) { fitted_.curves = fitted.curves; }

  /// @brief Lays out boundary sites within the limits of the size that are known. If the factor is near the one for
  /// which limits were found, these are scaled with it; otherwise they are forgotten, because they would keep corners
  /// that the curves at this factor leave out.
  sites::Stage lay(double factor);
  /// Looks for more limits of the size, at most a few times. Returns true if it finds any; later trials use them.
  /// @param laid the last result of lay()
  bool find_limits(const sites::Stage& laid);
  /// Lays out boundary sites within all limits that the factor needs.
  sites::Stage lay_with_limits(double factor) { return with_limits(lay(factor)); }
  /// Counts the points of a layout; if there are far too many, the number is not exact. @param laid the last result of
  /// lay() @param coarsening factor on the width of the cells of the integral
  SizeTrial count(sites::Stage laid, double coarsening) const;
  /// Lays out the boundary with all limits that the factor needs, and counts the points.
  SizeTrial run(double factor) { return run_from(lay(factor)); }
  /// Lays out the boundary with all limits that the factor of a layout needs, and counts the points. @param laid the
  /// last result of lay()
  SizeTrial run_from(sites::Stage laid) { return count(with_limits(std::move(laid)), coarsening_); }

  /// @brief Makes all further trials use this simplified boundary and its limits, because sizes that are smaller than
  /// this one need no others.
  void hold(const FittedSize& fitted);

  double coarsening() const { return coarsening_; }
  /// Returns where the size of the last layout is limited because it grows too fast.
  const SteepPlaces& steep() const { return fitted_.steep; }
  std::size_t limits() const { return limits_.size(); }
  /// Returns how often limits were searched since the factor last changed much.
  int limit_rounds() const { return limit_rounds_; }

private:
  void forget_limits(double factor);
  /// Lays the stage out again while the factor needs more limits. @param laid the last result of lay()
  sites::Stage with_limits(sites::Stage laid);

  const LayoutContext& context_;
  double points_, coarsening_;
  std::vector<sizing::SizeLimit> limits_; // limits found so far
  double limits_factor_ = 0;              // factor for which the search for limits began
  int limit_rounds_ = 0;                  // rounds of that search
  double limited_curves_ = 0; // factor of the simplified curves for which that search began; 0: curves of the shape
  FittedSize fitted_;         // size and curves of the last layout
};

/// @brief Returns the smallest value of the relative size at some places: on the boundary of the shape and on a grid
/// over its box. The grid also covers places outside the shape, where values may be invalid; these are skipped. Local.
/// @throws GeometryError if no value is valid
double smallest_sampled_size(const LayoutContext& context);

} // namespace trime::fitting
