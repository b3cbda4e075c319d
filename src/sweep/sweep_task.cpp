// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/sweep_task.hpp"

#include <algorithm>
#include <limits>

namespace trime::sweep {
namespace {

using sites::SiteState;

/// The container; without borders along periodic axes.
geometry::Box borders_of(const mesh::TileGrid& grid) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  geometry::Box box = grid.container();
  if (grid.periods().x > 0) {
    box.min.x = -infinity;
    box.max.x = infinity;
  }
  if (grid.periods().y > 0) {
    box.min.y = -infinity;
    box.max.y = infinity;
  }
  return box;
}

void set_sizes(SweepTask& task, const SiteState& state) {
  if (state.points().size() == 0)
    return;
  task.sizes = state.sizes().is_uniform() ? nullptr : state.sizes().values().data();
  task.uniform_size = state.sizes().is_uniform() ? state.sizes()[0] : 1;
}

} // namespace

SweepTask make_sweep_task(SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                          const SiteClasses& classes) {
  mesh::BinnedPoints& points = state.points();
  SweepTask task;
  task.positions = points.positions().data();
  task.leads = points.leads().data();
  task.rings = state.stars().all_slots();
  task.degrees = state.stars().degrees();
  task.classes = classes.data();
  task.boundary = points.boundaries().data();
  set_sizes(task, state);
  task.next_positions = points.next().positions().data();
  task.next_leads = points.next().leads().data();
  task.lattice_step = context.lattice.step();
  task.inverse_lattice_step = context.lattice.inverse_step();
  task.box = borders_of(state.grid());
  task.cap_factor = builder.cap_factor();
  task.largest_cap = std::min(builder.cap(), delaunay::StarBuilder::largest_cap(state.grid().periods()));
  task.guard = context.guard.cells();
  return task;
}

} // namespace trime::sweep
