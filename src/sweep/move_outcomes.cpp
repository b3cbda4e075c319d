// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/move_outcomes.hpp"

#include "core/thread_loop.hpp"

#include <algorithm>
#include <atomic>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using polygon::BoundaryGuard;

} // namespace

void MoveOutcomes::reset() {
  const mesh::BinnedPoints& points = state_.points();
  const std::size_t tiles = at(points.last_tile() - points.first_tile());
  outcomes_.assign(at(points.owned()), SiteOutcome::moved);
  has_others_.assign(tiles, 0);
  tallies_.assign(tiles, {});
}

void MoveOutcomes::forget() {
  std::fill(outcomes_.begin(), outcomes_.end(), SiteOutcome::moved);
}

void MoveOutcomes::record(LocalIndex i, const Treated& treated) {
  state_.points().next().positions()[at(i)] = treated.position;
  if (!state_.points().next().leads().empty())
    state_.points().next().leads()[at(i)] = treated.lead;
  outcomes_[at(i)] = treated.deleted ? SiteOutcome::deleted : treated.pushed ? SiteOutcome::pushed : SiteOutcome::moved;
}

void MoveOutcomes::tally_again(std::size_t t) {
  std::atomic_ref(has_others_[t]).store(1, std::memory_order_relaxed);
}

/// Returns the sums over the moves of a tile's sites, from their places alone, as the kernel does.
SweepTally MoveOutcomes::tally_tile(LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  const mesh::LocalSizes& sizes = state_.sizes();
  SweepTally sum;
  const auto [begin, end] = points.tile_range(tile);
  for (LocalIndex i = begin; i < end; ++i) {
    if (classes_[i] == SiteClass::held || classes_[i] == SiteClass::fixed)
      continue;
    sum.deleted += outcomes_[at(i)] == SiteOutcome::deleted;
    sum.pushed += outcomes_[at(i)] == SiteOutcome::pushed;
    const Vec2 way = points.next().positions()[at(i)] - points.position(i), lead = points.site(i).lead,
               next = next_site(points, i).lead;
    const SiteTally<double> one(way.x, way.y, lead.x, lead.y, next.x, next.y, sizes[i]);
    sum.moving += one.squared_ratio > SweepRules::still * SweepRules::still;
    sum.power += static_cast<std::int64_t>(round_to_integer(one.power * 0x1p32));
    sum.squared_ratio = std::max(sum.squared_ratio, one.squared_ratio);
    sum.squared_distance = std::max(sum.squared_distance, one.squared_distance);
  }
  return sum;
}

SweepTally MoveOutcomes::sum() {
  const LocalIndex first_tile = state_.points().first_tile();
  thread_loop(static_cast<std::ptrdiff_t>(tallies_.size()), 4, [&](std::ptrdiff_t t, int) {
    if (has_others_[static_cast<std::size_t>(t)])
      tallies_[static_cast<std::size_t>(t)] = tally_tile(first_tile + static_cast<LocalIndex>(t));
  });
  SweepTally sum;
  for (const SweepTally& tally : tallies_)
    sum.add(tally);
  return sum;
}

std::vector<std::uint8_t> MoveOutcomes::deletions(int round) const {
  const mesh::BinnedPoints& points = state_.points();
  std::vector<std::uint8_t> deleted(outcomes_.size(), 0);
  for (LocalIndex i = 0; i < points.owned(); ++i)
    deleted[at(i)] = outcomes_[at(i)] == SiteOutcome::deleted && is_chosen(points.position(i), round);
  return deleted;
}

std::vector<std::uint8_t> MoveOutcomes::count_pushes(const BoundaryGuard& guard) {
  mesh::BinnedPoints& points = state_.points();
  std::vector<std::uint8_t> encroached(has_others_.size(), 0);
  thread_loop(static_cast<std::ptrdiff_t>(has_others_.size()), 4, [&](std::ptrdiff_t item, int) {
    const std::size_t t = static_cast<std::size_t>(item);
    if (!has_others_[t])
      return;
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(item));
    for (LocalIndex i = begin; i < end; ++i) {
      if (outcomes_[at(i)] != SiteOutcome::moved) {
        points.set_pushes(i, points.pushes(i) + 1);
        if (guard.pushes(points.next().positions()[at(i)]))
          encroached[t] = 1;
      }
      outcomes_[at(i)] = SiteOutcome::moved;
    }
  });
  return encroached;
}

} // namespace trime::sweep
