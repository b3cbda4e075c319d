// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_rounds.hpp"

#include "comm/agree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace trime::cleanup {
namespace {

using polygon::BoundaryGuard;
using polygon::EditKind;
using sites::Disc;

using Rules = CleanupRules;

/// [h] Two patches keep so far apart that none reads what the other one changes.
constexpr double separation = 2 * Rules::reach - Rules::free_depth;

} // namespace

CleanupRounds::CleanupRounds(const sites::Stage& stage, const geometry::Boundary& meshed,
                             const geometry::Lattice& lattice, const CleanupOptions& options,
                             std::span<const Candidate> candidates)
    : comm_(stage.state->comm()), periods_(stage.state->grid().periods()), lattice_(lattice),
      limits_(comm_.sum(std::int64_t{stage.state->points().owned()}), options.most_points),
      boundary_(comm_, meshed, stage.polygon, *stage.asked_size, options.tolerance),
      sites_(comm_, *stage.state, *stage.size), candidates_(stage.state->grid()) {
  for (std::unique_ptr<PatchOptimizer>& optimizer : optimizers_)
    optimizer = std::make_unique<PatchOptimizer>(boundary_.chain(), lattice, PatchOptions{});
  for (const Candidate& candidate : candidates)
    candidates_.set(candidate);
}

CleanupCounts CleanupRounds::run_stage(int stage) {
  stage_ = stage;
  again_alpha_ = find_again_alpha();
  CleanupCounts all;
  for (int k = 0; k < Rules::most_rounds; ++k) {
    const std::vector<Contender> contenders = list_contenders();
    if (comm_.sum(static_cast<std::int64_t>(contenders.size())) == 0)
      break;
    all.add(round(contenders));
  }
  return all;
}

void CleanupRounds::finish(sites::Stage& stage) {
  sites_.finish(*stage.state, boundary_.renumber());
  stage.polygon = boundary_.chain().sites();
  *stage.guard = BoundaryGuard(stage.polygon, lattice_);
}

/// What is bad enough to be tried again: in a good mesh also what is bad there only.
double CleanupRounds::find_again_alpha() const {
  return std::clamp(1 + Rules::again_share * (comm_.max(candidates_.worst()) - 1), Rules::bad_alpha,
                    Rules::again_alpha);
}

std::vector<Contender> CleanupRounds::list_contenders() {
  const double shorter_period =
      std::min(periods_.x > 0 ? periods_.x : INFINITY, periods_.y > 0 ? periods_.y : INFINITY);
  return candidates_.contenders(
      {stage_, stage_ == 1 ? 0 : again_alpha_, separation, Rules::largest_share_of_period * shorter_period, round_});
}

CleanupCounts CleanupRounds::round(std::span<const Contender> contenders) {
  std::vector<Contender> chosen;
  for (const std::size_t k : choose_apart(comm_, sites_, periods_, contenders))
    chosen.push_back(contenders[k]);
  std::vector<PatchResult> results = try_patches(chosen);
  limits_.keep_within(comm_, chosen, results);
  CleanupCounts counts;
  std::vector<SiteEdit> edits = collect(chosen, results, counts);
  boundary_.apply(edits);
  take_edits(edits);
  take_verdicts(chosen, results);
  ++round_;
  comm_.counters().add(Counter::cleanup_rounds);
  comm_.counters().add(Counter::patches, std::ssize(chosen));
  counts = sum_over_ranks(counts);
  limits_.add(counts.inserted - counts.deleted);
  return counts;
}

/// What is read around each place.
std::vector<Disc> CleanupRounds::discs_of(std::span<const Contender> chosen) const {
  constexpr double share = Rules::reach / separation;
  std::vector<Disc> discs;
  for (const Contender& contender : chosen)
    discs.push_back({contender.place, share * contender.separation});
  return discs;
}

/// As PatchOptimizer takes them. In later stages all may be tried once more.
void CleanupRounds::prepare(std::vector<PatchSite>& sites) const {
  std::sort(sites.begin(), sites.end(), [](const PatchSite& a, const PatchSite& b) {
    return geometry::lexicographically_less(a.position, b.position);
  });
  for (PatchSite& site : sites) {
    if (site.boundary >= 0)
      site.tolerance = boundary_.tolerance(site.boundary);
    if (stage_ > 1)
      site.rests = 0;
  }
}

