// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/site_activity.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <iterator>

namespace trime::sweep {

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

} // namespace trime::sweep
