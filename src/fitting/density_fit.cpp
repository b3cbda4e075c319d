// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/density_fit.hpp"

#include "boundary/rules.hpp"
#include "comm/agree.hpp"
#include "fitting/count_estimate.hpp"
#include "fitting/factor_search.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "fitting/simplified_curves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace trime::fitting {
namespace {

// [trials] Of the factor of a graded size, each with a layout of the boundary: a bound; 3 to 6 are usual.
constexpr int most_trials = 40;

// [points asked for] With fewer the result says why.
constexpr double enough_points = 0.98;

// [rounds] Of estimates of the factor without layouts: a bound.
constexpr int estimate_rounds = 6;

// [1] A factor that changes by a smaller share ends the estimates.
constexpr double estimate_precision = 0.02;

// [1] A factor that changes by a smaller share ends the estimates if many corners make them rough in any case.
constexpr double crowded_precision = 0.2;

// [rounds] Largest number of rounds that find the factor and the limits of the size together, with one layout each.
constexpr int approach_rounds = 8;

// [boundary sites] If there are more limits of the size than this share, crowded_power applies, because many points lie
// around them.
constexpr double crowded_share = 0.05;

// [1] Power of the factor by which the number of points changes if limits hold many of them. It is weaker than -2,
// because limits stay. It is only the first guess of the secant.
constexpr double crowded_power = -1.6;

// [1] The last trial leaves out one round of limits; its count is multiplied by this to make up for them.
constexpr double limits_to_come = 1.08;

// [rounds] Largest number of rounds that find the factor for an edge length.
constexpr int edge_length_rounds = 12;

using boundary::BoundaryRules;
using DensityResult = std::variant<SizeTrial, TooFewPoints>;

class DensitySolver {
public:
  DensitySolver(const LayoutContext& context, const FittedSize* begin, double points, double coarsening)
      : context_(context), begin_(begin), points_(points), trials_(context, points, coarsening),
        rough_(coarsening < FitRules::reference_coarsening ? coarsening : 2 * coarsening),
        search_((1 - FitRules::goal_below * FitRules::close_enough) * points) {}

  DensityResult solve() {
    const geometry::Boundary& boundary = context_.given_boundary;
    if (begin_)
      trials_.begin_with(*begin_);
    if (context_.options.absolute)
      return trials_.run(1);
    const double uniform = context_.options.points ? estimated_size(boundary.area, boundary.length(), points_)
                                                   : *context_.options.edge_length;
    double smallest = 0;
    comm::run_agreed(context_.comm, [&] { smallest = smallest_sampled_size(context_); });
    if (context_.options.points) {
      if (generalises(context_) && !context_.domain.curves().empty())
        plain_ = plain_factor(uniform, uniform / smallest);
      DensityResult found = for_points(uniform, smallest);
      if (const SizeTrial* trial = std::get_if<SizeTrial>(&found); trial && is_too_coarse(*trial))
        return too_few_plainly();
      return found;
    }
    return for_edge_length(uniform / smallest);
  }

private:
  /// An estimate of the factor, and by how much crowding corners have raised it.
  struct Estimate {
    double factor, crowding;
  };
  /// @brief A factor not far from the result, without layouts. From above, since large factors make few points.
  double first_factor(double uniform, double factor) {
    const auto time = context_.timers.scope("start");
    CountEstimate estimate(context_, points_, FitRules::reference_spacing * uniform,
                           std::fmax(rough_, FitRules::reference_coarsening));
    const Estimate crowded = estimated_factor(estimate, factor, true);
    factor = crowded.factor;
    if (estimate.use_strides(factor)) {
      factor = estimated_factor(estimate, factor, false).factor;
      factor *= larger_for_limits(FitRules::limits_on_ragged, estimate.boundary_share(factor));
    } else if (crowded.crowding > 1 && generalises(context_)) { // most of these corners will go
      factor /= crowded.crowding;
      factor *=
          std::fmin(crowded.crowding, larger_for_limits(FitRules::limits_on_cornered, estimate.boundary_share(factor)));
    }
    search_.expect(FitRules::uncrowded_power);
    return factor;
  }

