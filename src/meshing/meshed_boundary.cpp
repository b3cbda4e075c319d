// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/meshed_boundary.hpp"

#include "boundary/feature_rule.hpp"
#include "polygon/chord_curve.hpp"

namespace trime::meshing {

MeshedBoundary::MeshedBoundary(const RunContext& run)
    : fixed_(run.given_boundary, run.domain.frame().container(), run.domain.fixed_points(), run.lattice, run.log) {
  fixed_.hold(run.domain);
  boundary::check_choice_of_component(run.given_boundary, run.options.features);
  fixed_.check_distances(run.options.shortest_edge.value_or(0));
}

void MeshedBoundary::follow(std::shared_ptr<const geometry::Boundary> curves, const polygon::DroppedLoops& dropped) {
  laid_ = std::move(curves);
  drops_loops_ = dropped.any();
  if (drops_loops_)
    remaining_ = boundary::boundary_without(laid(), dropped);
}

std::vector<polygon::LoopSummary> MeshedBoundary::loops(const polygon::BoundarySites& polygon) const {
  return polygon::summarize_loops(curves(), polygon);
}

} // namespace trime::meshing
