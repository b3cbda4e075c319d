// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/sweeper.hpp"

#include "core/thread_loop.hpp"
#include "sweep/sweep_task.hpp"
#include "trime/core/error.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using sites::SiteState;
using sites::StarView;
using sites::view_of;

constexpr int chunk = 64; // sites that one thread treats in a row

} // namespace

/// The sites that the kernel leaves in the tiles of a thread.
struct Sweeper::TileLeftovers {
  std::vector<LocalIndex> suspects, irregular; // of all tiles
  std::vector<LocalIndex> guarded;             // of one tile
  std::int64_t awake = 0;                      // sites of all tiles
};

Sweeper::Sweeper(SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context, LemmaReach reach,
                 Sleep sleep)
    : state_(state), builder_(builder), context_(context), sleep_(sleep), certifier_(state, builder, context, reach),
      activity_(state, builder), site_activity_(state, certifier_.classes()), outcomes_(state, certifier_.classes()) {
  activity_.reset(certifier_.classes().around());
  site_activity_.reset();
  outcomes_.reset();
}

/// Begins again after sites were sorted.
void Sweeper::reset() {
  certifier_.reset();
  activity_.reset(certifier_.classes().around());
  site_activity_.reset();
  outcomes_.reset();
  measures_.reset();
  schedule_.reset();
}

void Sweeper::Counts::follow_by(Counts later) {
  later.rebuilt += rebuilt;
  later.pushed += pushed;
  later.deleted += deleted;
  *this = later;
}

SweepSums Sweeper::measure(double reference_size) {
  return measures_.measure(make_sweep_task(state_, builder_, context_, certifier_.classes()),
                           view_of(state_, context_.size), reference_size);
}

void Sweeper::verify_measures(double reference_size) {
  const SweepSums computed_again = sweep::measure(view_of(state_, context_.size), reference_size);
  const bool same = measure(reference_size).has_same_measures(computed_again);
  if (const std::int64_t sum = state_.comm().sum(std::int64_t{!same}); sum > 0)
    throw InternalError(fmt::format("the measures of tiles that slept are wrong on {} ranks", sum));
}

// --- prepare -------------------------------------------------------------------------------------------------------

/// The sites of a sleeping tile stay where they are.
void Sweeper::stay(const SweepTask& task, std::size_t t) {
  outcomes_.set_tally(t, {});
  if (!activity_.needs_copy(t))
    return;
  const auto [begin, end] = state_.points().tile_range(state_.points().first_tile() + static_cast<LocalIndex>(t));
  std::copy(task.positions + begin, task.positions + end, task.next_positions + begin);
  if (task.next_leads)
    std::fill(task.next_leads + begin, task.next_leads + end, geometry::Vec2{});
}

/// The pass of the kernel over an awake tile, and the treatment of those that it moves near the boundary.
void Sweeper::sweep_tile(const SweepTask& task, std::size_t t, TileLeftovers& mine) {
  activity_.note_moves(t);
  const LocalIndex tile = state_.points().first_tile() + static_cast<LocalIndex>(t);
  if (activity_.wakes_all())
    site_activity_.wake_tile(tile);
  const auto [begin, end] = state_.points().tile_range(tile);
  const std::size_t suspects = mine.suspects.size(), irregular = mine.irregular.size(), n = at(end - begin);
  mine.suspects.resize(suspects + n);
  mine.irregular.resize(irregular + n);
  mine.guarded.resize(std::max(mine.guarded.size(), n));
  SweepLeftovers leftovers{mine.suspects.data() + suspects, mine.irregular.data() + irregular, mine.guarded.data()};
  SweepTask here = task;
  here.least_class = certifier_.classes().least_certified(tile);
  outcomes_.set_tally(t, sweep_kernels().sweep(here, begin, end, leftovers));
  mine.suspects.resize(suspects + static_cast<std::size_t>(leftovers.suspect_count));
  mine.irregular.resize(irregular + static_cast<std::size_t>(leftovers.irregular_count));
  mine.awake += leftovers.awake_count;
  if (leftovers.awake_count > 0)
    measures_.forget(t);
  const bool pushes = treat_guarded(std::span(mine.guarded).first(static_cast<std::size_t>(leftovers.guarded_count)));
  if (pushes || leftovers.suspect_count + leftovers.irregular_count > 0)
    outcomes_.tally_again(t);
}

