// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/size_trials.hpp"

#include "boundary/rules.hpp"
#include "fitting/rules.hpp"
#include "trime/core/error.hpp"

#include <cmath>
#include <utility>

namespace trime::fitting {
using boundary::BoundaryRules;
using sites::Stage;

void SizeTrials::hold(const FittedStage& laid) {
  curves_ = laid.fitted.curves;
  curves_.held = true;
  limits_ = laid.fitted.limits;
  limits_factor_ = laid.fitted.factor;
  limit_rounds_ = BoundaryRules::lowering_rounds;
}

FittedStage SizeTrials::lay(double factor) {
  if (!curves_.held && !(std::fabs(factor - limits_factor_) < FitRules::limits_reach * factor)) {
    limits_factor_ = factor;
    limits_.clear();
    limit_rounds_ = 0;
  }
  FittedSize fitted{factor, limits_, samples_, curves_};
  if (!curves_.held)
    for (sizing::SizeLimit& limit : fitted.limits)
      limit.size *= factor / limits_factor_;
  FittedStage laid = try_boundary(context_, fitted, points_);
  samples_ = laid.fitted.samples;
  curves_ = laid.fitted.curves;
  return laid;
}

bool SizeTrials::find_limits(const FittedStage& laid) {
  if (limit_rounds_ == BoundaryRules::lowering_rounds || laid.stage.polygon.overfull)
    return false;
  const std::vector<sizing::SizeLimit> more = further_limits(context_, laid.stage);
  for (const sizing::SizeLimit& limit : more)
    limits_.push_back({limit.place, limit.size * (limits_factor_ / laid.fitted.factor)});
  limit_rounds_ = more.empty() ? BoundaryRules::lowering_rounds : limit_rounds_ + 1;
  return !more.empty();
}

SizeTrial SizeTrials::count(FittedStage laid, double coarsening) const {
  SizeTrial trial;
  trial.fit.laid = std::move(laid);
  Stage& stage = trial.fit.laid.stage;
  complete(context_, stage, coarsening);
  if (!stage.polygon.overfull) {
    trial.totals = wanted_inside(context_, stage, coarsening,
                                 context_.options.points ? FitRules::hopelessly_many * points_ : INFINITY);
    trial.fit.inner = std::floor(trial.totals.sites);
  }
  trial.points = trial.fit.inner + static_cast<double>(stage.placed_first());
  return trial;
}

SizeTrial SizeTrials::run(double factor) {
  FittedStage laid = lay(factor);
  while (find_limits(laid))
    laid = lay(factor);
  return count(std::move(laid), coarsening_);
}

double smallest_sampled_size(const LayoutContext& context) {
  double smallest = INFINITY;
  const auto sample = [&](geometry::Vec2 p) {
    const double s = context.relative_size.size(context.given_boundary.periods.wrap(p));
    if (sizing::is_valid_size(s) && s < smallest)
      smallest = s;
  };
  std::size_t pieces = 0;
  for (const geometry::Loop& loop : context.given_boundary.loops)
    pieces += loop.pieces.size();
  const std::size_t stride = pieces / FitRules::most_sampled_pieces + 1;
  for (const geometry::Loop& loop : context.given_boundary.loops)
    for (std::size_t k = 0; k < loop.pieces.size(); k += stride) {
      sample(loop.pieces[k].start);
      sample(loop.pieces[k].point(0.5 * loop.pieces[k].length()));
    }
  const geometry::Box box =
      context.given_boundary.periods.any() ? context.domain.frame().container() : context.given_boundary.bounding_box();
  for (int j = 0; j < FitRules::samples_per_side; ++j)
    for (int i = 0; i < FitRules::samples_per_side; ++i)
      sample({box.min.x + (i + 0.5) / FitRules::samples_per_side * box.width(),
              box.min.y + (j + 0.5) / FitRules::samples_per_side * box.height()});
  if (!(smallest < INFINITY))
    throw GeometryError("the size field is positive nowhere near the shape: expected a positive size everywhere");
  return smallest;
}

} // namespace trime::fitting
