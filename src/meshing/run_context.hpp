// SPDX-License-Identifier: BSD-3-Clause
// The data that do not change during a run.
#pragma once

#include "meshing/plan.hpp"
#include "trime/comm/communicator.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/meshing/options.hpp"
#include "trime/sizing/size_field.hpp"

#include <algorithm>

namespace trime::meshing {

/// The input of a run, and the options of the modules that it uses. It keeps references.
struct RunContext {
  RunContext(const comm::Communicator& communicator, const geometry::Domain& its_domain, const sizing::SizeField& size,
             const MeshOptions& mesh_options, Log& its_log, TimerTable& its_timers)
      : comm(communicator), domain(its_domain), given_boundary(domain.boundary()), relative_size(size),
        options(mesh_options), fit(fit_options(mesh_options, size)), sweeps(sweep_options(mesh_options)),
        lattice(domain.frame().lattice()), log(its_log), timers(its_timers) {}

  const comm::Communicator& comm;
  const geometry::Domain& domain;           ///< owned by the caller
  const geometry::Boundary& given_boundary; ///< boundary of the domain
  const sizing::SizeField& relative_size;
  const MeshOptions options;
  const fitting::FitOptions fit;
  const sweep::SweepOptions sweeps;
  const geometry::Lattice& lattice; ///< coordinate lattice of the container
  Log& log;
  TimerTable& timers;
  const start::OldPoints* old = nullptr; ///< points of an old mesh, from which the run starts; owned by the caller

  /// Returns the longer side of the container.
  double side() const {
    const geometry::Box& container = domain.frame().container();
    return std::max(container.width(), container.height());
  }
};

} // namespace trime::meshing