/// Certifies and moves the sites of the tiles that lie so, as far as the kernel can.
void Sweeper::run_kernel(const UpdateRule& rule, TilePlace which) {
  SweepTask task = make_sweep_task(state_, builder_, context_, certifier_.classes());
  task.rule = rule.parameters();
  task.flags = site_activity_.flags();
  const TilesAround& around = certifier_.classes().around();
  activity_.wake(task.rule, which, around);
  PerThread<TileLeftovers> of_thread;
  thread_loop(static_cast<std::ptrdiff_t>(around.size()), 1, [&](std::ptrdiff_t item, int thread) {
    const std::size_t t = static_cast<std::size_t>(item);
    if (around.place(t) != which)
      return;
    if (activity_.is_awake(t))
      sweep_tile(task, t, of_thread[thread]);
    else
      stay(task, t);
  });
  std::int64_t awake = 0;
  for (const TileLeftovers& mine : of_thread) {
    awake += mine.awake;
    certifier_.suspect(mine.suspects);
    irregular_.insert(irregular_.end(), mine.irregular.begin(), mine.irregular.end());
  }
  count_sites(which, awake);
}

/// Counts the sites that were awake, in the tiles that lie so.
void Sweeper::count_sites(TilePlace which, std::int64_t awake) const {
  const TilesAround& around = certifier_.classes().around();
  std::int64_t all = 0;
  for (std::size_t t = 0; t < around.size(); ++t)
    if (around.place(t) == which) {
      const auto [begin, end] = state_.points().tile_range(state_.points().first_tile() + static_cast<LocalIndex>(t));
      all += end - begin;
    }
  state_.comm().counters().add(Counter::sites_slept, all - awake);
  state_.comm().counters().add(Counter::sites_swept, awake);
}

/// Pushes those that the kernel has moved into a disc; true if there are any.
bool Sweeper::treat_guarded(std::span<const LocalIndex> sites) {
  const mesh::BinnedPoints& points = state_.points();
  bool any = false;
  for (const LocalIndex i : sites) {
    const Treated treated =
        treat_place(context_, state_.grid(), points.site(i), state_.sizes()[i], points.next().positions()[at(i)],
                    next_site(points, i).lead, SweepRules::pushes_allowed);
    if (treated.pushed || treated.deleted) {
      outcomes_.record(i, treated);
      site_activity_.wake(i);
      any = true;
    }
  }
  return any;
}

/// Is it the turn of the rule to move site i, whose star was certified by emptiness? That must not depend on which
/// certificate was used: it is where the star has changed, or where the kernel would have moved it.
bool Sweeper::may_move(LocalIndex i, std::size_t t) const {
  return certifier_.has_changed(i) || (activity_.is_awake(t) && site_activity_.is_awake(i));
}

/// The moves that the kernel has left, with all that can happen to a site.
void Sweeper::move_one_by_one(const UpdateRule& rule, std::span<const LocalIndex> sites) {
  const mesh::BinnedPoints& points = state_.points();
  const StarView view = view_of(state_, context_.size);
  thread_loop(static_cast<std::ptrdiff_t>(sites.size()), chunk, [&](std::ptrdiff_t k, int) {
    const LocalIndex i = sites[static_cast<std::size_t>(k)];
    const LocalIndex tile = tile_of_site(points, i);
    const std::size_t t = at(tile - points.first_tile());
    const SiteClass site_class = certifier_.classes().update(i, tile);
    site_activity_.watch(i);
    if (certifier_.has_changed(i))
      measures_.forget(t);
    if (site_class == SiteClass::fixed) {
      site_activity_.set_rest(i, true);
      return;
    }
    const mesh::Site site = points.site(i);
    if (!may_move(i, t)) {
      outcomes_.record(i, {site.position, {}, site.pushes});
      return;
    }
    const Step step = rule.step(view, i);
    const double h = view.size(i);
    const Treated treated = treat_step(context_, state_.grid(), site, h, step, SweepRules::pushes_allowed);
    outcomes_.record(i, treated);
    const bool rests = treated.position == site.position && treated.lead == Vec2{} && !treated.pushed &&
                       !treated.deleted && surely_rests(step.move.x, step.move.y, h);
    site_activity_.set_rest(i, rests);
    outcomes_.tally_again(t);
    activity_.note_moves(t);
    measures_.forget(t);
  });
}

