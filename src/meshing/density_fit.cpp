// SPDX-License-Identifier: BSD-3-Clause
// The factor of a size that differs from place to place.
#include "meshing/count_estimate.hpp"
#include "meshing/factor_search.hpp"
#include "meshing/few_points.hpp"
#include "meshing/size_fit.hpp"
#include "trime/comm/agree.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace trime::meshing {
namespace {

constexpr int density_rounds = 40, saturated_rounds = 8;
constexpr double close_enough = 0.004;     // of the points asked for
constexpr double reference_spacing = 0.25; // of the size of a uniform mesh
constexpr double reference_coarsening = 8; // of the integral, at least
constexpr int estimate_rounds = 6;
constexpr double estimate_precision = 0.02, crowded_precision = 0.2; // of the factor
constexpr int approach_rounds = 8;
constexpr double crowded_share = 0.05; // limits over boundary sites: from here on they hold many points
constexpr double crowded_power = -1.6; // of the factor, that the points then follow
constexpr double limits_reach = 0.15;  // of the factor, within which the limits of the size stand, scaled

/// Smallest relative size at some places around the shape: on its boundary and on a grid over it. Bad values are found
/// elsewhere: the grid covers places outside the shape.
double smallest_sampled(const LayoutContext& context) {
  constexpr int per_side = 33;
  constexpr std::size_t most_pieces = 4096;
  double smallest = INFINITY;
  const auto sample = [&](geometry::Vec2 p) {
    const double s = context.relative_size.size(context.boundary.periods.wrap(p));
    if (sizing::is_valid_size(s) && s < smallest)
      smallest = s;
  };
  std::size_t pieces = 0;
  for (const geometry::Loop& loop : context.boundary.loops)
    pieces += loop.pieces.size();
  const std::size_t stride = pieces / most_pieces + 1;
  for (const geometry::Loop& loop : context.boundary.loops)
    for (std::size_t k = 0; k < loop.pieces.size(); k += stride) {
      sample(loop.pieces[k].start);
      sample(loop.pieces[k].point(0.5 * loop.pieces[k].length()));
    }
  const geometry::Box box =
      context.boundary.periods.any() ? context.options.container : context.boundary.bounding_box();
  for (int j = 0; j < per_side; ++j)
    for (int i = 0; i < per_side; ++i)
      sample({box.min.x + (i + 0.5) / per_side * box.width(), box.min.y + (j + 0.5) / per_side * box.height()});
  if (!(smallest < INFINITY))
    throw GeometryError("the size field is positive nowhere near the shape: expected a positive size everywhere");
  return smallest;
}

class DensitySolver {
public:
  DensitySolver(const LayoutContext& context, double points, double coarsening)
      : context_(context), points_(points), coarsening_(coarsening),
        rough_(coarsening < reference_coarsening ? coarsening : 2 * coarsening),
        search_((1 - 0.4 * close_enough) * points) {}

  DensityFit solve() {
    const geometry::Boundary& boundary = context_.boundary;
    const double uniform = context_.options.points ? estimated_size(boundary.area, boundary.length(), points_)
                                                   : *context_.options.edge_length;
    double smallest = 0;
    comm::run_agreed(context_.comm, [&] { smallest = smallest_sampled(context_); });
    return context_.options.points ? for_points(uniform, smallest) : for_edge_length(uniform / smallest);
  }

private:
  struct Trial {
    DensityFit fit;
    DensityTotals totals;
    double points = 0;
  };

  /// @brief Boundary sites within the limits that are known. For a factor near by they are scaled with it; those of one
  /// far away would keep corners that this one leaves out.
  FittedStage lay(double factor) {
    if (!(std::fabs(factor - limits_factor_) < limits_reach * factor)) {
      limits_factor_ = factor;
      limits_.clear();
      limit_rounds_ = 0;
    }
    FittedSize fitted{factor, limits_, samples_};
    for (sizing::SizeLimit& limit : fitted.limits)
      limit.size *= factor / limits_factor_;
    FittedStage laid = try_boundary(context_, fitted, points_);
    samples_ = laid.fitted.samples;
    return laid;
  }

