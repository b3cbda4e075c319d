// SPDX-License-Identifier: BSD-3-Clause
// Finds the size of the triangles for the number of points or the edge length asked for. The boundary is simplified and
// laid out only by this class.
#pragma once

#include "fitting/few_points.hpp"
#include "fitting/lattice_fit.hpp"
#include "fitting/layout.hpp"
#include "fitting/size_trials.hpp"
#include "fitting/stage_fit.hpp"
#include "fitting/zoned_lattice.hpp"

#include <optional>
#include <span>
#include <variant>

namespace trime::fitting {

using generalise::JoinedLines;
using generalise::JoinedParts;

/// @brief Owns the factor of the size field, the limits of the size, the curves at that size, and samples of the size.
/// A search finds these data; then stages are laid out with that size or a multiple of it. Stages share the curves,
/// which do not change. Methods are collective unless their comment says that they are local.
class Fit {
public:
  explicit Fit(const LayoutContext& context) : context_(context) {}
  Fit(const Fit&) = delete; // stages refer to the sizes of the context
  Fit& operator=(const Fit&) = delete;

  /// @brief Finds the spacing of a lattice for a uniform size. The object does not change, because the stage that is
  /// returned holds its own size. If this search simplified the boundary, find_density begins with that boundary.
  /// @return as fit_lattice @throws as fit_lattice
  std::variant<LatticeFit, TooFewPoints> find_lattice();
  /// @brief Finds the factor and the limits for any size field. @param coarsening factor on the width of the cells of
  /// the integral
  /// @return see fit_density; after TooFewPoints the object is the same as before
  /// @throws as fit_density
  std::variant<StageFit, TooFewPoints> find_density(double points, double coarsening);

  /// @brief Fits a lattice to the size that find_density has found, if it is uniform except in zones in which the
  /// boundary lowers it. @return as fit_zoned_lattice @throws as lay()
  std::optional<ZonedLattice> find_zoned_lattice(StageFit& fit, double expected);

  /// Returns true if the uniform size of a lattice would make bad triangles in narrow parts of the shape.
  bool needs_lowering(const sites::Stage& laid) const { return fitting::needs_lowering(context_, laid); }
  /// Lets the boundary lower or raise a uniform size at some places from now on. Local. @pre needs_lowering() or
  /// raise_at_short_edges() has returned true
  void lower_uniform() { context_.lowers_uniform = true; }
  /// @brief Raises the size around boundary sites that are nearer to each other than `shortest_edge`, so that the
  /// boundary is simplified more there. @return false if nothing was raised; otherwise all that was found is out of
  /// date
  bool raise_at_short_edges(const sites::Stage& laid);
  /// From now on, components of the shape that are narrow everywhere are cut to pieces instead of widened, so that
  /// the mesh needs fewer points; and the boundary no longer lowers a uniform size. Local. @pre a search has returned
  /// TooFewPoints
  void cut_thin_components();

  /// Lays out a stage without inner sites for about `expected` points, at the size that was found times `coarsening`.
  /// @throws GeometryError as make_boundary_sites, on all ranks together
  sites::Stage lay(double coarsening, double expected) { return lay_stage(context_, fitted_, coarsening, expected); }
  /// Replaces the container grid of a stage by an empty one for another number of points.
  sites::Stage lay_again(sites::Stage stage, double expected) const {
    return fitting::lay_again(context_, std::move(stage), expected);
  }
  /// Lays out only the boundary, at a factor that another search has found; makes neither guard nor state.
  sites::Stage try_factor(double factor, double expected);
  /// Adds boundary sites and fixed points to the inner sites, which may lie on any rank; removes inner sites too near
  /// to a fixed point; and sends every site to its owner.
  void place_sites(sites::Stage& stage, mesh::SiteList inner) const {
    fitting::place_sites(context_, stage, std::move(inner));
  }

  /// Returns the input of the fit. Local.
  const LayoutContext& context() const { return context_; }
  /// Returns the factor by which the size field is multiplied. Local.
  double factor() const { return fitted_.factor; }
  /// Returns where the size is limited because it grows too fast, at the factor that was found. Local.
  const SteepPlaces& steep() const { return fitted_.steep; }
  /// Returns the places where the boundary needs smaller triangles than the size field asks for. Local.
  std::span<const sizing::SizeLimit> limits() const { return fitted_.limits; }
  /// Returns which curves were joined with interfaces in the last search. Local.
  const JoinedLines& joined_lines() const { return joined_; }

private:
  std::variant<SizeTrial, TooFewPoints> long_enough(double points, double coarsening);

  LayoutContext context_;
  FittedSize fitted_;
  std::optional<FittedSize> of_lattice_; // result of find_lattice, if it simplified curves
  JoinedLines joined_;
  int raisings_ = 0; // how often the size was raised
};

} // namespace trime::fitting
