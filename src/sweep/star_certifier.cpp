// SPDX-License-Identifier: BSD-3-Clause
#include "sweep/star_certifier.hpp"

#include "core/thread_loop.hpp"
#include "sites/rules.hpp"
#include "sweep/sweep_task.hpp"
#include "trime/core/error.hpp"

#include <algorithm>

namespace trime::sweep {
namespace {

using sites::SiteState;

} // namespace

StarCertifier::StarCertifier(SiteState& state, const delaunay::StarBuilder& builder, const MoveContext& context,
                             LemmaReach reach)
    : state_(state), builder_(builder), context_(context), classes_(state, context, reach) {
  reset();
}

void StarCertifier::reset() {
  classes_.reset();
  marked_.assign(at(state_.points().owned()), 0);
}

void StarCertifier::begin_sweep() {
  rebuilt_ = 0;
  checked_.clear();
  suspects_.clear();
}

/// Adds those of `sites` to the list that have stars and are not marked yet, and marks them.
void StarCertifier::mark(std::span<const LocalIndex> sites, std::vector<LocalIndex>& list) {
  for (const LocalIndex i : sites)
    if (!marked_[at(i)] && classes_[i] != SiteClass::held) {
      marked_[at(i)] = 1;
      list.push_back(i);
    }
}

std::vector<LocalIndex> StarCertifier::certify_suspects() {
  std::vector<LocalIndex> affected, uncertain, certified;
  missing_.clear();
  while (!suspects_.empty()) { // every site is looked at once at most
    affected.clear();
    const delaunay::StarPass pass =
        builder_.certify(state_.points(), state_.stars(), state_.sizes(), suspects_, affected, missing_);
    rebuilt_ += pass.rebuilt;
    state_.comm().counters().add(Counter::stars_by_emptiness, pass.computed);
    state_.comm().counters().add(Counter::stars_rebuilt, pass.rebuilt);
    for (const LocalIndex i : suspects_)
      (state_.stars().certain(i) ? certified : uncertain).push_back(i);
    checked_.insert(checked_.end(), suspects_.begin(), suspects_.end());
    suspects_.clear();
    mark(affected, suspects_);
  }
  suspects_ = std::move(uncertain);
  std::sort(missing_.begin(), missing_.end());
  missing_.erase(std::unique(missing_.begin(), missing_.end()), missing_.end());
  return certified;
}

void StarCertifier::fetch_missing(int round) {
  if (round == sites::SiteRules::most_halo_rounds)
    throw InternalError(fmt::format("the halo still grows after {} rounds", round));
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
  for (int round = 0;; ++round) { // fetch_missing ends it
    certify_suspects();
    if (state_.comm().sum(uncertain()) == 0)
      break;
    fetch_missing(round);
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
  std::vector<LocalIndex> sites, affected;
  for (LocalIndex i = 0; i < points.owned(); ++i)
    if (classes_[i] != SiteClass::held)
      sites.push_back(i);
  std::vector<mesh::BinRef> missing;
  builder_.certify(points, all, state_.sizes(), sites, affected, missing);
  std::int64_t different = 0;
  for (const LocalIndex i : sites)
    different += all.certain(i) && !std::ranges::equal(all.ring(i), state_.stars().ring(i));
  if (const std::int64_t sum = state_.comm().sum(different); sum > 0)
    throw InternalError(fmt::format("{} stars differ from those computed anew", sum));
}

} // namespace trime::sweep