  /// Collective. @param may_crowd corners may raise the result
  Estimate estimated_factor(CountEstimate& estimate, double factor, bool may_crowd) {
    search_.expect(FitRules::uncrowded_power);
    for (int round = 0; round < estimate_rounds; ++round) {
      const std::optional<double> points = estimate.points(factor);
      if (!points || !(*points > 0))
        break;
      const double guess = search_.next(factor, *points), crowding = may_crowd ? estimate.crowding(guess) : 1;
      const double change = std::fabs(guess / factor - 1);
      factor = guess;
      if (change < (crowding > 1 ? crowded_precision : estimate_precision))
        return {factor * crowding, crowding};
    }
    return {factor, 1};
  }

  /// @brief The trial as it is if its sites are nearly as many as wanted, or with a size so little larger or smaller
  /// that the sites inside make up the difference: those on the boundary may stay.
  std::optional<SizeTrial> accepted(SizeTrial& trial) const {
    const sites::Stage& stage = trial.fit.stage;
    if (stage.polygon.overfull)
      return std::nullopt;
    if (trial.points <= points_ &&
        (trial.points >= (1 - FitRules::close_enough) * points_ || trial.points > points_ - 2))
      return std::move(trial);
    const double wanted = std::floor(points_ - static_cast<double>(stage.placed_first()));
    if (context_.options.min_size || context_.options.max_size || !(wanted > 0))
      return std::nullopt;
    const double scale = std::sqrt(trial.fit.inner / wanted);
    if (!(scale > FitRules::least_scale && scale < FitRules::most_scale))
      return std::nullopt;
    rescale(context_, trial.fitted, trial.fit.stage, scale);
    trial.fit.inner = wanted;
    return std::move(trial);
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
    for (int round = 0; round < approach_rounds; ++round) {
      sites::Stage laid = trials_.lay(factor);
      const bool first = trials_.limit_rounds() == 0;
      if (laid.curves) { // a trial without all of these limits says nothing
        search_.expect(crowded_power);
        return {factor, trials_.run_from(std::move(laid))};
      }
      search_.expect(crowded ? crowded_power : FitRules::uncrowded_power); // trials with other limits say nothing
      if (!trials_.find_limits(laid))
        return {factor, trials_.count(std::move(laid), trials_.coarsening())};
      if (first) {
        crowded =
            static_cast<double>(trials_.limits()) > crowded_share * static_cast<double>(laid.polygon.sites.size());
        continue;
      }
      const double growth = crowded && trials_.limit_rounds() == BoundaryRules::lowering_rounds ? limits_to_come : 1;
      factor = std::fmin(search_.next(factor, growth * trials_.count(std::move(laid), rough_).points), coarsest());
    }
    return {factor, std::nullopt};
  }

  /// What came of trials between factors that make too few and too many points.
  struct Search {
    std::optional<SizeTrial> accepted;
    SizeTrial best; ///< else: the one with most points of those that are not too many
    Fewest fewest;
    bool fits = false; ///< there is a best one
  };
  Search search(Approach approach, FactorBracket& bracket) {
    Search found;
    double factor = approach.factor;
    for (int round = 0; round < most_trials && !bracket.is_closed(); ++round) {
      SizeTrial trial = approach.trial ? *std::exchange(approach.trial, std::nullopt) : trials_.run(factor);
      const double points = trial.points;
      const bool overfull = trial.fit.stage.polygon.overfull;
      found.accepted = accepted(trial);
      if (found.accepted)
        return found;
      if (points > points_)
        found.fewest.consider(trial.fit.stage, points, trial.fit.inner <= FitRules::hopelessly_many * points_);
      const double guess = search_.next(factor, points);
      if (bracket.add(factor, points))
        found.best = std::move(trial);
      if (!bracket.has_upper() && factor >= coarsest())
        break;
      factor = std::fmin(bracket.next(factor, guess, overfull), coarsest());
      if (bracket.is_hopeless(factor))
        break;
    }
    found.fits = bracket.has_upper();
    return found;
  }

