// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/meshed_boundary.hpp"

#include "boundary/feature_rule.hpp"
#include "polygon/chord_curve.hpp"

namespace trime::meshing {

MeshedBoundary::MeshedBoundary(const RunContext& run)
    : fixed_(run.given_boundary, run.options.container, run.options.fixed_points, run.lattice, run.log) {}

void MeshedBoundary::drop(const polygon::DroppedLoops& loops) {
  drops_loops_ = loops.any();
  if (drops_loops_)
    remaining_ = boundary::boundary_without(fixed_.cornered_boundary(), loops);
}

std::vector<polygon::LoopSummary> MeshedBoundary::loops(const polygon::BoundarySites& polygon) const {
  return polygon::summarize_loops(curves(), polygon);
}

} // namespace trime::meshing
