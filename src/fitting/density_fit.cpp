// SPDX-License-Identifier: BSD-3-Clause
// The factor of a size that differs from place to place.
#include "fitting/count_estimate.hpp"

#include "boundary/rules.hpp"
#include "comm/agree.hpp"
#include "fitting/factor_search.hpp"
#include "fitting/few_points.hpp"
#include "fitting/rules.hpp"
#include "fitting/size_fit.hpp"
#include "fitting/size_trials.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace trime::fitting {
namespace {

using boundary::BoundaryRules;

class DensitySolver {
public:
  DensitySolver(const LayoutContext& context, double points, double coarsening)
      : context_(context), points_(points), trials_(context, points, coarsening),
        rough_(coarsening < FitRules::reference_coarsening ? coarsening : 2 * coarsening),
        search_((1 - FitRules::goal_below * FitRules::close_enough) * points) {}

  DensityFit solve() {
    const geometry::Boundary& boundary = context_.given_boundary;
    const double uniform = context_.options.points ? estimated_size(boundary.area, boundary.length(), points_)
                                                   : *context_.options.edge_length;
    double smallest = 0;
    comm::run_agreed(context_.comm, [&] { smallest = smallest_sampled_size(context_); });
    return context_.options.points ? for_points(uniform, smallest) : for_edge_length(uniform / smallest);
  }

private:
  /// @brief A factor not far from the result, without layouts. From above: large factors make few
  /// points, so no round costs more than the last.
  double estimated_factor(double uniform, double factor) {
    const auto time = context_.timers.scope("start");
    CountEstimate estimate(context_, points_, FitRules::reference_spacing * uniform,
                           std::fmax(rough_, FitRules::reference_coarsening));
    search_.expect(FitRules::uncrowded_power);
    for (int round = 0; round < FitRules::estimate_rounds; ++round) {
      const std::optional<double> points = estimate.points(factor);
      if (!points || !(*points > 0))
        break;
      const double guess = search_.next(factor, *points), crowding = estimate.crowding(guess);
      const double change = std::fabs(guess / factor - 1);
      factor = guess;
      if (change < (crowding > 1 ? FitRules::crowded_precision : FitRules::estimate_precision)) {
        factor *= crowding;
        break;
      }
    }
    search_.expect(FitRules::uncrowded_power);
    return factor;
  }

  /// @brief The trial as it is if its sites are nearly as many as wanted, or with a size so little larger or smaller
  /// that the sites inside make up the difference: those on the boundary may stay.
  std::optional<DensityFit> accepted(SizeTrial& trial) const {
    if (trial.fit.laid.stage.polygon.overfull)
      return std::nullopt;
    if (trial.points <= points_ &&
        (trial.points >= (1 - FitRules::close_enough) * points_ || trial.points > points_ - 2))
      return std::move(trial.fit);
    const double wanted = std::floor(points_ - static_cast<double>(trial.fit.laid.stage.placed_first()));
    if (context_.options.min_size || context_.options.max_size || !(wanted > 0))
      return std::nullopt;
    const double scale = std::sqrt(trial.fit.inner / wanted);
    if (!(scale > FitRules::least_scale && scale < FitRules::most_scale))
      return std::nullopt;
    rescale(context_, trial.fit.laid, scale);
    trial.fit.inner = wanted;
    return std::move(trial.fit);
  }

  /// A factor to go on from, and what came of it, if that is known.
  struct Approach {
    double factor;
    std::optional<SizeTrial> trial;
  };
  /// @brief Where limits lower the size much, they hold many points that no estimate knows of: factor and limits are
  /// found together, one layout for each step.
  Approach approached(double factor) {
    bool crowded = false;
    for (int round = 0; round < FitRules::approach_rounds; ++round) {
      FittedStage laid = trials_.lay(factor);
      const bool first = trials_.limit_rounds() == 0;
      search_.expect(crowded ? FitRules::crowded_power
                             : FitRules::uncrowded_power); // trials with other limits tell nothing
      if (!trials_.find_limits(laid))
        return {factor, trials_.count(std::move(laid), trials_.coarsening())};
      if (first) {
        crowded = static_cast<double>(trials_.limits()) >
                  FitRules::crowded_share * static_cast<double>(laid.stage.polygon.sites.size());
        continue;
      }
      const double growth =
          crowded && trials_.limit_rounds() == BoundaryRules::lowering_rounds ? FitRules::limits_to_come : 1;
      factor = search_.next(factor, growth * trials_.count(std::move(laid), rough_).points);
    }
    return {factor, std::nullopt};
  }

