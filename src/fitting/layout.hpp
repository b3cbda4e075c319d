// SPDX-License-Identifier: BSD-3-Clause
// Lays out a stage: its size field, its sites on the boundary, its grid; and places the sites inside.
#pragma once

#include "boundary/boundary_sizes.hpp"
#include "boundary/fixed_points.hpp"
#include "fitting/fit_options.hpp"
#include "fitting/simplified_curves.hpp"
#include "sites/stage.hpp"
#include "sizing/lowered_size.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/domain.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <vector>

namespace trime::fitting {

/// What the set-up works from. Keeps references; see Mesher.
struct LayoutContext {
  const comm::Communicator& comm;
  const geometry::Domain& domain;
  const sizing::SizeField& relative_size;
  const FitOptions& options;
  Log& log;
  TimerTable& timers;
  const boundary::FixedPoints& fixed; ///< with the boundary on which sites are laid
  bool cuts_thin_components = false;  ///< as generalise::Choice has it: no other boundary has so few points
  bool is_level = false;              ///< the relative size is the same everywhere, though its class does not say so
  const geometry::Boundary& given_boundary = domain.boundary(); ///< without the corners that fixed points make
  const geometry::Lattice& lattice = domain.frame().lattice();
};

/// What the size field of the last stage follows from.
struct FittedSize {
  double factor = 1;                     ///< of the relative size; for a uniform field h itself
  std::vector<sizing::SizeLimit> limits; ///< where the boundary needs smaller triangles than that asks for
  std::shared_ptr<const boundary::SizeSamples>
      samples{};         ///< of the relative size, on the boundary of the shape; made when they are needed
  CurvesAtSize curves{}; ///< for the last factor that was laid
};

/// A stage that was laid, and what its size field follows from.
struct FittedStage {
  FittedSize fitted;
  sites::Stage stage;
};

/// Edge length of n nearly equilateral triangles' vertices on area A inside perimeter P: from V = (T + B)/2 + 1 with
/// T = A / (sqrt(3)/4 h^2) and B = P/h.
double estimated_size(double area, double perimeter, double n);

/// @brief Boundary sites for a size, and an empty container grid for about `expected` points. The size is lowered where
/// the boundary needs smaller triangles, see size_limits, and the boundary laid anew, in a few rounds. Collective.
/// @throws GeometryError as make_boundary_sites, on all ranks together
FittedStage lay_boundary(const LayoutContext& context, double factor, double expected);

/// The same at a size that was found before, or `coarsening` times it. Collective.
FittedStage lay_stage(const LayoutContext& context, const FittedSize& fitted, double coarsening, double expected);

/// The same stage with an empty container grid for another number of points. Collective.
sites::Stage lay_again(const LayoutContext& context, sites::Stage stage, double expected);

/// A polygon that stands for the boundary, for integrals over the shape: no layout for a mesh. Collective.
sites::Stage lay_reference(const LayoutContext& context, polygon::BoundarySites polygon, double expected,
                           double grid_coarsening);

/// @brief Boundary sites alone, with neither guard nor state, in search of a size. If the boundary takes far more
/// points than were asked for, its sites are not finished (`overfull`). Collective.
FittedStage try_boundary(const LayoutContext& context, const FittedSize& fitted, double expected);

/// Where the sites of a trial ask for smaller triangles than its size: limits to be added. Collective.
std::vector<sizing::SizeLimit> further_limits(const LayoutContext& context, const sites::Stage& trial);

/// Would a uniform size make bad triangles in narrow parts of the shape? Collective.
bool needs_lowering(const LayoutContext& context, const sites::Stage& laid);

/// Guard and empty container grid of a trial, unless it is overfull. Collective.
/// @param grid_coarsening the grid's spacing over that of the points: above 1 for a layout that will hold none
void complete(const LayoutContext& context, sites::Stage& trial, double grid_coarsening = 1);

/// @brief Another size of the same stage, so little larger or smaller that its sites may stay. Local.
void rescale(const LayoutContext& context, FittedStage& laid, double scale);

/// Adds the boundary sites and the fixed ones to the inner ones, which may lie on any rank, takes out those too near to
/// a fixed one, and distributes all. Collective.
void place_sites(const LayoutContext& context, sites::Stage& stage, mesh::SiteList inner);

} // namespace trime::fitting