std::vector<PatchResult> CleanupRounds::try_patches(std::span<const Contender> chosen) {
  const std::vector<Disc> discs = discs_of(chosen);
  std::vector<Surroundings> around = sites_.around(discs, Rules::most_in_patch);
  std::vector<PatchResult> results(chosen.size());
  std::array<std::int64_t, 2> sums{std::ssize(chosen), std::ranges::count_if(around, &Surroundings::is_crowded)};
  comm_.sum(sums);
  if (sums[1] > 0)
    give_up_crowds(discs, around);
  const PatchBudget budget = limits_.budget(sums[0], stage_, again_alpha_);
  comm::run_agreed(comm_, [&] {
    thread_loop(std::ssize(chosen), 1, [&](std::ptrdiff_t item, int thread) {
      const auto k = static_cast<std::size_t>(item);
      if (around[k].is_crowded())
        return;
      prepare(around[k].sites);
      const double size = Surroundings::radius(discs[k].radius, around[k].narrowings) / Rules::reach;
      results[k] = optimizers_[thread]->improve(chosen[k].place, size, around[k].sites, budget);
    });
  });
  return results;
}

/// Where sites crowd so much that no patch can hold them, nothing is tried. The sites around are not to ask for it one
/// after the other: their owners let all of them rest.
void CleanupRounds::give_up_crowds(std::span<const Disc> discs, std::span<const Surroundings> around) {
  std::map<int, std::vector<Disc>> by_rank;
  for (std::size_t k = 0; k < discs.size(); ++k)
    if (around[k].is_crowded()) {
      const double radius = Surroundings::radius(discs[k].radius, Rules::most_narrowings);
      const Disc crowd{discs[k].center, Rules::given_up_share * radius};
      by_rank[comm_.rank()].push_back(crowd);
      for (const int rank : sites_.ranks_near(crowd))
        by_rank[rank].push_back(crowd);
    }
  for (const Disc& crowd : send(comm_, by_rank))
    for (const geometry::Vec2 place : sites_.let_rest(crowd))
      candidates_.give_up(place, stage_);
}

/// All edits of this rank, with canonical places, counted.
std::vector<SiteEdit> CleanupRounds::collect(std::span<const Contender> chosen, std::span<const PatchResult> results,
                                             CleanupCounts& counts) const {
  std::vector<SiteEdit> all;
  counts.patches = static_cast<std::int64_t>(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const PatchResult& result = results[k];
    counts.better += !result.edits.empty();
    counts.left += result.edits.empty() && !result.put_off;
    for (SiteEdit edit : result.edits) {
      edit.from = periods_.wrap(edit.from);
      edit.to = periods_.wrap(edit.to);
      edit.patch = hash_of(chosen[k].place, 0);
      counts.moved += edit.kind == EditKind::move;
      counts.inserted += edit.kind == EditKind::insert;
      counts.deleted += edit.kind == EditKind::remove;
      counts.on_boundary += edit.boundary >= 0;
      all.push_back(edit);
    }
  }
  return all;
}

/// Edits go to the owners of the old places and of the new ones, who carry them out.
void CleanupRounds::take_edits(std::span<const SiteEdit> edits) {
  std::map<int, std::vector<SiteEdit>> by_rank;
  for (const SiteEdit& edit : edits) {
    const int from = sites_.owner(edit.from), to = sites_.owner(edit.to);
    by_rank[from].push_back(edit);
    if (to != from)
      by_rank[to].push_back(edit);
  }
  const std::vector<SiteEdit> own = send(comm_, by_rank);
  sites_.apply(own);
  for (const SiteEdit& edit : own)
    if (edit.kind != EditKind::insert)
      candidates_.drop(edit.from);
}

/// The owners learn what the triangles of their sites are like, and where nothing helped.
void CleanupRounds::take_verdicts(std::span<const Contender> chosen, std::span<const PatchResult> results) {
  std::map<int, std::vector<SiteVerdict>> by_rank;
  for (const PatchResult& result : results)
    for (SiteVerdict verdict : result.verdicts) {
      verdict.position = periods_.wrap(verdict.position);
      by_rank[sites_.owner(verdict.position)].push_back(verdict);
    }
  for (const SiteVerdict& verdict : send(comm_, by_rank)) {
    sites_.set_rest(verdict.position, verdict.rests != 0);
    if (!(verdict.alpha > 0)) {
      candidates_.drop(verdict.position);
      continue;
    }
    candidates_.set({verdict.position, verdict.size, verdict.alpha}); // it has not moved
    if (verdict.rests)
      candidates_.settle(verdict.position, stage_);
  }
  for (std::size_t k = 0; k < chosen.size(); ++k)
    if (results[k].edits.empty() && !results[k].put_off)
      candidates_.settle(chosen[k].place, stage_);
}

CleanupCounts CleanupRounds::sum_over_ranks(const CleanupCounts& own) const {
  std::array<std::int64_t, 7> all{own.patches, own.better,      own.moved, own.inserted,
                                  own.deleted, own.on_boundary, own.left};
  comm_.sum(all);
  return {all[0], all[1], all[2], all[3], all[4], all[5], all[6]};
}

} // namespace trime::cleanup
