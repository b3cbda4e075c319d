// SPDX-License-Identifier: BSD-3-Clause
// Lays out a stage: its size field, its boundary sites and its grid. Also places the inner sites. Only Fit uses it.
#pragma once

#include "boundary/boundary_sizes.hpp"
#include "fitting/layout_context.hpp"
#include "fitting/simplified_curves.hpp"
#include "sites/stage.hpp"
#include "sizing/lowered_size.hpp"

#include <memory>
#include <vector>

namespace trime::fitting {

/// The data from which the size field of the last stage follows, and data that a layout keeps for the next one.
struct FittedSize {
  double factor = 1;                       ///< factor of the relative size; for a uniform field, h itself
  std::vector<sizing::SizeLimit> limits{}; ///< where the boundary needs smaller triangles than the size
  std::shared_ptr<const boundary::SizeSamples>
      samples{};         ///< samples of the relative size on the boundary of the shape; made when needed
  CurvesAtSize curves{}; ///< curves for the factor of the last layout
};

/// @brief Makes boundary sites, guard and empty container grid for about `expected` points, at `coarsening` times the
/// fitted size. Makes samples and curves of `fitted` if they are missing. Collective. @throws GeometryError on all
/// ranks together, see make_boundary_sites
sites::Stage lay_stage(const LayoutContext& context, FittedSize& fitted, double coarsening, double expected);

/// Returns the stage with an empty container grid for another number of points. Collective.
sites::Stage lay_again(const LayoutContext& context, sites::Stage stage, double expected);

/// Makes a stage with a polygon that replaces the boundary, for integrals over the shape but not for a mesh.
/// Collective.
sites::Stage lay_reference(const LayoutContext& context, polygon::BoundarySites polygon, double expected,
                           double grid_coarsening);

/// @brief Makes only boundary sites, without guard and state, during the search for a size. If the boundary needs far
/// more points than were asked for, the sites are left incomplete (`overfull`). Collective.
sites::Stage try_boundary(const LayoutContext& context, FittedSize& fitted, double expected);

/// Returns limits to add where the sites of a trial need smaller triangles than its size. Collective.
std::vector<sizing::SizeLimit> further_limits(const LayoutContext& context, const sites::Stage& trial);

/// Returns whether a uniform size would make bad triangles in narrow parts of the shape. Collective.
bool needs_lowering(const LayoutContext& context, const sites::Stage& laid);

/// Makes guard and empty container grid of a trial, unless it is overfull. Collective.
/// @param grid_coarsening spacing of the grid over that of the points; above 1 for a layout that will hold no points
void complete(const LayoutContext& context, sites::Stage& trial, double grid_coarsening = 1);

/// @brief Changes the size of a stage by so little that its sites may stay. Local.
void rescale(const LayoutContext& context, FittedSize& fitted, sites::Stage& laid, double scale);

/// Adds boundary sites and fixed points to the inner sites, which may lie on any rank, removes inner sites too near to
/// a fixed point, and distributes all. Collective.
void place_sites(const LayoutContext& context, sites::Stage& stage, mesh::SiteList inner);

} // namespace trime::fitting
