// SPDX-License-Identifier: BSD-3-Clause
// Which tiles and sites a sweep looks at, and the pass of the kernel over them.
#include "meshing/sweeper.hpp"

#include "meshing/tiles_around.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::meshing {
namespace {

using geometry::Vec2;

/// All tiles awake when a scale of the rule has changed by this share.
constexpr double scale_change = 1e-3;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

} // namespace

void Sweeper::classify() {
  const LocalIndex n = state_.points().owned();
  classes_.resize(at(n));
  marked_.assign(at(n), 0);
  fates_.assign(at(n), Fate::moved);
  const mesh::BinnedPoints& points = state_.points();
  const LocalIndex first_tile = points.first_tile(), tiles = points.last_tile() - first_tile;
  const geometry::Box box = state_.grid().tile_box(0);
  const double side = std::min(box.width(), box.height()), periodic_cap = task().largest_cap;
  wide_.assign(at(tiles), 0);
  thread_loop(tiles, 4, [&](std::ptrdiff_t t, int) { // edges are shorter than two caps, sites drift by a part of a tile
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    double largest = 0;
    for (LocalIndex i = begin; i < end; ++i)
      largest = std::max(largest, state_.sizes()[i]);
    wide_[static_cast<std::size_t>(t)] =
        2 * std::min(periodic_cap, builder_.cap(largest)) > (1 - 2 * drift_allowed) * side;
  });
  kinds_.assign(at(tiles), Tiles::inner);
  for (LocalIndex t = 0; t < tiles; ++t)
    for_tiles_around(state_.grid(), first_tile + t, [&](LocalIndex other) {
      if (other < first_tile || other >= points.last_tile())
        kinds_[at(t)] = Tiles::at_borders;
    });
  thread_loop(tiles, 4, [&](std::ptrdiff_t t, int) {
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i)
      classes_[at(i)] = class_of(i, first_tile + static_cast<LocalIndex>(t));
  });
  find_encroached_tiles();
  copied_.assign(at(tiles), 0);
  measured_.clear();
  is_measured_.clear();
  active_.assign(at(state_.grid().tile_count()), 1);
  tallies_.assign(at(tiles), {});
  retally_.assign(at(tiles), 0);
  awake_.assign(at(tiles), 1);
  all_awake_ = true;
}

/// Decides which tiles take part in this sweep.
void Sweeper::wake_tiles(const RuleParameters& rule, Tiles which) {
  const auto changed = [](double a, double b) { return std::fabs(a - b) > scale_change * b; };
  if (which == Tiles::inner) {
    all_awake_ = all_awake_ || rule.kind != waking_rule_.kind ||
                 changed(rule.length_scale, waking_rule_.length_scale) ||
                 changed(rule.area_scale, waking_rule_.area_scale);
    if (all_awake_)
      waking_rule_ = rule;
  }
  for (std::size_t t = 0; t < awake_.size(); ++t) {
    if (kinds_[t] != which)
      continue;
    bool awake = all_awake_ || wide_[t];
    for_tiles_around(state_.grid(), state_.points().first_tile() + static_cast<LocalIndex>(t),
                     [&](LocalIndex other) { awake = awake || active_[at(other)]; });
    awake_[t] = awake;
  }
}

SweepTask Sweeper::task() {
  mesh::BinnedPoints& points = state_.points();
  SweepTask task;
  task.positions = points.positions().data();
  task.leads = points.leads().data();
  task.rings = state_.stars().all_slots();
  task.degrees = state_.stars().degrees();
  task.classes = classes_.data();
  if (points.size() > 0) {
    task.sizes = state_.sizes().is_uniform() ? nullptr : state_.sizes().values().data();
    task.uniform_size = state_.sizes().is_uniform() ? state_.sizes()[0] : 1;
  }
  task.next_positions = points.next_positions().data();
  task.next_leads = points.next_leads().data();
  task.lattice_step = context_.lattice.step();
  task.inverse_lattice_step = context_.lattice.inverse_step();
  const geometry::Periods& periods = state_.grid().periods();
  task.box = state_.grid().container();
  if (periods.x > 0) { // no border along this axis
    task.box.min.x = -std::numeric_limits<double>::infinity();
    task.box.max.x = std::numeric_limits<double>::infinity();
  }
  if (periods.y > 0) {
    task.box.min.y = -std::numeric_limits<double>::infinity();
    task.box.max.y = std::numeric_limits<double>::infinity();
  }
  task.cap_factor = builder_.cap_factor();
  task.largest_cap = std::min(builder_.cap(), delaunay::StarBuilder::largest_cap(periods));
  const BoundaryGuard::CellView cells = context_.guard.cells();
  task.guard_cells = cells.states;
  task.guard_corner = cells.corner;
  task.guard_inverse_side = cells.inverse_side;
  task.guard_columns = cells.columns;
  task.guard_rows = cells.rows;
  return task;
}

void Sweeper::run_kernel(const SweepTask& sweep, Tiles which) {
  const mesh::BinnedPoints& points = state_.points();
  const SweepKernel kernel = sweep_kernels().sweep;
  const LocalIndex first_tile = points.first_tile();
  PerThread<Work> work;
  thread_loop(static_cast<std::ptrdiff_t>(awake_.size()), 1, [&](std::ptrdiff_t tile, int thread) {
    const std::size_t t = static_cast<std::size_t>(tile);
    if (kinds_[t] != which)
      return;
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    tallies_[t] = {};
    retally_[t] = 0;
    if (!awake_[t]) {
      if (!copied_[t]) {
        std::copy(sweep.positions + begin, sweep.positions + end, sweep.next_positions + begin);
        if (sweep.next_leads)
          std::fill(sweep.next_leads + begin, sweep.next_leads + end, Vec2{});
      }
      copied_[t] = 1;
      return;
    }
    copied_[t] = 0;
    if (!is_measured_.empty())
      is_measured_[t] = 0;
    Work& mine = work[thread];
    const std::size_t suspects = mine.suspects.size(), irregular = mine.irregular.size(), n = at(end - begin);
    mine.suspects.resize(suspects + n);
    mine.irregular.resize(irregular + n);
    mine.guarded.resize(std::max(mine.guarded.size(), n));
    SweepLeftovers leftovers{mine.suspects.data() + suspects, mine.irregular.data() + irregular, mine.guarded.data()};
    SweepTask here = sweep;
    here.least_class =
        trusts_boundary(first_tile + static_cast<LocalIndex>(t)) ? SiteClass::bordered : SiteClass::local;
    tallies_[t] = kernel(here, begin, end, leftovers);
    mine.suspects.resize(suspects + static_cast<std::size_t>(leftovers.suspect_count));
    mine.irregular.resize(irregular + static_cast<std::size_t>(leftovers.irregular_count));
    const bool pushes = treat_guarded(std::span(mine.guarded).first(static_cast<std::size_t>(leftovers.guarded_count)));
    retally_[t] = pushes || leftovers.suspect_count + leftovers.irregular_count > 0;
  });
  for (Work& mine : work) {
    mark(mine.suspects, suspects_);
    irregular_.insert(irregular_.end(), mine.irregular.begin(), mine.irregular.end());
  }
}

} // namespace trime::meshing
