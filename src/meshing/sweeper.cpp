// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/sweeper.hpp"

#include "trime/core/error.hpp"
#include "trime/core/thread_loop.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace trime::meshing {
namespace {

using geometry::Vec2;

/// Sites are sorted again when one may have come so many h since the last time: searches become long.
constexpr double drift_in_sizes_allowed = 4;
constexpr int sweeps_of_a_size = 6; // h is evaluated anew after so many sweeps
constexpr int sweeps_of_a_sort = 8; // sites that are to be deleted may wait so long for the next sorting
constexpr int chunk = 64;           // sites that one thread treats in a row
constexpr int most_halo_rounds = 100;

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

} // namespace

Sweeper::Sweeper(SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context, Lemma lemma)
    : state_(state), builder_(builder), context_(context), lemma_(lemma) {
  classify();
}

void Sweeper::Counts::follow_by(Counts later) {
  later.rebuilt += rebuilt;
  later.pushed += pushed;
  later.deleted += deleted;
  *this = later;
}

/// Adds those of `sites` to the list that are not marked yet, and marks them.
void Sweeper::mark(std::vector<LocalIndex>& sites, std::vector<LocalIndex>& list) {
  for (const LocalIndex i : sites)
    if (!marked_[at(i)] && classes_[at(i)] != SiteClass::held) {
      marked_[at(i)] = 1;
      list.push_back(i);
    }
}

/// Certifies the suspects, then what they have changed beside them, until nothing changes; they are added to checked_.
/// Returns how many stars miss a bin: they become the suspects of the next call.
std::int64_t Sweeper::certify_suspects() {
  std::vector<LocalIndex> affected, uncertain;
  missing_.clear();
  while (!suspects_.empty()) { // every site is looked at once at most
    affected.clear();
    rebuilt_ +=
        builder_.certify(state_.points(), state_.stars(), state_.sizes(), suspects_, affected, missing_).rebuilt;
    for (const LocalIndex i : suspects_)
      if (!state_.stars().certain(i))
        uncertain.push_back(i);
    checked_.insert(checked_.end(), suspects_.begin(), suspects_.end());
    suspects_.clear();
    mark(affected, suspects_);
  }
  suspects_ = uncertain;
  std::sort(missing_.begin(), missing_.end());
  missing_.erase(std::unique(missing_.begin(), missing_.end()), missing_.end());
  return static_cast<std::int64_t>(uncertain.size());
}

LocalIndex Sweeper::tile_of_site(LocalIndex i) const {
  const mesh::BinnedPoints& points = state_.points();
  LocalIndex low = points.first_tile(), high = points.last_tile(); // the tile lies in [low, high)
  while (high - low > 1) {
    const LocalIndex middle = low + (high - low) / 2;
    (points.tile_range(middle).begin <= i ? low : high) = middle;
  }
  return low;
}

/// The moves that the kernel has left, with all that can happen to a site.
void Sweeper::move_one_by_one(const UpdateRule& rule, std::span<const LocalIndex> sites) {
  mesh::BinnedPoints& points = state_.points();
  const StarView view = view_of(state_, context_.size);
  thread_loop(static_cast<std::ptrdiff_t>(sites.size()), chunk, [&](std::ptrdiff_t k, int) {
    const LocalIndex i = sites[static_cast<std::size_t>(k)];
    const LocalIndex tile = tile_of_site(i);
    classes_[at(i)] = class_of(i, tile);
    if (classes_[at(i)] == SiteClass::fixed)
      return;
    set_move(i, treat_step(context_, state_.grid(), points.site(i), view.size(i), rule.step(view, i), pushes_allowed));
    const std::size_t t = at(tile - points.first_tile());
    std::atomic_ref(retally_[t]).store(1, std::memory_order_relaxed);
    std::atomic_ref(copied_[t]).store(0, std::memory_order_relaxed);
    if (!is_measured_.empty())
      std::atomic_ref(is_measured_[t]).store(0, std::memory_order_relaxed);
  });
}

void Sweeper::set_move(LocalIndex i, const Treated& treated) {
  state_.points().next_positions()[at(i)] = treated.position;
  if (!state_.points().next_leads().empty())
    state_.points().next_leads()[at(i)] = treated.lead;
  fates_[at(i)] = treated.deleted ? Fate::deleted : treated.pushed ? Fate::pushed : Fate::moved;
}

