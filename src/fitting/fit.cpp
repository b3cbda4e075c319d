// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit.hpp"

#include "boundary/short_edges.hpp"
#include "comm/agree.hpp"
#include "fitting/density_fit.hpp"
#include "fitting/raised_places.hpp"
#include "fitting/rules.hpp"

#include <string>
#include <utility>

namespace trime::fitting {
std::variant<LatticeFit, TooFewPoints> Fit::find_lattice() {
  std::variant<LatticeFit, TooFewPoints> found = fit_lattice(context_);
  of_lattice_.reset();
  if (const LatticeFit* fit = std::get_if<LatticeFit>(&found)) {
    joined_ = fit->fitted.curves.joined;
    if (fit->fitted.curves.found)
      of_lattice_ = fit->fitted;
  }
  return found;
}

std::variant<StageFit, TooFewPoints> Fit::find_density(double points, double coarsening) {
  std::variant<SizeTrial, TooFewPoints> found = long_enough(points, coarsening);
  if (TooFewPoints* few = std::get_if<TooFewPoints>(&found))
    return std::move(*few);
  SizeTrial& trial = std::get<SizeTrial>(found);
  fitted_ = std::move(trial.fitted);
  joined_ = fitted_.curves.joined;
  fitted_.steep.sizes.reset(); // the factor stays, so its samples would only take memory during the sweeps
  return std::move(trial.fit);
}

std::optional<ZonedLattice> Fit::find_zoned_lattice(StageFit& fit, double expected) {
  std::optional<ZonedLattice> found = fit_zoned_lattice(context_, fitted_, fit, expected);
  if (found)
    fitted_ = found->fitted;
  return found;
}

/// A fit with a boundary without edges that are too short, if that is possible. Between two searches for the factor the
/// size is raised at the factor that the first one has found.
std::variant<SizeTrial, TooFewPoints> Fit::long_enough(double points, double coarsening) {
  std::variant<SizeTrial, TooFewPoints> found =
      fit_density(context_, of_lattice_ ? &*of_lattice_ : nullptr, points, coarsening);
  for (const SizeTrial* trial = std::get_if<SizeTrial>(&found); trial && raise_at_short_edges(trial->fit.stage);
       trial = std::get_if<SizeTrial>(&found)) {
    FittedSize begin;
    begin.factor = trial->fitted.factor;
    std::string shortage = trial->fit.shortage;
    while (raise_at_short_edges(SizeTrials(context_, points, coarsening).lay_with_limits(begin.factor))) {
    }
    if (shortage.empty()) {
      found = fit_density(context_, &begin, points, coarsening);
    } else { // larger sizes do not make more points
      SizeTrial last = SizeTrials(context_, points, coarsening).run(begin.factor);
      last.fit.shortage = std::move(shortage);
      found = std::move(last);
    }
  }
  return found;
}

bool Fit::raise_at_short_edges(const sites::Stage& laid) {
  const double shortest = context_.options.shortest_edge;
  if (!(shortest > 0) || laid.polygon.overfull || raisings_ == RaisingRules::most_raisings)
    return false;
  const auto time = context_.timers.scope("boundary");
  const std::vector<geometry::ShortEdge> edges = boundary::short_edges(context_.comm, laid.polygon, shortest);
  std::vector<sizing::LeastSize> places;
  comm::run_agreed(context_.comm, [&] { places = raised_around(edges, laid, context_.options, raisings_); });
  if (places.empty())
    return false;
  context_.log.info("shortest_edge: {} pairs of sites on the boundary are nearer to each other than {:g}; the shape is "
                    "simplified more at {} places",
                    edges.size(), shortest, places.size());
  context_.raised.insert(context_.raised.end(), places.begin(), places.end());
  ++raisings_;
  of_lattice_.reset();
  return true;
}

void Fit::cut_thin_components() {
  context_.cuts_thin_components = true;
  context_.lowers_uniform = false;
  of_lattice_.reset();
}

sites::Stage Fit::try_factor(double factor, double expected) {
  fitted_ = {};
  fitted_.factor = factor;
  return try_boundary(context_, fitted_, expected);
}

} // namespace trime::fitting
