// SPDX-License-Identifier: BSD-3-Clause
// Makes layouts at one factor of the size after the other, during the search for the factor that yields the points
// asked for.
#pragma once

#include "fitting/density_integral.hpp"
#include "fitting/few_points.hpp"
#include "fitting/layout.hpp"
#include "fitting/stage_fit.hpp"
#include "sizing/lowered_size.hpp"

#include <vector>

namespace trime::fitting {

/// The result of a trial with one factor.
struct SizeTrial {
  StageFit fit;
  FittedSize fitted;
  DensityTotals totals;
  double points = 0; ///< number of points on the boundary and inside
};

/// @brief Lays the boundary at a factor and counts the points. The limits that one trial finds, and the samples of the
/// size, are kept for the next, unless curves are simplified again: these find their own limits. All methods that lay
/// or count are collective.
class SizeTrials {
public:
  /// @param points about the number of points that are wanted @param coarsening factor on the width of the cells of the
  /// integral
  SizeTrials(const LayoutContext& context, double points, double coarsening)
      : context_(context), points_(points), coarsening_(coarsening) {}

  /// Takes curves that were simplified before. Local.
  void begin_with(const FittedSize& fitted) { fitted_.curves = fitted.curves; }

  /// @brief Boundary sites within the limits that are known. For a factor near by they are scaled with it; those of one
  /// far away would keep corners that this one leaves out.
  sites::Stage lay(double factor);
  /// Looks for more limits, at most a few times. Returns true if it finds any, which later trials use. @param laid the
  /// last result of lay()
  bool find_limits(const sites::Stage& laid);
  /// Counts the points of a layout; if there are far too many, the number is not exact. @param laid the last result of
  /// lay() @param coarsening factor on the width of the cells of the integral
  SizeTrial count(sites::Stage laid, double coarsening) const;
  /// Lays with all limits that the factor needs, and counts.
  SizeTrial run(double factor);

  /// @brief Makes all further trials use this simplified boundary and its limits, because smaller triangles need no
  /// others.
  void hold(const FittedSize& fitted);

  double coarsening() const { return coarsening_; }
  std::size_t limits() const { return limits_.size(); }
  /// How often limits were searched since the factor last changed much.
  int limit_rounds() const { return limit_rounds_; }

private:
  void forget_limits(double factor);

  const LayoutContext& context_;
  double points_, coarsening_;
  std::vector<sizing::SizeLimit> limits_; // found so far
  double limits_factor_ = 0;              // for which the search for them began
  int limit_rounds_ = 0;                  // rounds of that search
  double limited_curves_ = 0;             // factor of the simplified curves for which it began; 0: of none
  FittedSize fitted_;                     // made for the last layout
};

/// @brief Returns the smallest relative size at some places: on the boundary of the shape and on a grid over it. The
/// grid covers places outside the shape, so invalid values are skipped. Local.
/// @throws GeometryError if no value is valid
double smallest_sampled_size(const LayoutContext& context);

} // namespace trime::fitting