  /// Looks for more limits, a few times. True if there are any: for other trials, this one was laid without them.
  bool find_limits(const FittedStage& laid) {
    if (limit_rounds_ == most_lowering_rounds || laid.stage.boundary.overfull)
      return false;
    const std::vector<sizing::SizeLimit> more = further_limits(context_, laid.stage);
    for (const sizing::SizeLimit& limit : more)
      limits_.push_back({limit.place, limit.size * (limits_factor_ / laid.fitted.factor)});
    limit_rounds_ = more.empty() ? most_lowering_rounds : limit_rounds_ + 1;
    return !more.empty();
  }

  Trial counted(FittedStage laid, double coarsening) const {
    Trial trial;
    trial.fit.laid = std::move(laid);
    Stage& stage = trial.fit.laid.stage;
    complete(context_, stage, coarsening);
    if (!stage.boundary.overfull) {
      trial.totals = wanted_inside(context_, stage, coarsening);
      trial.fit.inner = std::floor(trial.totals.sites);
    }
    trial.points = trial.fit.inner + static_cast<double>(stage.placed_first());
    return trial;
  }

  Trial try_factor(double factor) {
    FittedStage laid = lay(factor);
    while (find_limits(laid))
      laid = lay(factor);
    return counted(std::move(laid), coarsening_);
  }

  /// @brief A factor not far from the result, without layouts. From above: large factors make few
  /// points, so no round costs more than the last.
  double estimated_factor(double uniform, double factor) {
    const auto time = context_.timers.scope("start");
    const CountEstimate estimate(context_, points_, reference_spacing * uniform,
                                 std::fmax(rough_, reference_coarsening));
    search_.expect(-2);
    for (int round = 0; round < estimate_rounds; ++round) {
      const std::optional<double> points = estimate.points(factor);
      if (!points || !(*points > 0))
        break;
      const double guess = search_.next(factor, *points), crowding = estimate.crowding(guess);
      const double change = std::fabs(guess / factor - 1);
      factor = guess;
      if (change < (crowding > 1 ? crowded_precision : estimate_precision)) {
        factor *= crowding;
        break;
      }
    }
    search_.expect(-2);
    return factor;
  }

  /// @brief The trial as it is if its sites are nearly as many as wanted, or with a size so little larger or smaller
  /// that the sites inside make up the difference: those on the boundary may stay.
  std::optional<DensityFit> accepted(Trial& trial) const {
    constexpr double least_scale = 0.98, most_scale = 1.02;
    if (trial.fit.laid.stage.boundary.overfull)
      return std::nullopt;
    if (trial.points <= points_ && (trial.points >= (1 - close_enough) * points_ || trial.points > points_ - 2))
      return std::move(trial.fit);
    const double wanted = std::floor(points_ - static_cast<double>(trial.fit.laid.stage.placed_first()));
    if (context_.options.min_size || context_.options.max_size || !(wanted > 0))
      return std::nullopt;
    const double scale = std::sqrt(trial.fit.inner / wanted);
    if (!(scale > least_scale && scale < most_scale))
      return std::nullopt;
    rescale(context_, trial.fit.laid, scale);
    trial.fit.inner = wanted;
    return std::move(trial.fit);
  }

  /// A factor to go on from, and what came of it, if that is known.
  struct Approach {
    double factor;
    std::optional<Trial> trial;
  };
  /// @brief Where limits lower the size much, they hold many points that no estimate knows of: factor and limits are
  /// found together, one layout for each step.
  Approach approached(double factor) {
    constexpr double growth_to_come[] = {1, 1, 1.08}; // of the points, by limits that the trial does without
    static_assert(std::size(growth_to_come) == most_lowering_rounds + 1);
    bool crowded = false;
    for (int round = 0; round < approach_rounds; ++round) {
      FittedStage laid = lay(factor);
      const bool first = limit_rounds_ == 0;
      search_.expect(crowded ? crowded_power : -2); // trials with other limits tell nothing
      if (!find_limits(laid))
        return {factor, counted(std::move(laid), coarsening_)};
      if (first) {
        crowded =
            static_cast<double>(limits_.size()) > crowded_share * static_cast<double>(laid.stage.boundary.sites.size());
        continue;
      }
      const double growth = crowded ? growth_to_come[limit_rounds_] : 1;
      factor = search_.next(factor, growth * counted(std::move(laid), rough_).points);
    }
    return {factor, std::nullopt};
  }

