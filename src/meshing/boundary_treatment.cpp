// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/boundary_treatment.hpp"

#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double move_cap = 0.4; // of h
constexpr double still = 0.005;  // of h
constexpr int pushes_allowed = 3;

Vec2 capped(Vec2 move, double limit) {
  const double squared = geometry::squared_length(move);
  return squared > limit * limit ? (limit / std::sqrt(squared)) * move : move;
}

Vec2 into_box(Vec2 p, const geometry::Box& box) {
  return {std::clamp(p.x, box.min.x, box.max.x), std::clamp(p.y, box.min.y, box.max.y)};
}

/// Applies `propose` (old site -> wanted position) to all owned inner sites and treats the boundary.
template <class Propose>
MoveCounts move_all(SiteState& state, const MoveContext& context, int allowed, const Propose& propose) {
  const mesh::BinnedPoints& points = state.points();
  std::vector<mesh::Site> sites(static_cast<std::size_t>(points.owned()));
  std::vector<std::uint8_t> deleted(sites.size(), 0);
  std::vector<MoveCounts> of_thread(static_cast<std::size_t>(std::max(1, thread_count())));
  const StarView view(points, state.stars(), context.size, &state.sizes());
  const geometry::Box& container = state.grid().container();
  const LocalIndex first_tile = points.first_tile();
  thread_loop(points.last_tile() - first_tile, 1, [&](std::ptrdiff_t t, int thread) {
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    MoveCounts counts;
    for (LocalIndex i = begin; i < end; ++i) {
      mesh::Site& site = sites[static_cast<std::size_t>(i)] = points.site(i);
      if (site.boundary >= 0)
        continue;
      const Vec2 from = site.position;
      const double h = view.size(i);
      site.position = context.lattice.snap(into_box(propose(i, from, h), container));
      if (const auto pushed = context.guard.correct(site.position, h, context.lattice)) {
        if (site.pushes >= allowed) {
          deleted[static_cast<std::size_t>(i)] = 1;
          ++counts.deleted;
          continue;
        }
        site.position = context.lattice.snap(into_box(*pushed, container));
        ++site.pushes;
        ++counts.pushed;
      }
      const double moved = geometry::length(site.position - from) / h;
      counts.moving += moved > still;
      counts.max_move = std::max(counts.max_move, moved);
    }
    MoveCounts& sum = of_thread[static_cast<std::size_t>(thread)];
    sum.moving += counts.moving;
    sum.pushed += counts.pushed;
    sum.deleted += counts.deleted;
    sum.max_move = std::max(sum.max_move, counts.max_move);
  });
  MoveCounts all;
  for (const MoveCounts& c : of_thread)
    all = {all.moving + c.moving, all.pushed + c.pushed, all.deleted + c.deleted, std::max(all.max_move, c.max_move)};
  state.move_sites(sites, deleted);
  return all;
}

} // namespace

MoveCounts move_by_rule(SiteState& state, const UpdateRule& rule, const MoveContext& context) {
  const StarView view(state.points(), state.stars(), context.size, &state.sizes());
  return move_all(state, context, pushes_allowed, [&](LocalIndex i, Vec2 from, double h) {
    return from + capped(rule.displacement(view, i), move_cap * h);
  });
}

MoveCounts settle_round(SiteState& state, const MoveContext& context, bool delete_all) {
  return move_all(state, context, delete_all ? 0 : pushes_allowed, [](LocalIndex, Vec2 from, double) { return from; });
}

} // namespace trime::meshing
