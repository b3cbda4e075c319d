// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/tile_activity.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace trime::sweep {
namespace {

double drift_after(const mesh::BinnedPoints& points, std::size_t t, const SweepTally& tally) {
  return points.drifts().of(static_cast<LocalIndex>(t)) +
         std::sqrt(tally.squared_distance) * SweepRules::drift_rounding;
}

} // namespace

void SiteActivity::reset() {
  const mesh::BinnedPoints& points = state_.points();
  flags_.resize(at(points.owned()));
  PerThread<std::vector<LocalIndex>> watchers;
  thread_loop(points.last_tile() - points.first_tile(), 4, [&](std::ptrdiff_t t, int thread) {
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    const bool sees_ghosts = classes_.around().place(static_cast<std::size_t>(t)) == TilePlace::at_border;
    for (LocalIndex i = begin; i < end; ++i)
      if (classes_[i] < SiteClass::bordered ? classes_[i] != SiteClass::held : sees_ghosts && has_ghost(i))
        watchers[thread].push_back(i);
  });
  watchers_.clear();
  for (const std::vector<LocalIndex>& list : watchers)
    watchers_.insert(watchers_.end(), list.begin(), list.end());
  std::sort(watchers_.begin(), watchers_.end());
}

void SiteActivity::wake_tile(LocalIndex tile) {
  const auto [begin, end] = state_.points().tile_range(tile);
  for (LocalIndex i = begin; i < end; ++i) {
    flags_[at(i)] = classes_[i] == SiteClass::held ? 0 : SiteFlags::watched | SiteFlags::awake;
  }
}

bool SiteActivity::any_awake(LocalIndex tile) const {
  const auto [begin, end] = state_.points().tile_range(tile);
  std::uint8_t all = 0;
  for (LocalIndex i = begin; i < end; ++i)
    all |= flags_[at(i)];
  return (all & SiteFlags::awake) != 0;
}

bool SiteActivity::has_ghost(LocalIndex i) const {
  return std::ranges::any_of(state_.stars().ring(i),
                             [owned = state_.points().owned()](LocalIndex neighbour) { return neighbour >= owned; });
}

void SiteActivity::note_rings(std::span<const LocalIndex> sites) {
  const std::ptrdiff_t before = std::ssize(watchers_);
  std::copy_if(sites.begin(), sites.end(), std::back_inserter(watchers_), [this](LocalIndex i) {
    return classes_[i] != SiteClass::held && (classes_[i] < SiteClass::bordered || has_ghost(i));
  });
  if (std::ssize(watchers_) == before)
    return;
  std::sort(watchers_.begin() + before, watchers_.end());
  std::inplace_merge(watchers_.begin(), watchers_.begin() + before, watchers_.end());
  watchers_.erase(std::unique(watchers_.begin(), watchers_.end()), watchers_.end());
}

/// The owned neighbours of site i wake. Most of them are awake, so that few bytes are written.
void SiteActivity::wake_ring(LocalIndex i) {
  const LocalIndex owned = state_.points().owned();
  for (const LocalIndex j : state_.stars().ring(i)) {
    if (j == delaunay::gap || j >= owned)
      continue;
    const std::atomic_ref<std::uint8_t> flags(flags_[at(j)]);
    if (!(flags.load(std::memory_order_relaxed) & SiteFlags::awake) && classes_[j] != SiteClass::held)
      flags.fetch_or(SiteFlags::awake, std::memory_order_relaxed);
  }
}

/// Sites that must look wake if a neighbour moves. Where no tile around has moves, no site wakes.
template <class Moves>
void SiteActivity::look(std::span<const std::uint8_t> near_moves, const Moves& moves) {
  const mesh::BinnedPoints& points = state_.points();
  thread_loop(std::ssize(near_moves), 1, [&](std::ptrdiff_t t, int) {
    if (!near_moves[static_cast<std::size_t>(t)])
      return;
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    for (auto watcher = std::lower_bound(watchers_.begin(), watchers_.end(), begin);
         watcher != watchers_.end() && *watcher < end; ++watcher)
      if (!is_awake(*watcher) && std::ranges::any_of(state_.stars().ring(*watcher),
                                                     [&](LocalIndex j) { return j != delaunay::gap && moves(j); }))
        wake(*watcher);
  });
}

void SiteActivity::begin_move(std::span<const SweepTally> tallies, std::span<const std::uint8_t> near_moves) {
  const mesh::BinnedPoints& points = state_.points();
  const std::span<const geometry::Vec2> next = points.next().positions();
  const auto moves = [&](LocalIndex i) { return !(next[at(i)] == points.position(i)); };
  thread_loop(std::ssize(tallies), 1, [&](std::ptrdiff_t t, int) {
    if (tallies[static_cast<std::size_t>(t)].squared_distance == 0)
      return;
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i) // whatever moves is awake
      if ((std::atomic_ref(flags_[at(i)]).load(std::memory_order_relaxed) & SiteFlags::awake) && moves(i))
        wake_ring(i);
  });
  look(near_moves, [&](LocalIndex j) { return j < points.owned() && moves(j); });
}

/// The array that held the next places before the move now holds the old places of sites and ghosts.
void SiteActivity::finish_move(std::span<const std::uint8_t> near_moves) {
  const mesh::BinnedPoints& points = state_.points();
  const std::span<const geometry::Vec2> before = points.next().positions();
  look(near_moves, [&](LocalIndex j) { return j >= points.owned() && !(points.position(j) == before[at(j)]); });
}

