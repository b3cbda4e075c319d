// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/fit.hpp"

#include "fitting/density_fit.hpp"

#include <utility>

namespace trime::fitting {

std::variant<LatticeFit, TooFewPoints> Fit::find_lattice() {
  std::variant<LatticeFit, TooFewPoints> found = fit_lattice(context_);
  of_lattice_.reset();
  if (const LatticeFit* fit = std::get_if<LatticeFit>(&found); fit && fit->fitted.curves.found)
    of_lattice_ = fit->fitted;
  return found;
}

std::variant<StageFit, TooFewPoints> Fit::find_density(double points, double coarsening) {
  std::variant<SizeTrial, TooFewPoints> found =
      fit_density(context_, of_lattice_ ? &*of_lattice_ : nullptr, points, coarsening);
  if (TooFewPoints* few = std::get_if<TooFewPoints>(&found))
    return std::move(*few);
  SizeTrial& trial = std::get<SizeTrial>(found);
  fitted_ = std::move(trial.fitted);
  fitted_.steep.sizes.reset(); // the factor stays, so its samples would only take memory during the sweeps
  return std::move(trial.fit);
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
