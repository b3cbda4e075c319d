// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/boundary_treatment.hpp"

#include "trime/comm/agree.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double move_cap = 0.4; // of h
constexpr double still = 0.005;  // of h
constexpr int pushes_allowed = 3;

/// The step of a rule, not longer than `limit`: the lead gives way first.
Step capped(Step step, double limit) {
  const auto cap = [limit](Vec2 v) {
    const double squared = geometry::squared_length(v);
    return squared > limit * limit ? (limit / std::sqrt(squared)) * v : v;
  };
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

constexpr double largest_power = 0x1p10; // of one site, keeps FixedSum within its reach

/// Applies `propose` (local index, h -> Step) to all owned inner sites and treats the boundary.
template <class Propose>
MoveCounts move_all(SiteState& state, const MoveContext& context, int allowed, const Propose& propose) {
  const mesh::BinnedPoints& points = state.points();
  std::vector<mesh::Site> sites(static_cast<std::size_t>(points.owned()));
  std::vector<std::uint8_t> deleted(sites.size(), 0);
  std::vector<MoveCounts> of_thread(static_cast<std::size_t>(std::max(1, thread_count())));
  const StarView view = view_of(state, context.size);
  const LocalIndex first_tile = points.first_tile();
  comm::run_agreed(state.comm(), [&] { // the rule and the size field may be a user's
    thread_loop(points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int thread) {
      const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
      MoveCounts counts;
      for (LocalIndex i = begin; i < end; ++i) {
        mesh::Site& site = sites[static_cast<std::size_t>(i)] = points.site(i);
        if (site.boundary != mesh::free_site)
          continue;
        const Vec2 from = site.position;
        const double h = view.size(i);
        const Step step = propose(i, h);
        site.position = context.lattice.snap(into_box(from + step.move + step.lead, state.grid()));
        site.lead = step.lead;
        counts.power.add(std::clamp(step.power, -largest_power, largest_power));
        if (const auto pushed = context.guard.correct(site.position, h, context.lattice)) {
          if (site.pushes >= allowed) {
            deleted[static_cast<std::size_t>(i)] = 1;
            ++counts.deleted;
            continue;
          }
          site.position = context.lattice.snap(into_box(*pushed, state.grid()));
          site.lead = {};
          ++site.pushes;
          ++counts.pushed;
        }
        const double moved = geometry::length(site.position - from) / h;
        counts.moving += moved > still;
        counts.max_move = std::max(counts.max_move, moved);
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

} // namespace

void MoveCounts::add(const MoveCounts& other) {
  moving += other.moving;
  pushed += other.pushed;
  deleted += other.deleted;
  max_move = std::max(max_move, other.max_move);
  power.add(other.power);
}

MoveCounts move_by_rule(SiteState& state, const UpdateRule& rule, const MoveContext& context) {
  const StarView view = view_of(state, context.size);
  return move_all(state, context, pushes_allowed,
                  [&](LocalIndex i, double h) { return capped(rule.step(view, i), move_cap * h); });
}

MoveCounts settle_round(SiteState& state, const MoveContext& context, bool delete_all) {
  return move_all(state, context, delete_all ? 0 : pushes_allowed, [](LocalIndex, double) { return Step{}; });
}

} // namespace trime::meshing
