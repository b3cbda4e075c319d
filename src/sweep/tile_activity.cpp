// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/tile_activity.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <cmath>

namespace trime::sweep {

void TileActivity::reset() {
  const mesh::BinnedPoints& points = state_.points();
  const LocalIndex first_tile = points.first_tile(), tiles = points.last_tile() - first_tile;
  const geometry::Box box = state_.grid().tile_box(0);
  const double side = std::min(box.width(), box.height());
  const double largest_cap = std::min(builder_.cap(), delaunay::StarBuilder::largest_cap(state_.grid().periods()));
  wide_.assign(static_cast<std::size_t>(tiles), 0);
  thread_loop(tiles, 4, [&](std::ptrdiff_t t, int) { // edges are shorter than two caps, sites drift by a part of a tile
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    double largest = 0;
    for (LocalIndex i = begin; i < end; ++i)
      largest = std::max(largest, state_.sizes()[i]);
    wide_[static_cast<std::size_t>(t)] =
        2 * std::min(largest_cap, builder_.cap(largest)) > (1 - 2 * SweepRules::drift_in_tiles) * side;
  });
  copied_.assign(static_cast<std::size_t>(tiles), 0);
  awake_.assign(static_cast<std::size_t>(tiles), 1);
  active_.assign(static_cast<std::size_t>(state_.grid().tile_count()), 1);
  all_awake_ = true;
}

void TileActivity::wake(const RuleParameters& rule, TilePlace which, std::span<const TilePlace> places) {
  const auto changed = [](double a, double b) { return std::fabs(a - b) > SweepRules::scale_change * b; };
  if (which == TilePlace::inner) {
    all_awake_ = all_awake_ || rule.mover != waking_rule_.mover ||
                 changed(rule.length_scale, waking_rule_.length_scale) ||
                 changed(rule.area_scale, waking_rule_.area_scale);
    if (all_awake_)
      waking_rule_ = rule;
  }
  for (std::size_t t = 0; t < awake_.size(); ++t) {
    if (places[t] != which)
      continue;
    bool awake = all_awake_ || wide_[t];
    for_tiles_around(state_.grid(), state_.points().first_tile() + static_cast<LocalIndex>(t),
                     [&](LocalIndex other) { awake = awake || active_[static_cast<std::size_t>(other)]; });
    awake_[t] = awake;
  }
}

void TileActivity::begin_move(mesh::BinnedPoints& points, std::span<const SweepTally> tallies) {
  drifts_before_ = points.drifts().of_tiles();
  for (LocalIndex tile = points.first_tile(); tile < points.last_tile(); ++tile) {
    const double squared = tallies[static_cast<std::size_t>(tile - points.first_tile())].squared_distance;
    points.drifts().set(tile, points.drifts().of(tile) + std::sqrt(squared) * SweepRules::drift_rounding);
    active_[static_cast<std::size_t>(tile)] = squared > 0;
  }
}

void TileActivity::finish_move() {
  const mesh::BinnedPoints& points = state_.points();
  for (std::size_t k = 0; k < active_.size(); ++k)
    if (const LocalIndex tile = static_cast<LocalIndex>(k); tile < points.first_tile() || tile >= points.last_tile())
      active_[k] = points.drifts().of_tiles()[k] > drifts_before_[k];
}

} // namespace trime::sweep
