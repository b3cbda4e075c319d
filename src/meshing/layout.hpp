// SPDX-License-Identifier: BSD-3-Clause
// What the sweeps of one stage work on: the size of the triangles, the sites on the boundary, the sites inside, and
// their distribution; and how sites are placed for it.
#pragma once

#include "meshing/boundary_sizes.hpp"
#include "meshing/fixed_points.hpp"
#include "meshing/site_state.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/meshing/boundary_guard.hpp"
#include "trime/meshing/boundary_sites.hpp"
#include "trime/meshing/options.hpp"
#include "trime/meshing/start.hpp"
#include "trime/sizing/lowered_size.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>
#include <vector>

namespace trime::meshing {

/// What the set-up works from; see Mesher.
struct LayoutContext {
  const comm::Communicator& comm;
  const geometry::Boundary& boundary;
  const sizing::SizeField& relative_size;
  const MeshOptions& options;
  const geometry::Lattice& lattice;
  Log& log;
  TimerTable& timers;
  const FixedPoints& fixed;
};

/// What the size field of the last stage follows from.
struct FittedSize {
  double factor = 1;                            ///< of the relative size; for a uniform field h itself
  std::vector<sizing::SizeLimit> limits;        ///< where the boundary needs smaller triangles than that asks for
  std::shared_ptr<const SizeSamples> samples{}; ///< of the relative size, on the boundary; made when they are needed
};

/// All that the sweeps of a stage start from. Only `state` differs from rank to rank.
struct Layout {
  FittedSize fitted;
  double coarsening = 1;                             ///< h of this stage over that of the last
  double typical_size = 1;                           ///< edge length of as many equal triangles
  std::unique_ptr<sizing::ScaledSize> asked_size;    ///< of the last stage
  std::unique_ptr<sizing::LoweredSize> lowered_size; ///< the same within the limits; null without any
  std::unique_ptr<sizing::SizeField> size;           ///< of this stage
  BoundarySites boundary;
  std::unique_ptr<BoundaryGuard> guard;
  std::unique_ptr<SiteState> state;

  GlobalId fixed_inside = 0; ///< fixed points that are not on the boundary

  /// Sites that have their place before all others: those on the boundary, and the fixed ones inside.
  GlobalId placed_first() const { return static_cast<GlobalId>(boundary.sites.size()) + fixed_inside; }
};

/// Edge length of n nearly equilateral triangles' vertices on area A inside perimeter P: from V = (T + B)/2 + 1 with
/// T = A / (sqrt(3)/4 h^2) and B = P/h.
double estimated_size(double area, double perimeter, double n);

/// @brief Boundary sites for a size, and an empty container grid for about `expected` points. The size is lowered where
/// the boundary needs smaller triangles, see size_limits, and the boundary laid anew, in a few rounds. Collective.
/// @throws GeometryError as make_boundary_sites, on all ranks together
Layout lay_boundary(const LayoutContext& context, double factor, double expected);

/// The same at a size that was found before, or `coarsening` times it. Collective.
Layout lay_stage(const LayoutContext& context, const FittedSize& fitted, double coarsening, double expected);

/// The layout of a stage once more, with an empty container grid for another number of points. Collective.
Layout lay_again(const LayoutContext& context, Layout layout, double expected);

/// A polygon that stands for the boundary, for integrals over the shape: no layout for a mesh. Collective.
Layout lay_reference(const LayoutContext& context, BoundarySites polygon, double expected, double grid_coarsening);

/// So often limits of the size are looked for.
inline constexpr int most_lowering_rounds = 2;

/// @brief Boundary sites alone, with neither guard nor state, in search of a size. If the boundary takes far more
/// points than were asked for, its sites are not finished (`overfull`). Collective.
Layout try_boundary(const LayoutContext& context, const FittedSize& fitted, double expected);

/// Where the sites of a trial ask for smaller triangles than its size: limits to be added. Collective.
std::vector<sizing::SizeLimit> further_limits(const LayoutContext& context, const Layout& trial);

/// Guard and empty container grid of a trial, unless it is overfull. Collective.
/// @param grid_coarsening the grid's spacing over that of the points: above 1 for a layout that will hold none
void complete(const LayoutContext& context, Layout& trial, double grid_coarsening = 1);

/// @brief Another size of the same layout, so little larger or smaller that its sites may stay. Local.
void rescale(const LayoutContext& context, Layout& layout, double scale);

/// The tiles that this rank fills with sites: an even share, before anything is known of their number.
TileRange even_share(const Layout& layout, const comm::Communicator& comm);

/// Adds the boundary sites and the fixed ones to the inner ones, which may lie on any rank, takes out those too near to
/// a fixed one, and distributes all. Collective.
void place_sites(const LayoutContext& context, Layout& layout, mesh::SiteList inner);

} // namespace trime::meshing
