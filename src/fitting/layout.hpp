// SPDX-License-Identifier: BSD-3-Clause
// Lays out a stage: its size field, its boundary sites and its grid. Also places the inner sites. Only the class Fit
// calls these functions.
#pragma once

#include "boundary/boundary_sizes.hpp"
#include "fitting/layout_context.hpp"
#include "fitting/simplified_curves.hpp"
#include "sites/stage.hpp"
#include "sizing/lowered_size.hpp"
#include "sizing/steep_sizes.hpp"

#include <memory>
#include <vector>

namespace trime::fitting {

/// Where the size asked for is too steep, at one factor of the size.
struct SteepPlaces {
  double factor = 0;    ///< 0: not looked for
  double gradation = 1; ///< growth from the places
  std::vector<sizing::SizeLimit> limits{};
  sizing::SteepSizes::Steepest steepest{{}, 0};
  bool is_capped = false; ///< true if places are missing, because there are too many
  bool is_full = false;   ///< true if the mesh would have too many points at these places, and others are missing
  std::shared_ptr<sizing::SteepSizes> sizes{}; ///< samples of the relative size; made when needed
};

/// The data that determine the size field of the last stage, and data that one layout keeps for the next.
struct FittedSize {
  double factor = 1;                       ///< factor on the relative size; for a uniform field, h itself
  std::vector<sizing::SizeLimit> limits{}; ///< where the boundary needs smaller triangles than the size asks for
  std::shared_ptr<const boundary::SizeSamples>
      samples{};         ///< samples of the relative size on the boundary of the shape; made when needed
  SteepPlaces steep{};   ///< where the size is limited because it grows too fast
  CurvesAtSize curves{}; ///< curves for the factor of the last layout
};

/// @brief Makes boundary sites, guard and empty container grid for about `expected` points, at the fitted size times
/// `coarsening`. Makes the samples and curves of `fitted` if they are missing. Collective. @throws GeometryError on all
/// ranks together, see make_boundary_sites
sites::Stage lay_stage(const LayoutContext& context, FittedSize& fitted, double coarsening, double expected);

/// Returns the stage with an empty container grid for another number of points. Collective.
sites::Stage lay_again(const LayoutContext& context, sites::Stage stage, double expected);

/// Makes a stage with a polygon that replaces the boundary, for integrals over the shape and not for a mesh.
/// Collective.
sites::Stage lay_reference(const LayoutContext& context, polygon::BoundarySites polygon, double expected,
                           double grid_coarsening);

/// @brief Makes only boundary sites, without guard and state, during the search for a size. If the boundary needs far
/// more points than were asked for, the function stops early and sets `overfull`. Collective.
sites::Stage try_boundary(const LayoutContext& context, FittedSize& fitted, double expected);

/// Returns further limits of the size, at places where the sites of a trial need smaller triangles than its size asks
/// for. Collective.
std::vector<sizing::SizeLimit> further_limits(const LayoutContext& context, const sites::Stage& trial);

/// Returns whether a uniform size would make bad triangles in narrow parts of the shape. Collective.
bool needs_lowering(const LayoutContext& context, const sites::Stage& laid);

/// Makes guard and empty container grid of a trial, unless it is overfull. Collective.
/// @param grid_coarsening factor on the spacing of the grid relative to that of the points; above 1 for a layout that
/// will hold no points
void complete(const LayoutContext& context, sites::Stage& trial, double grid_coarsening = 1);

/// @brief Multiplies the size of a stage by a number so close to 1 that its sites may stay where they are. Collective.
void rescale(const LayoutContext& context, FittedSize& fitted, sites::Stage& laid, double scale);

/// Adds boundary sites and fixed points to the inner sites, which may lie on any rank; removes inner sites too near to
/// a fixed point; and sends every site to its owner. Collective.
void place_sites(const LayoutContext& context, sites::Stage& stage, mesh::SiteList inner);

} // namespace trime::fitting
