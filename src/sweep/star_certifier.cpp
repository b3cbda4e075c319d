// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/star_certifier.hpp"

#include "core/thread_loop.hpp"
#include "sites/rules.hpp"
#include "sweep/sweep_task.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <array>

namespace trime::sweep {
namespace {

using geometry::Vec2;
using sites::SiteState;

} // namespace

StarCertifier::StarCertifier(SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                             LemmaReach reach)
    : state_(state), builder_(builder), context_(context), classes_(state, builder, context, reach) {
  reset();
}

void StarCertifier::reset() {
  classes_.reset();
  marked_.assign(at(state_.points().owned()), 0);
}

void StarCertifier::begin_sweep() {
  rebuilt_ = coincident_ = 0;
  checked_.clear();
  suspects_.clear();
  told_ghosts_.clear();
  heard_of_.clear();
}

/// Adds those of `sites` to the list that have stars and are not marked yet, and marks them.
void StarCertifier::mark(std::span<const LocalIndex> sites, std::vector<LocalIndex>& list) {
  for (const LocalIndex i : sites)
    if (!marked_[at(i)] && classes_[i] != SiteClass::held) {
      marked_[at(i)] = checked;
      list.push_back(i);
    }
}

/// Suspects and what they affect on this rank, until nothing changes.
void StarCertifier::settle(std::vector<LocalIndex>& certified, std::vector<LocalIndex>& uncertain) {
  std::vector<delaunay::AffectedStar> affected;
  std::vector<LocalIndex> beside;
  while (!suspects_.empty()) { // every site is looked at once at most
    affected.clear();
    beside.clear();
    const delaunay::StarPass pass =
        builder_.certify(state_.points(), state_.stars(), state_.sizes(), suspects_, affected, missing_);
    rebuilt_ += pass.rebuilt;
    coincident_ += pass.coincident;
    state_.comm().counters().add(Counter::stars_by_emptiness, pass.computed);
    state_.comm().counters().add(Counter::stars_rebuilt, pass.rebuilt);
    for (const LocalIndex i : suspects_)
      (state_.stars().certain(i) ? certified : uncertain).push_back(i);
    checked_.insert(checked_.end(), suspects_.begin(), suspects_.end());
    suspects_.clear();
    for (const delaunay::AffectedStar& star : affected) {
      marked_[at(star.cause)] = changed;
      if (star.site < state_.points().owned())
        beside.push_back(star.site);
      else
        note_ghost(star);
    }
    mark(beside, suspects_);
  }
}

/// Its owner gets one message, unless this rank knows that the owner has examined it. In a periodic container all stars
/// next to ghosts are certified by the empty-circle test in every sweep, so no message is needed.
void StarCertifier::note_ghost(const delaunay::AffectedStar& affected) {
  const mesh::BinnedPoints& points = state_.points();
  const Vec2 place = points.position(affected.site);
  if (points.boundary(affected.site) >= 0 || state_.grid().periods().any() || heard_of_.contains(place) ||
      !told_ghosts_.insert(affected.site).second)
    return;
  affected_ghosts_.push_back(affected.site);
  news_.push_back({place, points.position(affected.cause)});
}

LocalIndex StarCertifier::find_owned(Vec2 p) const {
  const mesh::BinnedPoints& points = state_.points();
  LocalIndex found = -1;
  points.for_each_near(
      p, 0,
      [&](LocalIndex begin, LocalIndex end) {
        for (LocalIndex j = begin; j < std::min(end, points.owned()); ++j)
          if (points.position(j) == p)
            found = j;
      },
      [](mesh::BinRef) {});
  return found;
}

/// Sends messages to the owners of ghosts, and makes suspects of the sites in the messages of others.
void StarCertifier::exchange_news() {
  const std::vector<decomposition::GhostNews> heard =
      state_.halo().tell_owners(state_.points(), affected_ghosts_, news_);
  affected_ghosts_.clear();
  news_.clear();
  std::vector<LocalIndex> sites;
  for (const decomposition::GhostNews& news : heard) {
    heard_of_.insert(news.cause);
    sites.push_back(find_owned(news.ghost));
    TRIME_ASSERT(sites.back() >= 0, "this rank has no site at ({}, {}), but another rank has a ghost there",
                 news.ghost.x, news.ghost.y);
  }
  mark(sites, suspects_);
}

std::vector<LocalIndex> StarCertifier::certify_suspects() {
  std::vector<LocalIndex> uncertain, certified;
  missing_.clear();
  settle(certified, uncertain);
  if (state_.comm().size() > 1) {
    exchange_news();
    settle(certified, uncertain);
  }
  suspects_ = std::move(uncertain);
  std::sort(missing_.begin(), missing_.end());
  missing_.erase(std::unique(missing_.begin(), missing_.end()), missing_.end());
  return certified;
}

void StarCertifier::go_on(const Open& all, int round) {
  if (round == sites::SiteRules::most_halo_rounds)
    throw InternalError(
        fmt::format("the ghosts (copies of points of other ranks) still increase after {} rounds", round));
  if (all.uncertain > 0)
    state_.fetch(missing_, context_.size);
}

void StarCertifier::end_sweep() {
  for (const LocalIndex i : checked_)
    marked_[at(i)] = 0;
}

/// The lemma for all sites, at their present places.
void StarCertifier::find_suspects() {
  const mesh::BinnedPoints& points = state_.points();
  const CertifyKernel kernel = sweep_kernels().certify;
  const SweepTask all = make_sweep_task(state_, builder_, context_, classes_);
  PerThread<std::vector<LocalIndex>> of_thread;
  thread_loop(points.last_tile() - points.first_tile(), 1, [&](std::ptrdiff_t t, int thread) {
    std::vector<LocalIndex>& suspects = of_thread[thread];
    const LocalIndex tile = points.first_tile() + static_cast<LocalIndex>(t);
    const auto [begin, end] = points.tile_range(tile);
    const std::size_t before = suspects.size();
    suspects.resize(before + at(end - begin));
    SweepTask here = all;
    here.least_class = classes_.least_certified(tile);
    suspects.resize(before + static_cast<std::size_t>(kernel(here, begin, end, suspects.data() + before)));
  });
  for (const std::vector<LocalIndex>& suspects : of_thread)
    suspect(suspects);
}

void StarCertifier::certify_all() {
  state_.points().release_leads();
  begin_sweep();
  find_suspects();
  for (int round = 0;; ++round) { // go_on ends it
    certify_suspects();
    std::array<std::int64_t, 2> sums{open().uncertain, open().untold};
    state_.comm().sum(sums);
    const Open all{sums[0], sums[1]};
    if (!all.any())
      break;
    go_on(all, round);
  }
  end_sweep();
  thread_loop(state_.points().owned(), 4096, [&](std::ptrdiff_t item, int) {
    const auto i = static_cast<LocalIndex>(item);
    if (classes_[i] != SiteClass::held)
      state_.stars().set_certain(i, true);
  });
}

void StarCertifier::verify() const {
  const mesh::BinnedPoints& points = state_.points();
  delaunay::StarTable all;
  all.reset(points.owned());
  std::vector<LocalIndex> sites;
  std::vector<delaunay::AffectedStar> affected;
  for (LocalIndex i = 0; i < points.owned(); ++i)
    if (classes_[i] != SiteClass::held)
      sites.push_back(i);
  std::vector<mesh::BinRef> missing;
  builder_.certify(points, all, state_.sizes(), sites, affected, missing);
  std::int64_t different = 0;
  for (const LocalIndex i : sites)
    different += all.certain(i) && !std::ranges::equal(all.ring(i), state_.stars().ring(i));
  if (const std::int64_t sum = state_.comm().sum(different); sum > 0)
    throw InternalError(fmt::format("{} stars differ from those computed again", sum));
}

} // namespace trime::sweep
