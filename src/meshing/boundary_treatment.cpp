// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/boundary_treatment.hpp"

#include "meshing/sweep_kernel.hpp"
#include "trime/comm/agree.hpp"
#include "trime/core/random.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <bit>
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

bool is_chosen(Vec2 p, int round) {
  return random_unit(static_cast<std::uint64_t>(round), RandomPurpose::deletion, std::bit_cast<std::uint64_t>(p.x),
                     std::bit_cast<std::uint64_t>(p.y)) < 1.0 / 3;
}

Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int allowed) {
  step = capped(step, move_cap * h);
  if (const Vec2 way = step.move + step.lead; geometry::squared_length(way) < (rest * h) * (rest * h))
    step = {};
  const Vec2 way = step.move + step.lead;
  return treat_place(context, grid, site, h, context.lattice.snap(into_box(site.position + way, grid)), step.lead,
                     allowed);
}

Treated treat_place(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h,
                    Vec2 place, Vec2 lead, int allowed) {
  Treated treated{place, lead, site.pushes};
  const auto pushed = context.guard.correct(treated.position, h, context.lattice);
  if (!pushed)
    return treated;
  treated.deleted = site.pushes >= allowed;
  treated.position = context.lattice.snap(into_box(*pushed, grid));
  treated.lead = {};
  treated.pushed = !treated.deleted;
  ++treated.pushes;
  return treated;
}

bool settle_round(SiteState& state, const MoveContext& context, int round, bool delete_all) {
  struct Offender {
    LocalIndex site;
    Treated treated;
  };
  const mesh::BinnedPoints& points = state.points();
  std::vector<std::vector<Offender>> of_thread(static_cast<std::size_t>(std::max(1, thread_count())));
  const StarView view = view_of(state, context.size);
  const LocalIndex first_tile = points.first_tile();
  comm::run_agreed(state.comm(), [&] { // the size field may be a user's
    thread_loop(points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int thread) {
      const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
      for (LocalIndex i = begin; i < end; ++i) {
        if (points.boundary(i) != mesh::free_site || context.guard.is_clear(points.position(i)))
          continue; // h there is not asked for
        Treated treated =
            treat_step(context, state.grid(), points.site(i), view.size(i), {}, delete_all ? 0 : pushes_allowed);
        if (treated.deleted && !delete_all && !is_chosen(points.position(i), round)) {
          treated.deleted = false;
          treated.pushed = true;
        }
        if (treated.pushed || treated.deleted)
          of_thread[static_cast<std::size_t>(thread)].push_back({i, treated});
      }
    });
  });
  std::int64_t offenders = 0;
  for (const std::vector<Offender>& list : of_thread)
    offenders += static_cast<std::int64_t>(list.size());
  if (state.comm().sum(offenders) == 0)
    return false;
  std::vector<mesh::Site> sites;
  sites.reserve(static_cast<std::size_t>(points.owned()));
  for (LocalIndex i = 0; i < points.owned(); ++i)
    sites.push_back(points.site(i));
  std::vector<std::uint8_t> deleted(sites.size(), 0);
  for (const std::vector<Offender>& list : of_thread)
    for (const auto& [i, treated] : list) {
      mesh::Site& site = sites[static_cast<std::size_t>(i)];
      site.position = treated.position;
      site.lead = treated.lead;
      site.pushes = treated.pushes;
      deleted[static_cast<std::size_t>(i)] = treated.deleted;
    }
  state.move_sites(sites, deleted);
  return true;
}

} // namespace trime::meshing