/// Certifies the suspects by emptiness, as far as bins are known, and moves these and the irregular ones.
void Sweeper::move_others(const UpdateRule& rule) {
  std::vector<LocalIndex> to_move = certifier_.certify_suspects();
  for (const LocalIndex i : irregular_)
    if (!certifier_.was_checked(i))
      to_move.push_back(i);
  irregular_.clear();
  move_one_by_one(rule, to_move);
  site_activity_.note_rings(to_move);
}

/// Counts what all ranks have done in this sweep, in one packed reduction; returns what is left to be done.
StarCertifier::Open Sweeper::sum_over_ranks() {
  const SweepTally mine = outcomes_.sum();
  moving_ = mine.moving;
  const StarCertifier::Open open = certifier_.open();
  std::array<std::int64_t, 9> sums{open.uncertain,   certifier_.rebuilt(), mine.moving,
                                   mine.pushed,      mine.deleted,         mine.power & 0xffffffff,
                                   mine.power >> 32, open.untold,          certifier_.coincident()};
  std::array<double, 4> largest{
      mine.squared_ratio, mine.squared_distance,
      TileActivity::largest_drift(state_.points(), certifier_.classes().around(), outcomes_.tallies()),
      static_cast<double>(wish_)};
  state_.comm().sum_and_max(sums, largest);
  counts_ = {};
  counts_.rebuilt = sums[1];
  counts_.moving = sums[2];
  counts_.pushed = sums[3];
  counts_.deleted = sums[4];
  counts_.power = FixedSum::join({sums[5], sums[6]});
  coincident_ = sums[8];
  counts_.max_move = std::sqrt(largest[0]);
  largest_distance_ = std::sqrt(largest[1]);
  drift_in_tiles_ = largest[2];
  largest_wish_ = static_cast<int>(largest[3]);
  return {sums[0], sums[7]};
}

void Sweeper::prepare(const UpdateRule& rule, int wish) {
  wish_ = wish;
  certify_and_place(rule);
  if (coincident_ > 0) {
    sort_here();
    certify_and_place(rule);
  }
  prepared_ = true;
}

/// Certifies the stars at the present places, and finds the next places.
void Sweeper::certify_and_place(const UpdateRule& rule) {
  state_.points().prepare_advance();
  certifier_.begin_sweep();
  irregular_.clear();
  if (sleep_ == Sleep::never)
    activity_.wake_all();
  for (const TilePlace which : {TilePlace::inner, TilePlace::at_border}) {
    run_kernel(rule, which);
    finish_move(); // the ghosts have been on their way
  }
  activity_.end_waking();
  for (int round = 0;; ++round) { // go_on ends it
    move_others(rule);
    const StarCertifier::Open all = sum_over_ranks();
    if (!all.any())
      break;
    certifier_.go_on(all, round);
    state_.points().prepare_advance();
  }
  certifier_.end_sweep();
  state_.comm().counters().add(Counter::passes);
}

// --- commit --------------------------------------------------------------------------------------------------------

/// Counts pushes, and notes where sites that were pushed still go into a disc: only these can be in one, and in tiles
/// that sleep nothing changes. Other ranks get it with the places.
void Sweeper::note_pushes() {
  const std::vector<std::uint8_t> encroached = outcomes_.count_pushes(context_.guard);
  SiteClasses& classes = certifier_.classes();
  for (std::size_t t = 0; t < encroached.size(); ++t) {
    if (activity_.is_awake(t) || encroached[t])
      classes.set_encroached(t, encroached[t]);
    state_.points().marks().set(static_cast<LocalIndex>(t), classes.is_encroached(t));
  }
}