void TileActivity::reset(const TilesAround& around) {
  const mesh::BinnedPoints& points = state_.points();
  const LocalIndex tiles = points.last_tile() - points.first_tile();
  wide_.assign(static_cast<std::size_t>(tiles), 0);
  widen(around);
  restless_.assign(static_cast<std::size_t>(tiles), 0);
  copied_.assign(static_cast<std::size_t>(tiles), 0);
  awake_.assign(static_cast<std::size_t>(tiles), 1);
  active_.assign(static_cast<std::size_t>(points.known_tiles()), 1);
  all_awake_ = true;
}

void TileActivity::widen(const TilesAround& around) {
  const mesh::BinnedPoints& points = state_.points();
  const LocalIndex first_tile = points.first_tile(), tiles = points.last_tile() - first_tile;
  const double largest_cap = std::min(builder_.cap(), delaunay::StarBuilder::largest_cap(state_.grid().periods()));
  thread_loop(tiles, 4, [&](std::ptrdiff_t t, int) { // edges are shorter than two caps, sites drift by a part of a tile
    const auto [begin, end] = points.tile_range(first_tile + static_cast<LocalIndex>(t));
    double largest = 0;
    for (LocalIndex i = begin; i < end; ++i)
      largest = std::max(largest, state_.sizes()[i]);
    if (2 * std::min(largest_cap, builder_.cap(largest)) >
        (1 - 2 * SweepRules::drift_in_tiles) * around.narrowest(static_cast<std::size_t>(t)))
      wide_[static_cast<std::size_t>(t)] = 1;
  });
}

void TileActivity::visit(StateFields& fields) {
  fields.field("all_awake", all_awake_);
  fields.field("waking_mover", waking_rule_.mover);
  fields.field("waking_length_scale", waking_rule_.length_scale);
  fields.field("waking_area_scale", waking_rule_.area_scale);
}

void TileActivity::restore(std::span<const std::uint64_t> activity) {
  const mesh::BinnedPoints& points = state_.points();
  for (std::size_t tile = 0; tile < activity.size(); ++tile)
    if (const LocalIndex known = points.known_tile(static_cast<LocalIndex>(tile)); known >= 0)
      active_[at(known)] = (activity[tile] & active_bit) != 0;
  const std::size_t first = at(points.first_tile());
  for (std::size_t t = 0; t < wide_.size(); ++t) {
    wide_[t] = (activity[first + t] & wide_bit) != 0;
    restless_[t] = (activity[first + t] & restless_bit) != 0;
  }
}

void TileActivity::wake(const RuleParameters& rule, TilePlace which, const TilesAround& around) {
  if (which == TilePlace::inner) {
    all_awake_ = all_awake_ || rule.mover != waking_rule_.mover || rule.length_scale != waking_rule_.length_scale ||
                 rule.area_scale != waking_rule_.area_scale;
    if (all_awake_)
      waking_rule_ = rule;
  }
  for (std::size_t t = 0; t < awake_.size(); ++t) {
    if (around.place(t) != which)
      continue;
    awake_[t] = all_awake_ || wide_[t] || restless_[t] || is_any_active(around.of(t));
  }
}

bool TileActivity::is_any_active(std::span<const LocalIndex> tiles) const {
  return std::any_of(tiles.begin(), tiles.end(), [&](LocalIndex tile) { return active_[at(tile)]; });
}

/// Rings do not reach beyond the tiles around, unless the tile is wide.
void TileActivity::find_near_moves(const TilesAround& around, bool foreign) {
  const auto owned = static_cast<LocalIndex>(around.size());
  near_moves_.resize(around.size());
  for (std::size_t t = 0; t < around.size(); ++t)
    near_moves_[t] = wide_[t] || std::ranges::any_of(around.of(t), [&](LocalIndex tile) {
                       return (tile >= owned) == foreign && active_[at(tile)];
                     });
}

double TileActivity::largest_drift(const mesh::BinnedPoints& points, const TilesAround& around,
                                   std::span<const SweepTally> tallies) {
  double largest = 0;
  for (std::size_t t = 0; t < tallies.size(); ++t)
    largest = std::max(largest, drift_after(points, t, tallies[t]) / around.narrowest(t));
  return largest;
}

void TileActivity::begin_move(mesh::BinnedPoints& points, const TilesAround& around,
                              std::span<const SweepTally> tallies) {
  for (std::size_t t = 0; t < tallies.size(); ++t) {
    points.drifts().set(static_cast<LocalIndex>(t), drift_after(points, t, tallies[t]));
    active_[t] = tallies[t].squared_distance > 0;
  }
  const std::span<const double> foreign = points.drifts().of_tiles().subspan(tallies.size());
  drifts_before_.assign(foreign.begin(), foreign.end());
  find_near_moves(around, false);
}

void TileActivity::finish_move(const TilesAround& around) {
  const std::span<const double> foreign = state_.points().drifts().of_tiles().subspan(awake_.size());
  active_.resize(awake_.size() + foreign.size());
  for (std::size_t k = 0; k < foreign.size(); ++k)
    active_[awake_.size() + k] = foreign[k] > drifts_before_[k];
  find_near_moves(around, true);
}

} // namespace trime::sweep
