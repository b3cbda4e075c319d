// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/boundary_treatment.hpp"

#include "meshing/sweep_kernel.hpp"
#include "trime/comm/agree.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

/// The step of a rule, not longer than `limit`: the lead gives way first.
Step capped(Step step, double limit) {
  const auto cap = [limit](Vec2 v) {
    const double squared = geometry::squared_length(v);
    return squared > limit * limit ? (limit / std::sqrt(squared)) * v : v;
  };
  const Vec2 way = step.move + step.lead;
  if (geometry::squared_length(step.move) <= limit * limit && geometry::squared_length(way) <= limit * limit)
    return step;
  step.move = cap(step.move);
  step.lead = cap(step.move + step.lead) - step.move;
  return step;
}

/// Not across a border; along periodic axes there is none.
Vec2 into_box(Vec2 p, const mesh::TileGrid& grid) {
  const geometry::Box& box = grid.container();
  return {grid.periods().x > 0 ? p.x : std::clamp(p.x, box.min.x, box.max.x),
          grid.periods().y > 0 ? p.y : std::clamp(p.y, box.min.y, box.max.y)};
}

} // namespace

void MoveCounts::add(const MoveCounts& other) {
  moving += other.moving;
  pushed += other.pushed;
  deleted += other.deleted;
  max_move = std::max(max_move, other.max_move);
  power.add(other.power);
}

Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int allowed) {
  step = capped(step, move_cap * h);
  if (const Vec2 way = step.move + step.lead; geometry::squared_length(way) < (rest * h) * (rest * h))
    step = {};
  const Vec2 way = step.move + step.lead;
  Treated treated{context.lattice.snap(into_box(site.position + way, grid)), step.lead, site.pushes};
  const auto pushed = context.guard.correct(treated.position, h, context.lattice);
  if (!pushed)
    return treated;
  if (site.pushes >= allowed) {
    treated.deleted = true;
    return treated;
  }
  treated.position = context.lattice.snap(into_box(*pushed, grid));
  treated.lead = {};
  treated.pushed = true;
  ++treated.pushes;
  return treated;
}

MoveCounts settle_round(SiteState& state, const MoveContext& context, bool delete_all) {
  const mesh::BinnedPoints& points = state.points();
  std::vector<mesh::Site> sites(static_cast<std::size_t>(points.owned()));
  std::vector<std::uint8_t> deleted(sites.size(), 0);
  std::vector<MoveCounts> of_thread(static_cast<std::size_t>(std::max(1, thread_count())));
  const StarView view = view_of(state, context.size);
  const LocalIndex first_tile = points.first_tile();
  comm::run_agreed(state.comm(), [&] { // the size field may be a user's
    thread_loop(points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int thread) {
      const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
      MoveCounts counts;
      for (LocalIndex i = begin; i < end; ++i) {
        mesh::Site& site = sites[static_cast<std::size_t>(i)] = points.site(i);
        if (site.boundary != mesh::free_site)
          continue;
        const Treated treated =
            treat_step(context, state.grid(), site, view.size(i), {}, delete_all ? 0 : pushes_allowed);
        deleted[static_cast<std::size_t>(i)] = treated.deleted;
        counts.deleted += treated.deleted;
        counts.pushed += treated.pushed;
        site.position = treated.position;
        site.lead = treated.lead;
        site.pushes = treated.pushes;
      }
      of_thread[static_cast<std::size_t>(thread)].add(counts);
    });
  });
  MoveCounts all;
  for (const MoveCounts& counts : of_thread)
    all.add(counts);
  state.move_sites(sites, deleted);
  return all;
}

} // namespace trime::meshing