/// Where some site may move once there is momentum, its tile stays awake. Before moves wake their neighbours.
void Sweeper::note_restless() {
  const LocalIndex first_tile = state_.points().first_tile();
  thread_loop(static_cast<std::ptrdiff_t>(certifier_.classes().around().size()), 4, [&](std::ptrdiff_t t, int) {
    if (activity_.is_awake(static_cast<std::size_t>(t)))
      activity_.set_restless(static_cast<std::size_t>(t),
                             site_activity_.any_awake(first_tile + static_cast<LocalIndex>(t)));
  });
}

bool Sweeper::must_sort() const {
  return (counts_.deleted > 0 && schedule_.may_sort_to_delete()) || state_.grid().periods().any() ||
         schedule_.is_sort_due();
}

Sweeper::Counts Sweeper::commit() {
  TRIME_ASSERT(prepared_);
  prepared_ = false;
  state_.comm().counters().add(Counter::sites_moved, moving_);
  schedule_.add_move(largest_distance_, counts_.max_move, drift_in_tiles_);
  ++moves_;
  if (must_sort()) {
    std::vector<std::uint8_t> deleted = outcomes_.deletions(moves_);
    counts_.deleted = state_.comm().sum(std::accumulate(deleted.begin(), deleted.end(), std::int64_t{0}));
    note_pushes();
    move_and_sort(std::move(deleted));
    return counts_;
  }
  note_pushes();
  counts_.deleted = 0; // they wait
  note_restless();
  activity_.begin_move(state_.points(), certifier_.classes().around(), outcomes_.tallies());
  site_activity_.begin_move(outcomes_.tallies(), activity_.near_moves());
  const bool new_sizes = schedule_.advance();
  state_.begin_advance(context_.size, schedule_.drift(), new_sizes);
  under_way_ = true;
  if (new_sizes && !state_.sizes().is_uniform()) {
    activity_.wake_all(); // h has changed where nothing moves, too
    activity_.widen(certifier_.classes().around());
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
  activity_.finish_move(certifier_.classes().around());
  site_activity_.finish_move(activity_.near_moves());
}

/// @param deleted empty: none
void Sweeper::move_and_sort(std::vector<std::uint8_t> deleted) {
  state_.forget_sizes();
  state_.move_sites(std::move(deleted));
  state_.refresh(context_.size);
  sorted_ = true;
  reset();
}

void Sweeper::visit(StateFields& fields) {
  schedule_.visit(fields);
  activity_.visit(fields);
  fields.field("moves", moves_);
  fields.field("sorted", sorted_);
}

std::vector<std::uint64_t> Sweeper::saved_activity() const {
  std::vector<std::uint64_t> saved(certifier_.classes().around().size());
  for (std::size_t t = 0; t < saved.size(); ++t)
    saved[t] = activity_.saved(t);
  return saved;
}

void Sweeper::restore(StateFields& fields, std::span<const std::uint64_t> activity) {
  visit(fields);
  activity_.restore(activity);
  for (std::size_t t = 0; t < certifier_.classes().around().size(); ++t) // all stars must be computed again
    site_activity_.wake_tile(state_.points().first_tile() + static_cast<LocalIndex>(t));
  if (state_.comm().sum(std::int64_t{mesh::has_coincident_sites(state_.points())}) > 0)
    sort_here(); // as the run did that wrote the checkpoint
}

void Sweeper::discard() {
  outcomes_.forget();
  prepared_ = false;
}

void Sweeper::sort() {
  finish_move();
  if (sorted_)
    discard();
  else
    sort_here();
}

/// Where the sites are. Of those that have the same place, one stays.
void Sweeper::sort_here() {
  discard();
  prepare_to_stay(state_.points());
  move_and_sort({});
}

} // namespace trime::sweep
