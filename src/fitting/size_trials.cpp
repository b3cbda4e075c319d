// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/size_trials.hpp"

#include "boundary/rules.hpp"
#include "fitting/rules.hpp"
#include "sizing/size_blocks.hpp"
#include "trime/core/error.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace trime::fitting {
namespace {

// [1] If the factor changes by a smaller share, limits of the size are scaled with it and not searched again.
constexpr double limits_reach = 0.15;

// [samples] Number along each side of the grid on which the smallest size over the shape is searched.
constexpr int samples_per_side = 33;

// [pieces] About the number of pieces of the boundary at which the size is sampled in that search.
constexpr std::size_t most_sampled_pieces = 4096;

} // namespace

using boundary::BoundaryRules;
using sites::Stage;

void SizeTrials::hold(const FittedSize& fitted) {
  fitted_.curves = fitted.curves;
  fitted_.curves.held = true;
  limits_ = fitted.limits;
  limits_factor_ = fitted.factor;
  limit_rounds_ = BoundaryRules::lowering_rounds;
}

Stage SizeTrials::lay(double factor) {
  const bool held = fitted_.curves.held;
  if (!held && !(std::fabs(factor - limits_factor_) < limits_reach * factor))
    forget_limits(factor);
  fitted_.factor = factor;
  fitted_.limits = limits_;
  if (!held)
    for (sizing::SizeLimit& limit : fitted_.limits)
      limit.size *= factor / limits_factor_;
  Stage laid = try_boundary(context_, fitted_, points_);
  const double curves_factor = fitted_.curves.found ? fitted_.curves.factor : 0;
  if (held || curves_factor == limited_curves_)
    return laid;
  limited_curves_ = curves_factor;
  if (limits_.empty())
    return laid;
  forget_limits(factor); // those of other curves would stand where these need none, and the reverse
  fitted_.limits.clear();
  return try_boundary(context_, fitted_, points_);
}

void SizeTrials::forget_limits(double factor) {
  limits_factor_ = factor;
  limits_.clear();
  limit_rounds_ = 0;
}

bool SizeTrials::find_limits(const Stage& laid) {
  if (limit_rounds_ == BoundaryRules::lowering_rounds || laid.polygon.overfull)
    return false;
  const std::vector<sizing::SizeLimit> more = further_limits(context_, laid);
  for (const sizing::SizeLimit& limit : more)
    limits_.push_back({limit.place, limit.size * (limits_factor_ / fitted_.factor)});
  limit_rounds_ = more.empty() ? BoundaryRules::lowering_rounds : limit_rounds_ + 1;
  return !more.empty();
}

SizeTrial SizeTrials::count(Stage laid, double coarsening) const {
  SizeTrial trial{{std::move(laid), 0, {}}, fitted_, {}, 0};
  Stage& stage = trial.fit.stage;
  complete(context_, stage, coarsening);
  if (!stage.polygon.overfull) {
    trial.totals = wanted_inside(context_, stage, coarsening,
                                 context_.options.points ? FitRules::hopelessly_many * points_ : INFINITY);
    trial.fit.inner = std::floor(trial.totals.sites);
  }
  trial.points = fitted_.steep.is_full && stage.polygon.overfull
                     ? FitRules::hopelessly_many * points_
                     : trial.fit.inner + static_cast<double>(stage.placed_first());
  return trial;
}

Stage SizeTrials::with_limits(Stage laid) {
  const double factor = fitted_.factor;
  while (find_limits(laid))
    laid = lay(factor);
  return laid;
}

/// Calls sample(p) for the start and the middle of some pieces of the boundary, spread evenly over them.
template <class Sample>
void for_each_sampled_piece(const geometry::Boundary& boundary, const Sample& sample) {
  std::size_t pieces = 0;
  for (const geometry::Loop& loop : boundary.loops)
    pieces += loop.pieces.size();
  const std::size_t stride = pieces / most_sampled_pieces + 1;
  for (const geometry::Loop& loop : boundary.loops)
    for (std::size_t k = 0; k < loop.pieces.size(); k += stride) {
      sample(loop.pieces[k].start);
      sample(loop.pieces[k].point(0.5 * loop.pieces[k].length()));
    }
}

double smallest_sampled_size(const LayoutContext& context) {
  std::vector<geometry::Vec2> places;
  const auto sample = [&](geometry::Vec2 p) { places.push_back(context.given_boundary.periods.wrap(p)); };
  for_each_sampled_piece(context.given_boundary, sample);
  const geometry::Box box =
      context.given_boundary.periods.any() ? context.domain.frame().container() : context.given_boundary.bounding_box();
  for (int j = 0; j < samples_per_side; ++j)
    for (int i = 0; i < samples_per_side; ++i)
      sample({box.min.x + (i + 0.5) / samples_per_side * box.width(),
              box.min.y + (j + 0.5) / samples_per_side * box.height()});
  double smallest = INFINITY;
  for (const double s : sizing::sizes_at(context.relative_size, places))
    if (sizing::is_valid_size(s) && s < smallest)
      smallest = s;
  if (!(smallest < INFINITY))
    throw GeometryError("the size field is not positive anywhere near the shape: expected a positive size everywhere");
  return smallest;
}

} // namespace trime::fitting
