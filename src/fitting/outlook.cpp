// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/outlook.hpp"

#include "boundary/feature_rule.hpp"
#include "boundary/rules.hpp"
#include "comm/agree.hpp"
#include "fitting/fit.hpp"
#include "fitting/points_of_length.hpp"
#include "fitting/rules.hpp"
#include "fitting/simplified_curves.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>

namespace trime::fitting {
namespace {

/// From points on the boundary and inside to another size: the first grow like its inverse, the others like the square
/// of that.
double scale_for(double on_boundary, double inner, double points) {
  if (!(inner > 0))
    return points / std::fmax(1, on_boundary);
  return (std::sqrt(on_boundary * on_boundary + 4 * inner * points) - on_boundary) / (2 * inner);
}

/// The factor of the size, and how many of the points have their places before all others.
struct Found {
  double factor = 0, placed_first = 0;
};

/// For the points or the edge length in the context's options.
std::variant<Found, TooFewPoints> fitted(const LayoutContext& context, double points) {
  Fit fit(context);
  if (context.relative_size.is_uniform()) {
    std::variant<LatticeFit, TooFewPoints> lattice = fit.find_lattice();
    if (TooFewPoints* few = std::get_if<TooFewPoints>(&lattice))
      return std::move(*few);
    const sites::Stage& stage = std::get<LatticeFit>(lattice).stage;
    if (!context.options.features.refine_narrow || !fit.needs_lowering(stage))
      return Found{stage.asked_size().size({}) / context.relative_size.size({}),
                   static_cast<double>(stage.placed_first())};
    fit.lower_uniform(); // as the run does
  }
  std::variant<StageFit, TooFewPoints> density = fit.find_density(points, LayoutRules::coarse_integral);
  if (TooFewPoints* few = std::get_if<TooFewPoints>(&density))
    return std::move(*few);
  return Found{fit.factor(), static_cast<double>(std::get<StageFit>(density).stage.placed_first())};
}

/// The factor that a run of few points would go by, and from it that of the points asked for.
std::variant<double, TooFewPoints> fitted_factor(const LayoutContext& context, double points) {
  if (context.options.absolute)
    return 1.0;
  FitOptions options = context.options;
  const double fewer = std::fmin(points, LayoutRules::outlook_points), longer = std::sqrt(points / fewer);
  if (options.points)
    options.points = static_cast<GlobalId>(fewer);
  else
    options.edge_length = *options.edge_length * longer;
  const LayoutContext small{context.comm, context.domain, context.relative_size, options,
                            context.log,  context.timers, context.fixed,         context.cuts_thin_components};
  std::variant<Found, TooFewPoints> result = fitted(small, fewer);
  if (TooFewPoints* few = std::get_if<TooFewPoints>(&result))
    return std::move(*few);
  const Found found = std::get<Found>(result);
  if (points == fewer)
    return found.factor;
  return found.factor / (options.points ? scale_for(found.placed_first, fewer - found.placed_first, points) : longer);
}

} // namespace

bool keeps_all(const LayoutContext& context, double factor) {
  const geometry::Boundary& given = context.fixed.cornered_boundary();
  const bool by_one = one_rank_simplifies(context);
  bool keeps = false;
  comm::run_agreed(context.comm, [&] {
    if (by_one && !context.comm.is_root())
      return;
    const sizing::ScaledSize size = context.asked_size(factor);
    keeps =
        !boundary::drop_small_loops(given, size, boundary::BoundaryRules::least_perimeter, context.fixed.held())
             .any() &&
        !(generalises(context) && generalise::would_generalise(given, generalised_size(context, size), context.lattice,
                                                               generalise_choice(context), context.fixed.held()));
  });
  return by_one ? context.comm.sum(std::int64_t{keeps}) > 0 : keeps;
}

// Down by powers of ten, then halves of the last of them on a logarithmic scale.
void find_keeping_factor(const LayoutContext& context, LaidOutlook& outlook) {
  const double factor = outlook.factor;
  const double on_boundary = std::fmax(1, outlook.placed_first);
  const double least = std::fmin(1 / LayoutRules::outlook_step, on_boundary / LayoutRules::outlook_sites) * factor;
  double low = factor, high = factor; // at `high` something is simplified
  outlook.keeps = context.options.features.keep_all || keeps_all(context, factor);
  for (int trial = 1; trial < LayoutRules::outlook_trials && !(outlook.keeps && low == factor); ++trial) {
    if (!outlook.keeps && low == least)
      break;
    const double next = outlook.keeps ? std::sqrt(low * high) : std::fmax(least, high / LayoutRules::outlook_step);
    const bool keeps = keeps_all(context, next);
    (keeps || !outlook.keeps ? low : high) = next;
    if (!keeps)
      high = next;
    outlook.keeps |= keeps;
  }
  outlook.keeping_factor = low;
}

double LaidOutlook::points_at(double other) const {
  const double ratio = factor / other;
  const double on_boundary = std::fmin(points, placed_first);
  return ratio * (on_boundary + ratio * (points - on_boundary));
}

sites::Stage look_ahead(const LayoutContext& given, LaidOutlook& outlook) {
  LayoutContext context = given;
  std::variant<double, TooFewPoints> factor = fitted_factor(context, outlook.points);
  if (std::holds_alternative<TooFewPoints>(factor) &&
      !given.options.features.keep_all) { // a run goes on like this, too
    context.cuts_thin_components = true;
    factor = fitted_factor(context, outlook.points);
  }
  if (const TooFewPoints* few = std::get_if<TooFewPoints>(&factor))
    throw ConfigError(few->reason);
  outlook.factor = std::get<double>(factor);
  sites::Stage stage = Fit(context).try_factor(outlook.factor, outlook.points);
  outlook.placed_first = static_cast<double>(stage.placed_first());
  return stage;
}

} // namespace trime::fitting
