// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/guard_treatment.hpp"

#include "comm/agree.hpp"
#include "core/random.hpp"
#include "core/thread_loop.hpp"
#include "sweep/rules.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using sites::SiteState;

// [rounds] Where no rule moves sites, an offender is pushed or chosen for deletion within this number of rounds: a
// bound, since patient_settling_rounds ends it.
constexpr int settling_rounds = 12;
// [rounds] From this round of settling on, every offender is deleted, so that settling ends.
constexpr int patient_settling_rounds = 8;

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

/// Does not cross a border; periodic axes have no border.
Vec2 into_box(Vec2 p, const mesh::TileGrid& grid) {
  const geometry::Box& box = grid.container();
  return {grid.periods().x > 0 ? p.x : std::clamp(p.x, box.min.x, box.max.x),
          grid.periods().y > 0 ? p.y : std::clamp(p.y, box.min.y, box.max.y)};
}

} // namespace

bool is_chosen(Vec2 p, int round) {
  return random_unit(static_cast<std::uint64_t>(round), RandomPurpose::deletion, std::bit_cast<std::uint64_t>(p.x),
                     std::bit_cast<std::uint64_t>(p.y)) < SweepRules::deleted_share;
}

Treated treat_step(const MoveContext& context, const mesh::TileGrid& grid, const mesh::Site& site, double h, Step step,
                   int allowed) {
  step = capped(step, SweepRules::move_cap * h);
  if (const Vec2 way = step.move + step.lead;
      geometry::squared_length(way) < (SweepRules::rest * h) * (SweepRules::rest * h))
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

namespace {

/// @brief All rounds of one site that no rule moves. It is pushed, then deleted when it is its turn, in the end in any
/// case. The discs stay, so that the site can be treated without the others. @return nothing if it may stay where it is
std::optional<Treated> settled(const MoveContext& context, const mesh::TileGrid& grid, mesh::Site site, double h) {
  std::optional<Treated> last;
  for (int round = 0; round < settling_rounds; ++round) {
    const bool delete_all = round >= patient_settling_rounds;
    Treated treated = treat_step(context, grid, site, h, {}, delete_all ? 0 : SweepRules::pushes_allowed);
    if (!treated.deleted && !treated.pushed)
      return last;
    treated.deleted &= delete_all || is_chosen(site.position, round);
    last = treated;
    if (treated.deleted)
      return last;
    site = {grid.periods().wrap(treated.position), site.boundary, treated.pushes, treated.lead};
  }
  return last;
}

} // namespace

bool settle_sites(SiteState& state, const MoveContext& context, double typical_size) {
  struct Offender {
    LocalIndex site;
    Treated treated;
  };
  const mesh::BinnedPoints& points = state.points();
  PerThread<std::vector<Offender>> of_thread;
  const LocalIndex first_tile = points.first_tile();
  thread_loop(points.last_tile() - first_tile, 8, [&](std::ptrdiff_t t, int thread) {
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i)
      if (points.boundary(i) == mesh::free_site && !context.guard.is_clear(points.position(i)))
        if (const auto treated = settled(context, state.grid(), points.site(i), typical_size))
          of_thread[thread].push_back({i, *treated});
  });
  std::int64_t offenders = 0;
  for (const std::vector<Offender>& list : of_thread)
    offenders += static_cast<std::int64_t>(list.size());
  if (state.comm().sum(offenders) == 0)
    return false;
  prepare_to_stay(state.points());
  std::vector<std::uint8_t> deleted(static_cast<std::size_t>(points.owned()), 0);
  for (const std::vector<Offender>& list : of_thread)
    for (const auto& [i, treated] : list) {
      const std::size_t at = static_cast<std::size_t>(i);
      state.points().next().positions()[at] = treated.position;
      if (!state.points().next().leads().empty())
        state.points().next().leads()[at] = treated.lead;
      state.points().set_pushes(i, treated.pushes);
      deleted[at] = treated.deleted;
    }
  state.move_sites(std::move(deleted));
  return true;
}

} // namespace trime::sweep
