// SPDX-License-Identifier: BSD-3-Clause
// Layouts at one factor of the size after the other, in search of the factor that yields the points asked for.
#pragma once

#include "fitting/density_integral.hpp"
#include "fitting/few_points.hpp"
#include "fitting/layout.hpp"
#include "fitting/stage_fit.hpp"
#include "sizing/lowered_size.hpp"

#include <vector>

namespace trime::fitting {

/// What came of one factor.
struct SizeTrial {
  StageFit fit;
  FittedSize fitted;
  DensityTotals totals;
  double points = 0; ///< on the boundary and inside
};

/// @brief Lays the boundary at a factor and counts the points. The limits that one trial finds, and the samples of the
/// size, are kept for the next, unless curves are simplified again: these find their own limits. All methods that lay
/// or count are collective.
class SizeTrials {
public:
  /// @param points about so many are wanted
  /// @param coarsening of the integral
  SizeTrials(const LayoutContext& context, double points, double coarsening)
      : context_(context), points_(points), coarsening_(coarsening) {}

  /// Takes curves that were simplified before. Local.
  void begin_with(const FittedSize& fitted) { fitted_.curves = fitted.curves; }

  /// @brief Boundary sites within the limits that are known. For a factor near by they are scaled with it; those of one
  /// far away would keep corners that this one leaves out.
  sites::Stage lay(double factor);
  /// Looks for more limits, a few times. True if there are any: for other trials, this one was laid without them.
  /// @param laid what lay() has returned last
  bool find_limits(const sites::Stage& laid);
  /// How many points a layout will have, or a number that is far too large if it is. @param coarsening of the integral
  /// @param laid what lay() has returned last
  SizeTrial count(sites::Stage laid, double coarsening) const;
  /// Lays with all limits that the factor needs, and counts.
  SizeTrial run(double factor);

  /// @brief From now on all trials have the boundary as it was simplified for this one, and its limits: smaller
  /// triangles need no others.
  void hold(const FittedSize& fitted);

  double coarsening() const { return coarsening_; }
  std::size_t limits() const { return limits_.size(); }
  /// So often limits were looked for since the factor last went far.
  int limit_rounds() const { return limit_rounds_; }

private:
  void forget_limits(double factor);

  const LayoutContext& context_;
  double points_, coarsening_;
  std::vector<sizing::SizeLimit> limits_; // found so far
  double limits_factor_ = 0;              // for which the search for them began
  int limit_rounds_ = 0;                  // of that search
  double limited_curves_ = 0;             // factor of the simplified curves for which it began; 0: of none
  FittedSize fitted_;                     // of the last layout
};

/// @brief Smallest relative size at some places around the shape: on its boundary and on a grid over it. The grid
/// covers places outside of the shape, so bad values are passed over here. Local.
/// @throws GeometryError if there is no valid one
double smallest_sampled_size(const LayoutContext& context);

} // namespace trime::fitting
