// SPDX-License-Identifier: BSD-3-Clause
#include "trime/meshing/make_mesh.hpp"

#include "comm/agree.hpp"
#include "trime/core/timer.hpp"
#include "trime/meshing/mesher.hpp"
#include "trime/shape/traced_part.hpp"

#include <optional>
#include <vector>

namespace trime::meshing {
using sweep::StopReason;

MeshResult make_mesh(const comm::Communicator& comm, const geometry::Domain& domain, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log) {
  TimerTable timers; // leaves the counters to the caller
  return Mesher(comm, domain, size, options, log, timers).run();
}

MeshResult make_mesh(const comm::Communicator& comm, const shape::RegionShape& shape, const sizing::SizeField& size,
                     const MeshOptions& options, Log& log) {
  return make_mesh(comm, shape.domain(), size, options, log);
}

geometry::Domain traced_domain(const comm::Communicator& comm, const tracing::Shape& shape,
                               const geometry::Frame& frame) {
  std::optional<geometry::Domain> traced;
  comm::run_agreed(comm, [&] {
    std::vector<shape::Part> parts{shape::traced_part("shape", shape, frame)};
    traced.emplace(shape::domain_of(std::move(parts), "shape", frame));
  });
  return std::move(*traced);
}

bool is_complete(const MeshResult& result) {
  return result.stop_reason != StopReason::sweep_cap && mesh::all_passed(result.checks);
}

} // namespace trime::meshing
