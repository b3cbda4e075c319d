// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_rounds.hpp"

#include "comm/agree.hpp"
#include "comm/parcel.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trime::cleanup {
namespace {

using polygon::BoundaryGuard;
using polygon::EditKind;
using sites::Disc;

// Share of a period that the distance between two patches may have: each must see one image of the other.
constexpr double largest_share_of_period = 0.45;

using Rules = CleanupRules;

/// [h] Two patches keep so far apart that none reads what the other one changes.
constexpr double separation = 2 * Rules::reach - Rules::free_depth;
/// [1] Share of the separation that a patch reads.
constexpr double share_read = Rules::reach / separation;

void join(auto& all, const auto& more) {
  all.insert(all.end(), more.begin(), more.end());
}

} // namespace

CleanupRounds::CleanupRounds(const sites::Stage& stage, const geometry::Boundary& meshed,
                             const geometry::Lattice& lattice, const CleanupOptions& options,
                             std::span<const Candidate> candidates)
    : comm_(stage.state->comm()), periods_(stage.state->grid().periods()), lattice_(lattice), size_(*stage.size),
      limits_(comm_.sum(std::int64_t{stage.state->points().owned()}), options.most_points,
              static_cast<GlobalId>(stage.polygon.inner.chords.size())),
      boundary_(comm_, meshed, stage.polygon, stage.asked_size(), options.tolerance), sites_(*stage.state, boundary_),
      candidates_(stage.state->grid()), neighbours_(comm_), bad_alpha_(options.bad_alpha) {
  for (std::unique_ptr<PatchOptimizer>& optimizer : optimizers_)
    optimizer = std::make_unique<PatchOptimizer>(
        stage.polygon, boundary_.curve(), lattice,
        PatchOptions{.bad_alpha = options.bad_alpha, .ear_alpha = options.split_ears ? Rules::ear_alpha : 0});
  for (const Candidate& candidate : candidates)
    candidates_.set(candidate);
  meet_neighbours(list_contenders());
}

void CleanupRounds::run_stage(int stage) {
  stage_ = stage;
  again_alpha_ = find_again_alpha();
  for (int k = 0; k < Rules::most_rounds; ++k) {
    const std::vector<Contender> contenders = list_contenders();
    Outcome outcome = round(contenders);
    if (outcome == Outcome::neighbours_missing) { // nothing has changed
      meet_neighbours(contenders);
      outcome = round(contenders);
    }
    if (outcome == Outcome::nothing_left)
      return;
    if (outcome == Outcome::neighbours_missing)
      throw InternalError("a patch of the clean-up overlaps tiles of a rank that is not a neighbour");
  }
}

void CleanupRounds::finish(sites::Stage& stage, const delaunay::StarBuilder& builder) {
  std::optional<polygon::BoundarySites> polygon = boundary_.finish();
  stage.state->points().release_leads();
  sites_.finish(*stage.state, builder);
  if (!polygon)
    return;
  stage.polygon = std::move(*polygon);
  *stage.guard = BoundaryGuard(stage.polygon, lattice_);
}

/// Returns the alpha above which triangles are tried again: lower in a good mesh.
double CleanupRounds::find_again_alpha() const {
  if (bad_alpha_ > Rules::bad_alpha) // a mesh of a series, which is not polished
    return Rules::again_alpha;
  return std::clamp(1 + Rules::again_share * (comm_.max(candidates_.worst()) - 1), bad_alpha_, Rules::again_alpha);
}

std::vector<Contender> CleanupRounds::list_contenders() {
  const double shorter_period =
      std::min(periods_.x > 0 ? periods_.x : INFINITY, periods_.y > 0 ? periods_.y : INFINITY);
  const bool only_obtuse = stage_ > Rules::stages;
  return candidates_.contenders({stage_, stage_ == 1 || only_obtuse ? 0 : again_alpha_, separation,
                                 largest_share_of_period * shorter_period, round_, only_obtuse});
}

/// The owners of all tiles to which contenders reach, and others that may contend later.
void CleanupRounds::meet_neighbours(std::span<const Contender> contenders) {
  std::vector<int> ranks;
  for (const Contender& contender : contenders)
    join(ranks, sites_.ranks_near({contender.place, Rules::foresight * contender.separation}));
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  neighbours_.add(ranks);
}

