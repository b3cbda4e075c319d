// SPDX-License-Identifier: BSD-3-Clause
// Finds the size of a mesh for the points or the edge length asked for. All simplification and layout of the boundary
// is done here.
#pragma once

#include "fitting/few_points.hpp"
#include "fitting/lattice_fit.hpp"
#include "fitting/layout.hpp"
#include "fitting/stage_fit.hpp"

#include <optional>
#include <span>
#include <variant>

namespace trime::fitting {

/// @brief Owns the factor of the size, its limits, the curves at that size, and samples of it. A search finds them;
/// then stages are laid out at that size or a coarser one. A stage shares the curves, which do not change. Methods are
/// collective unless their comment says that they are local.
class Fit {
public:
  explicit Fit(const LayoutContext& context) : context_(context) {}
  Fit(const Fit&) = delete; // stages refer to the sizes of the context
  Fit& operator=(const Fit&) = delete;

  /// @brief Finds the spacing of a lattice for a uniform size. The fit stays as it was: the stage holds its own size.
  /// If the boundary was simplified, find_density begins there.
  /// @return as fit_lattice @throws as fit_lattice
  std::variant<LatticeFit, TooFewPoints> find_lattice();
  /// @brief Finds the factor and its limits for any size. @param coarsening of the integral
  /// @return as fit_density; after too few points the fit is as it was before
  /// @throws as fit_density
  std::variant<StageFit, TooFewPoints> find_density(double points, double coarsening);

  /// Returns true if the uniform size of a lattice would make bad triangles in narrow parts of the shape.
  bool needs_lowering(const sites::Stage& laid) const { return fitting::needs_lowering(context_, laid); }
  /// Lets the boundary lower a uniform size at some places from now on. Local. @pre needs_lowering
  void lower_uniform() { context_.lowers_uniform = true; }
  /// Cuts components that are narrow everywhere from now on, so that fewer points suffice, and makes a uniform size
  /// uniform again. Local. @pre a search found too few points
  void cut_thin_components();

  /// Lays a stage without sites for about `expected` points, at `coarsening` times the size that was found.
  /// @throws GeometryError as make_boundary_sites, on all ranks together
  sites::Stage lay(double coarsening, double expected) { return lay_stage(context_, fitted_, coarsening, expected); }
  /// Gives a stage an empty container grid for another number of points.
  sites::Stage lay_again(sites::Stage stage, double expected) const {
    return fitting::lay_again(context_, std::move(stage), expected);
  }
  /// Lays the boundary at a factor that was found elsewhere, with neither guard nor state.
  sites::Stage try_factor(double factor, double expected);
  /// Adds boundary sites and fixed points to the inner sites, which may lie on any rank, removes inner sites too near
  /// to a fixed point, and distributes all.
  void place_sites(sites::Stage& stage, mesh::SiteList inner) const {
    fitting::place_sites(context_, stage, std::move(inner));
  }

  /// Returns the input of the fit. Local.
  const LayoutContext& context() const { return context_; }
  /// Returns the factor of the relative size. Local.
  double factor() const { return fitted_.factor; }
  /// Returns where the boundary needs smaller triangles than the size asked for. Local.
  std::span<const sizing::SizeLimit> limits() const { return fitted_.limits; }

private:
  LayoutContext context_;
  FittedSize fitted_;
  std::optional<FittedSize> of_lattice_; // with simplified curves
};

} // namespace trime::fitting
