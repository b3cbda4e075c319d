// SPDX-License-Identifier: BSD-3-Clause
// Set-up of a run: the size of the triangles, the sites on the boundary, the sites inside, and their distribution.
#pragma once

#include "meshing/site_state.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/meshing/boundary_guard.hpp"
#include "trime/meshing/boundary_sites.hpp"
#include "trime/meshing/options.hpp"
#include "trime/sizing/size_field.hpp"

#include <memory>

namespace trime::meshing {

/// All that the sweeps start from. Only `state` differs from rank to rank.
struct Layout {
  double edge_length = 1; ///< factor of the relative size; for a uniform field h itself
  std::unique_ptr<sizing::ScaledSize> size;
  BoundarySites boundary;
  std::unique_ptr<BoundaryGuard> guard;
  std::unique_ptr<SiteState> state;
};

/// What the set-up works from; see Mesher.
struct LayoutContext {
  const comm::Communicator& comm;
  const geometry::Boundary& boundary;
  const sizing::SizeField& relative_size;
  const MeshOptions& options;
  const geometry::Lattice& lattice;
  Log& log;
  TimerTable& timers;
};

/// @brief Boundary first, at a size estimated from area and perimeter; then the inner sites that the requested number
/// of points leaves room for. If their spacing differs from the boundary's by more than 2 % (a boundary full of corners
/// takes more sites than its length says), the boundary is laid again at that spacing, twice at most. Collective.
/// @throws ConfigError if the boundary alone needs more than the requested points at any size; GeometryError as
///         make_boundary_sites; on all ranks together
Layout lay_out(const LayoutContext& context);

} // namespace trime::meshing