CleanupRounds::Outcome CleanupRounds::round(std::span<const Contender> contenders) {
  Choice choice = choose_apart(comm_, neighbours_, sites_, periods_, contenders);
  const auto [incomplete, counts] = count_patches(choice);
  if (incomplete)
    return Outcome::neighbours_missing;
  if (counts.patches == 0)
    return Outcome::nothing_left;
  Attempt attempt = try_patches(std::move(choice), counts);
  const CleanupLimits::Gains gains = CleanupLimits::gains_of(attempt.results);
  std::array<std::int64_t, 3> sums{attempt.error.has_value(), gains.added, gains.taken};
  comm_.sum(sums);
  const auto [failing, added, taken] = sums;
  if (failing > 0)
    comm::agree(comm_, attempt.error);
  limits_.count(comm_, {added, taken}, attempt.choice.own, attempt.results);
  count(attempt);
  take(exchange_news(attempt));
  settle_failures(attempt);
  ++round_;
  return Outcome::done;
}

/// Over all ranks: whether some choice is not whole, and how many patches there are.
std::pair<bool, PatchCounts> CleanupRounds::count_patches(const Choice& choice) const {
  const std::int64_t patches = std::ssize(choice.own), threads = thread_count();
  std::array<std::int64_t, 3> sums{!choice.is_whole, patches, threads};
  std::array<double, 1> largest{static_cast<double>((patches + threads - 1) / threads)};
  comm_.sum_and_max(sums, largest);
  return {sums[0] > 0, {sums[1], sums[2], std::llround(largest[0])}};
}

/// Tries the sites around each place, on its owner or on another rank.
CleanupRounds::Attempt CleanupRounds::try_patches(Choice choice, const PatchCounts& counts) {
  const auto discs_of = [](std::span<const ChosenContender> list) {
    std::vector<PatchDisc> discs;
    for (const auto& [contender, rank, number] : list)
      discs.push_back({{contender.place, share_read * contender.separation}, rank, number});
    return discs;
  };
  const std::vector<PatchDisc> discs = discs_of(choice.own);
  std::vector<Surroundings> around = sites_.around(discs, discs_of(choice.near), choice.partners, Rules::most_in_patch);
  Attempt attempt{std::move(choice), {}, {}, {}};
  std::vector<PatchTask> tasks;
  for (std::size_t k = 0; k < discs.size(); ++k) {
    if (around[k].is_crowded()) {
      const double radius = Surroundings::radius(discs[k].disc.radius, Rules::most_narrowings);
      attempt.crowds.push_back({discs[k].disc.center, Rules::given_up_share * radius});
    }
    tasks.push_back({attempt.choice.own[k].contender, std::move(around[k])});
  }
  const PatchBudget budget = limits_.budget(stage_, again_alpha_);
  attempt.results = try_shared(comm_, counts, std::move(tasks), [&](std::span<PatchTask> list) {
    comm_.counters().add(Counter::patches, std::ssize(list));
    std::vector<PatchResult> results(list.size());
    attempt.error = comm::error_of([&] {
      thread_loop(std::ssize(list), 1, [&](std::ptrdiff_t item, int thread) {
        const auto k = static_cast<std::size_t>(item);
        if (!list[k].around.is_crowded())
          improve(list[k], budget, thread, results[k]);
      });
    });
    return results;
  });
  return attempt;
}

/// In later stages all may be tried once more.
void CleanupRounds::improve(PatchTask& task, const PatchBudget& budget, int thread, PatchResult& result) {
  auto& [contender, around] = task;
  std::sort(around.sites.begin(), around.sites.end(), [](const PatchSite& a, const PatchSite& b) {
    return geometry::lexicographically_less(a.position, b.position);
  });
  if (stage_ > 1)
    for (PatchSite& site : around.sites)
      site.rests = 0;
  const double size = Surroundings::radius(share_read * contender.separation, around.narrowings) / Rules::reach;
  result =
      optimizers_[thread]->improve(contender.place, size, around.sites, budget, hash_of(contender.place, 1 + round_));
  make_canonical(result);
}

/// Sizes are asked for here, before all ranks agree on errors.
void CleanupRounds::make_canonical(PatchResult& result) const {
  for (SiteEdit& edit : result.edits) {
    edit.from = periods_.wrap(edit.from);
    edit.to = periods_.wrap(edit.to);
    if (edit.kind == EditKind::remove)
      continue;
    edit.size = sizing::checked_size(size_, edit.to);
    if (edit.boundary >= 0)
      edit.tolerance = boundary_.tolerance(edit.to);
  }
  for (BoundaryLink& link : result.links)
    link.position = periods_.wrap(link.position);
  for (SiteVerdict& verdict : result.verdicts)
    verdict.position = periods_.wrap(verdict.position);
}