  /// @param uniform size of a uniform mesh of so many points
  /// @param smallest size for a factor of 1: where even that is far larger than the container, nothing will change
  DensityFit for_points(double uniform, double smallest) {
    Approach approach = approached(estimated_factor(uniform, uniform / smallest));
    double factor = approach.factor;
    const geometry::Box& container = context_.options.container;
    const double extent = std::max(container.width(), container.height()); // no site fits into such sizes
    const double largest = 64 * (container.width() + container.height()) / smallest;
    double low = 0, high = INFINITY, last = 0;
    Fewest fewest;
    int saturated = 0; // rounds in a row that changed nothing; the first ones may be too coarse for a site inside
    Trial best;
    for (int round = 0; round < density_rounds; ++round) {
      Trial trial = approach.trial ? *std::exchange(approach.trial, std::nullopt) : try_factor(factor);
      const double points = trial.points;
      const bool trial_overfull = trial.fit.laid.stage.boundary.overfull;
      if (std::optional<DensityFit> fit = accepted(trial))
        return std::move(*fit);
      if (points > points_)
        fewest.consider(trial.fit.laid.stage, points);
      const bool same = high < INFINITY && low == 0 && std::fabs(points - last) < 1e-3 * last;
      saturated = same ? saturated + 1 : 0;
      const double guess = search_.next(factor, points);
      last = points;
      if (points > points_) {
        low = factor;
      } else if (factor <= high) {
        high = factor;
        best = std::move(trial);
      }
      if (low * smallest > extent || saturated == saturated_rounds)
        break; // finer does not help: min_size, or the discs of the boundary fill the shape
      if (high < INFINITY && low > (1 - 1e-4) * high)
        break;
      if (high == INFINITY) {
        factor = std::max(guess, (trial_overfull ? 1.5 : 1.002) * factor);
        if (factor > largest)
          fail_for_few_points(context_, fewest);
      } else if (low == 0) {
        factor = std::min(guess, 0.998 * factor);
      } else {
        const double margin = 0.1 * (high - low);
        factor = std::clamp(guess, low + margin, high - margin);
      }
    }
    if (!(high < INFINITY) || (low > 0 && is_jump(best.points, points_)))
      fail_for_few_points(context_, fewest);
    if (best.points < 0.98 * points_)
      best.fit.shortage = context_.options.min_size
                              ? fmt::format("min_size = {:g} leaves no room for more", *context_.options.min_size)
                              : "the discs of the boundary segments leave no room for more";
    return std::move(best.fit);
  }

  DensityFit for_edge_length(double factor) {
    constexpr int rounds = 12;
    const double wanted = *context_.options.edge_length;
    Trial trial = try_factor(factor);
    for (int round = 0;; ++round) {
      const double ratio = trial.totals.mean_size > 0 ? wanted / trial.totals.mean_size : 1;
      if (std::fabs(ratio - 1) < close_enough)
        break;
      if (round == rounds) {
        context_.log.warning(
            "edge_length = {} is not met: the mean size of the fitted field is {:.6g}; bounds near the "
            "edge length, or jumps of the size, leave no better factor",
            *context_.options.edge_length, trial.totals.mean_size);
        break;
      }
      factor *= ratio;
      trial = try_factor(factor);
    }
    return std::move(trial.fit);
  }

  const LayoutContext& context_;
  double points_, coarsening_;
  double rough_; // coarsening on the way to a factor: of so many points twice as wide cells err by less than 1 % too
  FactorSearch search_;
  std::vector<sizing::SizeLimit> limits_; // found so far
  double limits_factor_ = 0;              // for which the search for them began
  int limit_rounds_ = 0;                  // of that search
  std::shared_ptr<const SizeSamples> samples_;
};

} // namespace

DensityFit fit_density(const LayoutContext& context, double points, double coarsening) {
  check_edge_length(context.options);
  return DensitySolver(context, points, coarsening).solve();
}

DensityTotals wanted_inside(const LayoutContext& context, const Stage& stage, double coarsening) {
  const auto time = context.timers.scope("start");
  const mesh::TileRange tiles = even_share(stage, context.comm);
  return integrate_density(context.comm, tiles,
                           DensitySampler(tiles.grid, *stage.guard, *stage.size, context.lattice, coarsening));
}

} // namespace trime::meshing
