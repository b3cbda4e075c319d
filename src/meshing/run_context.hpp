// SPDX-License-Identifier: BSD-3-Clause
// The data that stay the same throughout a run.
#pragma once

#include "meshing/plan.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/meshing/options.hpp"
#include "trime/sizing/size_field.hpp"

#include <algorithm>

namespace trime::meshing {

/// The input of a run, and the options of its parts. Keeps references.
struct RunContext {
  RunContext(const comm::Communicator& communicator, const geometry::Boundary& boundary, const sizing::SizeField& size,
             const MeshOptions& mesh_options, Log& its_log, TimerTable& its_timers)
      : comm(communicator), given_boundary(boundary), relative_size(size), options(mesh_options),
        fit(fit_options(mesh_options)), sweeps(sweep_options(mesh_options)), lattice(mesh_options.container),
        log(its_log), timers(its_timers) {}

  const comm::Communicator& comm;
  const geometry::Boundary& given_boundary; ///< as the caller owns it; its periods are those of the run
  const sizing::SizeField& relative_size;
  const MeshOptions options;
  const fitting::FitOptions fit;
  const sweep::SweepOptions sweeps;
  const geometry::Lattice lattice; ///< of the container
  Log& log;
  TimerTable& timers;

  /// Longer side of the container.
  double side() const { return std::max(options.container.width(), options.container.height()); }
};

} // namespace trime::meshing