/// Counts the results of the patches of this rank, and notes their edits on the boundary.
void CleanupRounds::count(const Attempt& attempt) {
  comm_.counters().add(Counter::cleanup_rounds);
  counts_.patches += std::ssize(attempt.results);
  for (const PatchResult& result : attempt.results) {
    counts_.better += !result.edits.empty();
    counts_.left += result.edits.empty() && !result.put_off;
    for (const SiteEdit& edit : result.edits) {
      counts_.moved += edit.kind == EditKind::move;
      counts_.inserted += edit.kind == EditKind::insert;
      counts_.deleted += edit.kind == EditKind::remove;
      counts_.on_boundary += edit.boundary >= 0;
    }
    boundary_.note(result.edits, round_);
  }
}

/// For each rank what concerns its sites. Edits go to the owners of the old places and of the new ones.
std::map<int, CleanupRounds::News> CleanupRounds::list_news(const Attempt& attempt) const {
  std::map<int, News> news;
  for (const PatchResult& result : attempt.results) {
    for (const SiteEdit& edit : result.edits) {
      const int from = sites_.owner(edit.from), to = sites_.owner(edit.to);
      news[from].edits.push_back(edit);
      if (to != from)
        news[to].edits.push_back(edit);
    }
    for (const BoundaryLink& link : result.links)
      news[sites_.owner(link.position)].links.push_back(link);
    for (const SiteVerdict& verdict : result.verdicts)
      news[sites_.owner(verdict.position)].verdicts.push_back(verdict);
  }
  for (const Disc& crowd : attempt.crowds) {
    news[comm_.rank()].crowds.push_back(crowd);
    for (const int rank : sites_.ranks_near(crowd))
      news[rank].crowds.push_back(crowd);
  }
  return news;
}

/// @return what concerns the own sites, of the own patches first
CleanupRounds::News CleanupRounds::exchange_news(const Attempt& attempt) const {
  std::map<int, News> by_rank = list_news(attempt);
  News all = std::move(by_rank[comm_.rank()]);
  std::vector<comm::Message> outgoing;
  for (const auto& [rank, news] : by_rank)
    if (rank != comm_.rank()) {
      comm::Parcel parcel;
      parcel.add(news.edits);
      parcel.add(news.links);
      parcel.add(news.verdicts);
      parcel.add(news.crowds);
      outgoing.push_back({rank, parcel.release()});
    }
  for (comm::Message& message : comm::exchange_among(comm_, attempt.choice.partners, outgoing)) {
    comm::Parcel parcel(std::move(message.data));
    join(all.edits, parcel.take<SiteEdit>());
    join(all.links, parcel.take<BoundaryLink>());
    join(all.verdicts, parcel.take<SiteVerdict>());
    join(all.crowds, parcel.take<Disc>());
  }
  return all;
}

/// Carries out the edits; then the owners know what the triangles of their sites are like, and where nothing helped.
/// Where sites crowd so much that no patch can hold them, nothing was tried. The sites around are not to ask for it one
/// after the other: their owners let all of them rest.
void CleanupRounds::take(const News& news) {
  for (const Disc& crowd : news.crowds)
    for (const geometry::Vec2 place : sites_.let_rest(crowd))
      candidates_.give_up(place, stage_);
  sites_.apply(news.edits, news.links);
  for (const SiteEdit& edit : news.edits)
    if (edit.kind != EditKind::insert)
      candidates_.drop(edit.from);
  for (const SiteVerdict& verdict : news.verdicts) {
    sites_.set_rest(verdict.position, verdict.rests != 0);
    if (!(verdict.alpha > 0)) {
      candidates_.drop(verdict.position);
      continue;
    }
    candidates_.set({verdict.position, verdict.size, verdict.alpha, verdict.obtuse != 0}); // it has not moved
    if (verdict.rests)
      candidates_.settle(verdict.position, stage_);
  }
}

void CleanupRounds::settle_failures(const Attempt& attempt) {
  for (std::size_t k = 0; k < attempt.results.size(); ++k)
    if (attempt.results[k].edits.empty() && !attempt.results[k].put_off)
      candidates_.settle(attempt.choice.own[k].contender.place, stage_);
}

CleanupCounts CleanupRounds::counts() const {
  constexpr std::array members{&CleanupCounts::patches,  &CleanupCounts::better,  &CleanupCounts::moved,
                               &CleanupCounts::inserted, &CleanupCounts::deleted, &CleanupCounts::on_boundary,
                               &CleanupCounts::left};
  static_assert(sizeof(CleanupCounts) == members.size() * sizeof(std::int64_t), "a member is missing");
  std::array<std::int64_t, members.size()> all{};
  for (std::size_t k = 0; k < members.size(); ++k)
    all[k] = counts_.*members[k];
  comm_.sum(all);
  CleanupCounts sums;
  for (std::size_t k = 0; k < members.size(); ++k)
    sums.*members[k] = all[k];
  return sums;
}

} // namespace trime::cleanup