/// Pushes those that the kernel has moved into a disc; true if there are any.
bool Sweeper::treat_guarded(std::span<const LocalIndex> sites) {
  const mesh::BinnedPoints& points = state_.points();
  bool any = false;
  for (const LocalIndex i : sites) {
    const Treated treated = treat_place(context_, state_.grid(), points.site(i), state_.sizes()[i],
                                        points.next_positions()[at(i)], points.next_site(i).lead, pushes_allowed);
    if (treated.pushed || treated.deleted) {
      set_move(i, treated);
      any = true;
    }
  }
  return any;
}

/// What the moves of a tile's sites add up to, from their places alone: the same as the kernel finds.
SweepTally Sweeper::tally_tile(LocalIndex tile) const {
  const mesh::BinnedPoints& points = state_.points();
  const mesh::LocalSizes& sizes = state_.sizes();
  SweepTally sum;
  const auto [begin, end] = points.tile_range(tile);
  for (LocalIndex i = begin; i < end; ++i) {
    if (classes_[at(i)] == SiteClass::held || classes_[at(i)] == SiteClass::fixed)
      continue;
    sum.deleted += fates_[at(i)] == Fate::deleted;
    sum.pushed += fates_[at(i)] == Fate::pushed;
    const Vec2 way = points.next_positions()[at(i)] - points.position(i), lead = points.site(i).lead,
               next = points.next_site(i).lead;
    const SiteTally<double> one(way.x, way.y, lead.x, lead.y, next.x, next.y, sizes[i]);
    sum.moving += one.squared_ratio > still * still;
    sum.power += static_cast<std::int64_t>(round_to_integer(one.power * 0x1p32));
    sum.squared_ratio = std::max(sum.squared_ratio, one.squared_ratio);
    sum.squared_distance = std::max(sum.squared_distance, one.squared_distance);
  }
  return sum;
}

SweepTally Sweeper::tally() {
  const LocalIndex first_tile = state_.points().first_tile();
  thread_loop(static_cast<std::ptrdiff_t>(tallies_.size()), 4, [&](std::ptrdiff_t t, int) {
    if (retally_[static_cast<std::size_t>(t)])
      tallies_[static_cast<std::size_t>(t)] = tally_tile(first_tile + static_cast<LocalIndex>(t));
  });
  SweepTally sum;
  for (const SweepTally& tally : tallies_)
    sum.add(tally);
  return sum;
}

void Sweeper::prepare(const UpdateRule& rule) {
  state_.points().prepare_advance();
  rebuilt_ = 0;
  checked_.clear();
  suspects_.clear();
  irregular_.clear();
  for (const Tiles which : {Tiles::inner, Tiles::at_borders}) {
    SweepTask sweep = task();
    sweep.rule = rule.parameters();
    wake_tiles(sweep.rule, which);
    run_kernel(sweep, which);
    finish_move();
  }
  all_awake_ = false;
  for (int round = 0;; ++round) {
    const std::size_t before = checked_.size();
    const std::int64_t uncertain = certify_suspects();
    std::vector<LocalIndex> to_move(checked_.begin() + static_cast<std::ptrdiff_t>(before), checked_.end());
    std::erase_if(to_move, [&](LocalIndex i) { return !state_.stars().certain(i); });
    for (const LocalIndex i : irregular_)
      if (!marked_[at(i)])
        to_move.push_back(i);
    irregular_.clear();
    move_one_by_one(rule, to_move);
    const SweepTally mine = tally();
    std::array<std::int64_t, 7> sums{
        uncertain, rebuilt_, mine.moving, mine.pushed, mine.deleted, mine.power & 0xffffffff, mine.power >> 32};
    std::array<double, 2> largest{mine.squared_ratio, mine.squared_distance};
    state_.comm().sum_and_max(sums, largest);
    if (sums[0] > 0) {
      if (round == most_halo_rounds)
        throw InternalError(fmt::format("the halo still grows after {} rounds", round));
      state_.fetch(missing_, context_.size);
      state_.points().prepare_advance();
      continue;
    }
    counts_ = {};
    counts_.rebuilt = sums[1];
    counts_.moving = sums[2];
    counts_.pushed = sums[3];
    counts_.deleted = sums[4];
    counts_.power = FixedSum::join({sums[5], sums[6]});
    counts_.max_move = std::sqrt(largest[0]);
    largest_distance_ = std::sqrt(largest[1]);
    break;
  }
  for (const LocalIndex i : checked_)
    marked_[at(i)] = 0;
  prepared_ = true;
}

void Sweeper::certify() {
  state_.points().release_leads();
  prepare(DistMeshRule{}); // the quickest one; its moves are not made
  discard();
  state_.points().release_leads();
  all_awake_ = true; // nothing is known of next places
  std::fill(copied_.begin(), copied_.end(), 0);
  thread_loop(state_.points().owned(), 4096, [&](std::ptrdiff_t item, int) {
    const auto i = static_cast<LocalIndex>(item);
    if (classes_[at(i)] != SiteClass::held)
      state_.stars().set_certain(i, true);
  });
}

