// SPDX-License-Identifier: BSD-3-Clause
// Lays out a stage: its size field, its sites on the boundary, its grid; and places the sites inside. Fit alone uses
// it.
#pragma once

#include "boundary/boundary_sizes.hpp"
#include "fitting/layout_context.hpp"
#include "fitting/simplified_curves.hpp"
#include "sites/stage.hpp"
#include "sizing/lowered_size.hpp"

#include <memory>
#include <vector>

namespace trime::fitting {

/// What the size field of the last stage follows from, and what a layout leaves for the next one.
struct FittedSize {
  double factor = 1;                       ///< of the relative size; for a uniform field h itself
  std::vector<sizing::SizeLimit> limits{}; ///< where the boundary needs smaller triangles than that asks for
  std::shared_ptr<const boundary::SizeSamples>
      samples{};         ///< of the relative size, on the boundary of the shape; made when they are needed
  CurvesAtSize curves{}; ///< for the last factor that was laid
};

/// @brief Boundary sites, guard and empty container grid for about `expected` points, at `coarsening` times the fitted
/// size. Collective. @throws GeometryError as make_boundary_sites, on all ranks together
/// @param fitted its samples and its curves are made if they are missing
sites::Stage lay_stage(const LayoutContext& context, FittedSize& fitted, double coarsening, double expected);

/// The same stage with an empty container grid for another number of points. Collective.
sites::Stage lay_again(const LayoutContext& context, sites::Stage stage, double expected);

/// A polygon that stands for the boundary, for integrals over the shape: no layout for a mesh. Collective.
sites::Stage lay_reference(const LayoutContext& context, polygon::BoundarySites polygon, double expected,
                           double grid_coarsening);

/// @brief Boundary sites alone, with neither guard nor state, in search of a size. If the boundary takes far more
/// points than were asked for, its sites are not finished (`overfull`). Collective.
sites::Stage try_boundary(const LayoutContext& context, FittedSize& fitted, double expected);

/// Where the sites of a trial ask for smaller triangles than its size: limits to be added. Collective.
std::vector<sizing::SizeLimit> further_limits(const LayoutContext& context, const sites::Stage& trial);

/// Would a uniform size make bad triangles in narrow parts of the shape? Collective.
bool needs_lowering(const LayoutContext& context, const sites::Stage& laid);

/// Guard and empty container grid of a trial, unless it is overfull. Collective.
/// @param grid_coarsening the grid's spacing over that of the points: above 1 for a layout that will hold none
void complete(const LayoutContext& context, sites::Stage& trial, double grid_coarsening = 1);

/// @brief Another size of the same stage, so little larger or smaller that its sites may stay. Local.
void rescale(const LayoutContext& context, FittedSize& fitted, sites::Stage& laid, double scale);

/// Adds the boundary sites and the fixed ones to the inner ones, which may lie on any rank, takes out those too near to
/// a fixed one, and distributes all. Collective.
void place_sites(const LayoutContext& context, sites::Stage& stage, mesh::SiteList inner);

} // namespace trime::fitting
