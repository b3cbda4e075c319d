// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/meshed_curves.hpp"

#include "fitting/layout_context.hpp"
#include "meshing/meshed_boundary.hpp"
#include "meshing/run_context.hpp"
#include "start/point_scheme.hpp"
#include "trime/core/log.hpp"
#include "trime/core/timer.hpp"

namespace trime::meshing {

geometry::Boundary meshed_curves(const comm::Communicator& comm, const geometry::Domain& domain,
                                 const sizing::SizeField& size, const MeshOptions& options) {
  Log quiet(LogLevel::error, comm.is_root()); // the run has printed its warnings
  TimerTable timers;
  const RunContext run(comm, domain, size, options, quiet, timers);
  MeshedBoundary boundary(run);
  const fitting::LayoutContext layout{comm, domain, size, run.fit, quiet, timers, boundary.fixed()};
  start::PointScheme scheme(layout, start_options(run.options));
  const sites::Stage last = scheme.last_from(scheme.first());
  boundary.follow(last.curves, last.polygon.dropped);
  return boundary.curves();
}

} // namespace trime::meshing
