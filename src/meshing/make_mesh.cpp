// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/make_mesh.hpp"

#include "comm/agree.hpp"
#include "trime/core/timer.hpp"
#include "trime/meshing/mesher.hpp"

#include <optional>

namespace trime::meshing {
using sweep::StopReason;

MeshResult make_mesh(const comm::Communicator& comm, const shape::RegionShape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log) {
  TimerTable timers; // leaves the counters to the caller
  return Mesher(comm, shape.boundary(), size, options, log, timers).run();
}

MeshResult make_mesh(const comm::Communicator& comm, const tracing::Shape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log) {
  std::optional<shape::RegionShape> traced;
  comm::run_agreed(comm, [&] { traced.emplace(shape::traced(shape, geometry::Frame(options.container))); });
  return make_mesh(comm, *traced, size, options, log);
}

bool is_complete(const MeshResult& result) {
  return result.stop_reason != StopReason::sweep_cap && mesh::all_passed(result.checks);
}

} // namespace trime::meshing