  /// @param uniform size of a uniform mesh with this number of points
  /// @param smallest size for a factor of 1
  DensityResult for_points(double uniform, double smallest) {
    FactorBracket bracket(points_, smallest, context_.domain.frame().container());
    const double first = begin_ ? begin_->factor : first_factor(uniform, uniform / smallest);
    Search found = search(approached(std::fmin(first, coarsest())), bracket);
    if (found.accepted)
      return std::move(*found.accepted);
    if (!found.fits && plain_ < INFINITY)
      return too_few_plainly();
    if (!found.fits)
      return too_small_size(context_, trials_.steep().limits).value_or(too_few_points(context_, found.fewest));
    const bool jumps = bracket.has_lower() && found.best.points < enough_points * points_;
    if (jumps && !found.best.fit.stage.curves && context_.options.features.keep_all &&
        is_jump(found.best.points, points_))
      return too_few_points(context_, found.fewest);
    SizeTrial best = jumps && found.best.fit.stage.curves ? with_these_curves(std::move(found.best), smallest)
                                                          : std::move(found.best);
    StageFit& fit = best.fit;
    if (fit.inner + static_cast<double>(fit.stage.placed_first()) < enough_points * points_)
      fit.shortage = context_.options.min_size
                         ? fmt::format("with min_size = {:g} no more points fit", *context_.options.min_size)
                         : "no more points fit, because the circles around the boundary edges must stay empty";
    return best;
  }

  /// Where the number of points jumps, a little smaller size keeps parts of the shape that take too many of them. Then
  /// the triangles become smaller and the simplified curves stay as they are.
  SizeTrial with_these_curves(SizeTrial best, double smallest) {
    trials_.hold(best.fitted);
    FactorBracket bracket(points_, smallest, context_.domain.frame().container());
    const double factor = best.fitted.factor;
    bracket.add(factor, best.points);
    search_.expect(FitRules::uncrowded_power);
    const double next = bracket.next(factor, search_.next(factor, best.points), false);
    Search finer = search({next, std::nullopt}, bracket);
    if (finer.accepted)
      return std::move(*finer.accepted);
    return finer.best.points > best.points ? std::move(finer.best) : std::move(best);
  }

  /// @brief Returns the factor without regard to narrow places inside. Collective. They may take nearly all points; the
  /// triangles elsewhere would then be large, and regions that the user gave would be simplified away. So there are too
  /// few points where the factor would be much larger than this one.
  /// @param factor with which the size is nowhere smaller than a uniform one
  double plain_factor(double uniform, double factor) {
    CountEstimate estimate(context_, points_, FitRules::reference_spacing * uniform,
                           std::fmax(rough_, FitRules::reference_coarsening));
    return estimated_factor(estimate, factor, false).factor;
  }

  double coarsest() const { return FitRules::coarsest_partition * plain_; }

  bool is_too_coarse(const SizeTrial& trial) const {
    return std::fmax(trial.fitted.factor, trial.fitted.curves.factor) > coarsest();
  }

  /// Returns how many points the plain factor takes. Collective.
  TooFewPoints too_few_plainly() {
    const SizeTrial needed = SizeTrials(context_, points_, trials_.coarsening()).run(plain_);
    Fewest fewest;
    fewest.consider(needed.fit.stage, needed.points, needed.fit.inner <= FitRules::hopelessly_many * points_);
    return too_few_points(context_, fewest);
  }

  SizeTrial for_edge_length(double factor) {
    const double wanted = *context_.options.edge_length;
    SizeTrial trial = trials_.run(factor);
    if (context_.lowers_uniform)
      return trial;
    for (int round = 0;; ++round) {
      const double ratio = trial.totals.mean_size > 0 ? wanted / trial.totals.mean_size : 1;
      if (std::fabs(ratio - 1) < FitRules::close_enough)
        break;
      if (round == edge_length_rounds) {
        context_.log.warning("edge_length = {} is not reached: the mean size is {:.6g}, because min_size or max_size "
                             "is near the edge length, or because the size jumps",
                             *context_.options.edge_length, trial.totals.mean_size);
        break;
      }
      factor *= ratio;
      trial = trials_.run(factor);
    }
    return trial;
  }

  const LayoutContext& context_;
  const FittedSize* begin_;
  double points_;
  SizeTrials trials_;
  double
      rough_; // coarsening during the search: with many points, cells that are twice as wide still err by less than 1 %
  FactorSearch search_;
  double plain_ = INFINITY; ///< the plain factor, if it limits the search
};

} // namespace

DensityResult fit_density(const LayoutContext& context, const FittedSize* begin, double points, double coarsening) {
  check_edge_length(context.options);
  return DensitySolver(context, begin, points, coarsening).solve();
}

} // namespace trime::fitting