  /// What came of trials between factors that make too few and too many points.
  struct Search {
    std::optional<DensityFit> accepted;
    SizeTrial best; ///< else: the one with most points of those that are not too many
    Fewest fewest;
    bool fits = false; ///< there is a best one
  };
  Search search(Approach approach, FactorBracket& bracket) {
    Search found;
    double factor = approach.factor;
    for (int round = 0; round < FitRules::most_trials && !bracket.is_closed(); ++round) {
      SizeTrial trial = approach.trial ? *std::exchange(approach.trial, std::nullopt) : trials_.run(factor);
      const double points = trial.points;
      const bool overfull = trial.fit.laid.stage.polygon.overfull;
      found.accepted = accepted(trial);
      if (found.accepted)
        return found;
      if (points > points_)
        found.fewest.consider(trial.fit.laid.stage, points, trial.fit.inner <= FitRules::hopelessly_many * points_);
      const double guess = search_.next(factor, points);
      if (bracket.add(factor, points))
        found.best = std::move(trial);
      factor = bracket.next(factor, guess, overfull);
      if (bracket.is_hopeless(factor))
        break;
    }
    found.fits = bracket.has_upper();
    return found;
  }

  /// @param uniform size of a uniform mesh of so many points
  /// @param smallest size for a factor of 1
  DensityFit for_points(double uniform, double smallest) {
    FactorBracket bracket(points_, smallest, context_.domain.frame().container());
    Search found = search(approached(estimated_factor(uniform, uniform / smallest)), bracket);
    if (found.accepted)
      return std::move(*found.accepted);
    if (!found.fits)
      fail_for_few_points(context_, found.fewest);
    DensityFit fit = with_most_points(std::move(found), bracket.has_lower(), smallest);
    if (fit.inner + static_cast<double>(fit.laid.stage.placed_first()) < FitRules::enough_points * points_)
      fit.shortage = context_.options.min_size
                         ? fmt::format("min_size = {:g} leaves no room for more", *context_.options.min_size)
                         : "the discs of the chords leave no room for more";
    return fit;
  }

  /// @brief Where the number of points jumps, a little smaller size keeps parts of the shape that take too many of
  /// them. Then the triangles become smaller and the curves stay as they are.
  /// @param jumps smaller sizes were tried, and took too many
  DensityFit with_most_points(Search found, bool jumps, double smallest) {
    SizeTrial best = std::move(found.best);
    if (best.points >= FitRules::enough_points * points_ || !jumps)
      return std::move(best.fit);
    if (!best.fit.laid.stage.curves) { // nothing was simplified
      if (context_.options.features.keep_all && is_jump(best.points, points_))
        fail_for_few_points(context_, found.fewest);
      return std::move(best.fit);
    }
    trials_.hold(best.fit.laid);
    FactorBracket bracket(points_, smallest, context_.domain.frame().container());
    const double factor = best.fit.laid.fitted.factor;
    bracket.add(factor, best.points);
    search_.expect(FitRules::uncrowded_power);
    const double next = bracket.next(factor, search_.next(factor, best.points), false);
    Search finer = search({next, std::nullopt}, bracket);
    if (finer.accepted)
      return std::move(*finer.accepted);
    return std::move(finer.best.points > best.points ? finer.best.fit : best.fit);
  }

  DensityFit for_edge_length(double factor) {
    const double wanted = *context_.options.edge_length;
    SizeTrial trial = trials_.run(factor);
    if (context_.is_level)
      return std::move(trial.fit);
    for (int round = 0;; ++round) {
      const double ratio = trial.totals.mean_size > 0 ? wanted / trial.totals.mean_size : 1;
      if (std::fabs(ratio - 1) < FitRules::close_enough)
        break;
      if (round == FitRules::edge_length_rounds) {
        context_.log.warning(
            "edge_length = {} is not met: the mean size of the fitted field is {:.6g}; bounds near the "
            "edge length, or jumps of the size, leave no better factor",
            *context_.options.edge_length, trial.totals.mean_size);
        break;
      }
      factor *= ratio;
      trial = trials_.run(factor);
    }
    return std::move(trial.fit);
  }

  const LayoutContext& context_;
  double points_;
  SizeTrials trials_;
  double rough_; // coarsening on the way to a factor: of so many points twice as wide cells err by less than 1 % too
  FactorSearch search_;
};

} // namespace

DensityFit fit_density(const LayoutContext& context, double points, double coarsening) {
  check_edge_length(context.options);
  return DensitySolver(context, points, coarsening).solve();
}

} // namespace trime::fitting