/// Counts the pushes of the sites that were pushed, and forgets what became of sites. Only these can be in a disc where
/// they go; in tiles that sleep nothing changes.
void Sweeper::note_pushes() {
  mesh::BinnedPoints& points = state_.points();
  thread_loop(static_cast<std::ptrdiff_t>(retally_.size()), 4, [&](std::ptrdiff_t t, int) {
    std::uint8_t& encroached = encroached_[static_cast<std::size_t>(t)];
    if (awake_[static_cast<std::size_t>(t)])
      encroached = 0;
    if (!retally_[static_cast<std::size_t>(t)])
      return;
    const auto [begin, end] = points.tile_range(points.first_tile() + static_cast<LocalIndex>(t));
    for (LocalIndex i = begin; i < end; ++i) {
      if (fates_[at(i)] != Fate::moved) {
        points.set_pushes(i, points.pushes(i) + 1);
        if (context_.guard.pushes(points.next_positions()[at(i)]))
          encroached = 1;
      }
      fates_[at(i)] = Fate::moved;
    }
  });
}

Sweeper::Counts Sweeper::commit() {
  TRIME_ASSERT(prepared_);
  prepared_ = false;
  mesh::BinnedPoints& points = state_.points();
  const geometry::Box tile = state_.grid().tile_box(0);
  drift_ += largest_distance_ * (1 + 1e-9);
  drift_in_sizes_ += counts_.max_move;
  ++age_of_order_;
  ++moves_;
  const bool deletes = counts_.deleted > 0 && age_of_order_ >= sweeps_of_a_sort;
  if (deletes || state_.grid().periods().any() || drift_in_sizes_ > drift_in_sizes_allowed ||
      drift_ > drift_allowed * std::min(tile.width(), tile.height())) {
    std::vector<std::uint8_t> deleted(fates_.size(), 0);
    counts_.deleted = 0;
    for (LocalIndex i = 0; i < points.owned(); ++i)
      if (fates_[at(i)] == Fate::deleted && is_chosen(points.position(i), moves_))
        counts_.deleted += deleted[at(i)] = 1;
    counts_.deleted = state_.comm().sum(counts_.deleted);
    note_pushes();
    move_and_sort(std::move(deleted));
    return counts_;
  }
  note_pushes();
  counts_.deleted = 0; // they wait
  drifts_before_ = points.drifts().of_tiles();
  for (LocalIndex t = points.first_tile(); t < points.last_tile(); ++t) {
    const double squared = tallies_[at(t - points.first_tile())].squared_distance;
    points.drifts().set(t, points.drifts().of(t) + std::sqrt(squared) * (1 + 1e-9));
    active_[at(t)] = squared > 0;
  }
  const bool new_sizes = ++age_of_sizes_ >= sweeps_of_a_size;
  state_.begin_advance(context_.size, drift_, new_sizes);
  under_way_ = true;
  if (new_sizes) {
    age_of_sizes_ = 0;
    all_awake_ = all_awake_ || !state_.sizes().is_uniform(); // h has changed where nothing moves, too
  }
  sorted_ = false;
  return counts_;
}

/// Waits for the ghosts of the last move.
void Sweeper::finish_move() {
  if (!under_way_)
    return;
  under_way_ = false;
  state_.finish_advance(context_.size);
  const mesh::BinnedPoints& points = state_.points();
  for (std::size_t t = 0; t < active_.size(); ++t)
    if (const LocalIndex tile = static_cast<LocalIndex>(t); tile < points.first_tile() || tile >= points.last_tile())
      active_[t] = points.drifts().of(tile) > drifts_before_[t];
}

/// @param deleted empty: none
void Sweeper::move_and_sort(std::vector<std::uint8_t> deleted) {
  state_.forget_sizes();
  state_.move_sites(std::move(deleted));
  state_.refresh(context_.size);
  drift_ = drift_in_sizes_ = 0;
  age_of_sizes_ = age_of_order_ = 0;
  sorted_ = true;
  classify();
}

void Sweeper::discard() {
  std::fill(fates_.begin(), fates_.end(), Fate::moved);
  prepared_ = false;
}

void Sweeper::sort() {
  finish_move();
  discard();
  if (sorted_)
    return;
  state_.points().prepare_to_stay();
  move_and_sort({});
}

} // namespace trime::meshing
