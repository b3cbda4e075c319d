// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/meshed_boundary.hpp"

#include "boundary/feature_report.hpp"
#include "boundary/feature_rule.hpp"
#include "comm/agree.hpp"
#include "fitting/outlook.hpp"
#include "fitting/points_of_length.hpp"
#include "polygon/chord_curve.hpp"

namespace trime::meshing {

MeshedBoundary::MeshedBoundary(const RunContext& run)
    : fixed_(run.given_boundary, run.domain.frame().container(), run.domain.fixed_points(), run.lattice, run.log) {
  boundary::check_choice_of_component(run.given_boundary, run.options.features);
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

Outlook look_ahead(const RunContext& run) {
  MeshedBoundary boundary(run);
  const fitting::LayoutContext layout{run.comm, run.domain, run.relative_size, run.fit,
                                      run.log,  run.timers, boundary.fixed()};
  const fitting::LaidOutlook ahead = fitting::look_ahead(layout);
  const sites::Stage& stage = ahead.stage;
  boundary.follow(stage.curves, stage.polygon.dropped);
  Outlook outlook;
  comm::run_agreed(run.comm, [&] {
    outlook.features = boundary::report_features(stage.polygon, {}, *stage.asked_size);
    boundary::report_losses(boundary.fixed().cornered_boundary(), boundary.curves(), stage.simplified,
                            stage.polygon.dropped, *stage.asked_size, run.lattice, outlook.features);
  });
  const double ratio = ahead.keeping_factor / ahead.factor;
  outlook.is_enough = ahead.keeps;
  outlook.keeps_all = ahead.keeps && ratio == 1;
  if (run.relative_size.is_uniform()) {
    outlook.keeping_edge_length = ratio * stage.asked_size->size({});
    outlook.keeping_points = fitting::points_of_length(run.given_boundary, outlook.keeping_edge_length);
  } else {
    outlook.keeping_points = ahead.points_at(ahead.keeping_factor);
    outlook.keeping_edge_length =
        fitting::estimated_size(run.given_boundary.area, run.given_boundary.length(), outlook.keeping_points);
  }
  return outlook;
}

} // namespace trime::meshing
