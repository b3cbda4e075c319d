// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/cleanup.hpp"

#include "core/gather.hpp"
#include "meshing/extraction.hpp"
#include "meshing/selection.hpp"
#include "trime/comm/agree.hpp"
#include "trime/core/thread_loop.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace trime::meshing {
namespace {

using geometry::Vec2;

constexpr double reserved = 0.006;    // of the sites
constexpr GlobalId most_refined = 40; // sites, by one patch
constexpr int stages = 3;
constexpr GlobalId least_budget = 10;  // of sites, for a patch, if there are so many
constexpr double largest_loss = 0.005; // of the sites
/// Where sites, or room for more of them, are fewer than this share of all: factor on the sum of a trial that deletes.
constexpr double scarcity = 0.001, handicap_if_scarce = 1.5, handicap_if_crowded = 0.85;
constexpr double again_share = 0.85; // of the excess of the worst triangle: places that come near it are tried again
constexpr double largest_share_of_period = 0.45; // for what keeps two patches apart
constexpr std::ptrdiff_t sites_in_a_row = 1024;  // by one thread

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

int gain_of(const std::vector<SiteEdit>& edits) {
  int gain = 0;
  for (const SiteEdit& edit : edits)
    gain += edit.kind == EditKind::insert ? 1 : edit.kind == EditKind::remove ? -1 : 0;
  return gain;
}

} // namespace

void CleanupCounts::add(const CleanupCounts& other) {
  patches += other.patches;
  better += other.better;
  moved += other.moved;
  inserted += other.inserted;
  deleted += other.deleted;
  on_boundary += other.on_boundary;
  left += other.left;
}

Cleanup::Cleanup(const comm::Communicator& comm, Layout& layout, const geometry::Boundary& boundary,
                 const geometry::Lattice& lattice, const delaunay::StarBuilder& builder, GlobalId most_sites,
                 const PatchOptions& options)
    : comm_(comm), layout_(layout), state_(*layout.state), curve_(boundary), lattice_(lattice), builder_(builder),
      options_(options), most_sites_(most_sites), sites_(comm.sum(std::int64_t{state_.points().owned()})),
      chain_(layout.boundary, curve_), optimizers_(chain_, lattice_, options_), candidates_(state_.grid()) {
  const GlobalId leeway = static_cast<GlobalId>(largest_loss * static_cast<double>(sites_)) + 1;
  most_sites_ = most_sites_ > 0 ? std::max(most_sites_, sites_) : sites_ + leeway;
  wanted_sites_ = sites_;
  least_sites_ = sites_ - leeway;
}

/// Of the owned sites, by the stars of the state.
void Cleanup::find_candidates() {
  state_.compute_stars(builder_, *layout_.size, Wanted::all_sites);
  const ExtractionContext context{state_, layout_.boundary, *layout_.size, lattice_};
  const mesh::BinnedPoints& points = state_.points();
  const std::vector<Candidate> found = gather_in_order<Candidate>(
      points.owned(), sites_in_a_row, [&](std::ptrdiff_t item, std::vector<Candidate>& list) {
        const auto i = static_cast<LocalIndex>(item);
        const Fan fan = inside_fan(context, i);
        if (!state_.stars().certain(i) || !fan.complete)
          return;
        const Vec2 p = points.position(i);
        double worst = 0;
        for (std::size_t k = 0; k < fan.triangles; ++k)
          if (const Vec2 q = points.position(fan.neighbour(k)), r = points.position(fan.neighbour(k + 1));
              !mesh::is_surely_below(options_.bad_alpha, p, q, r))
            worst = std::max(worst, mesh::aspect_ratio(p, q, r));
        if (worst > options_.bad_alpha && std::isfinite(worst))
          list.push_back({p, state_.sizes()[i], worst});
      });
  for (const Candidate& candidate : found)
    candidates_.set(candidate);
}

/// What is bad enough to be tried again: in a good mesh also what is bad there only.
double Cleanup::find_again_alpha() const {
  return std::clamp(1 + again_share * (comm_.max(candidates_.worst()) - 1), options_.bad_alpha, options_.again_alpha);
}

std::vector<Contender> Cleanup::list_contenders() {
  const geometry::Periods& periods = state_.grid().periods();
  const double most_separation =
      largest_share_of_period * std::min(periods.x > 0 ? periods.x : INFINITY, periods.y > 0 ? periods.y : INFINITY);
  return candidates_.contenders(
      {stage_, stage_ == 1 ? 0 : again_alpha_, 2 * options_.reach - PatchOptions::clearance, most_separation, round_});
}

/// How far chords may pass from curves with corners between, at these sites of the chain.
void Cleanup::find_tolerances(std::span<const LocalIndex> boundary_sites) {
  tolerances_.resize(chain_.sites().sites.size(), 0);
  if (!(options_.tolerance > 0))
    return;
  comm::run_agreed(comm_, [&] {
    thread_loop(static_cast<std::ptrdiff_t>(boundary_sites.size()), 256, [&](std::ptrdiff_t k, int) {
      const std::size_t site = at(boundary_sites[static_cast<std::size_t>(k)]);
      tolerances_[site] = options_.tolerance * layout_.asked_size->size(chain_.sites().sites[site].position);
    });
  });
}

/// For more sites. Some are kept for places where nothing but smaller triangles helps.
GlobalId Cleanup::room() const {
  const GlobalId reserve =
      stage_ == stages ? 0 : 1 + static_cast<GlobalId>(reserved * static_cast<double>(most_sites_));
  return most_sites_ - sites_ - reserve;
}

/// A share of what the limits leave, for each patch.
PatchBudget Cleanup::budget(std::size_t own_patches) const {
  const GlobalId patches = std::max<GlobalId>(1, comm_.sum(static_cast<std::int64_t>(own_patches)));
  const auto share = [&](GlobalId of) {
    return std::min(std::max<GlobalId>(of, 0), std::max(least_budget, of / patches));
  };
  const GlobalId spare = sites_ - least_sites_;
  const bool crowded = static_cast<double>(room()) < scarcity * static_cast<double>(most_sites_);
  const bool scarce = static_cast<double>(sites_) < (1 - scarcity) * static_cast<double>(wanted_sites_);
  const GlobalId may_refine = std::min(most_refined, most_sites_ - sites_);
  return {share(room()), may_refine,   share(spare),
          stage_ > 1,    again_alpha_, crowded ? handicap_if_crowded : scarce ? handicap_if_scarce : 1};
}

std::vector<PatchResult> Cleanup::try_patches(std::span<const Contender> chosen) {
  const double share = options_.reach / (2 * options_.reach - PatchOptions::clearance);
  std::vector<Disc> discs;
  for (const Contender& contender : chosen)
    discs.push_back({contender.place, share * contender.separation});
  std::vector<Surroundings> around = places_->around(discs, options_.most_sites);
  std::vector<PatchResult> results(chosen.size());
  const PatchBudget its_budget = budget(chosen.size());
  comm::run_agreed(comm_, [&] {
    thread_loop(static_cast<std::ptrdiff_t>(chosen.size()), 1, [&](std::ptrdiff_t item, int thread) {
      const auto k = static_cast<std::size_t>(item);
      std::vector<PatchSite>& sites = around[k].sites;
      if (!around[k].found()) // where sites crowd so much, nothing is tried
        return;
      std::sort(sites.begin(), sites.end(), [](const PatchSite& a, const PatchSite& b) {
        return geometry::lexicographically_less(a.position, b.position);
      });
      for (PatchSite& site : sites) {
        if (site.boundary >= 0)
          site.tolerance = tolerances_[at(site.boundary)];
        if (stage_ > 1)
          site.rests = 0;
      }
      const double size = Surroundings::radius(discs[k].radius, around[k].narrowings) / options_.reach;
      results[k] = optimizers_[thread].improve(chosen[k].place, size, sites, its_budget);
    });
  });
  return results;
}

/// Empties the results of patches that add or take too many sites: one that adds may, where another one takes. They
/// may try again.
void Cleanup::keep_within_limits(std::span<const Contender> chosen, std::vector<PatchResult>& results) const {
  std::array<std::int64_t, 2> gains{}; // of those that add, and those that take
  for (const PatchResult& result : results) {
    const int gain = gain_of(result.edits);
    gains[gain < 0] += std::abs(gain);
  }
  comm_.sum(gains);
  const auto limit = [&](int sign, GlobalId most) {
    std::vector<std::uint64_t> keys;
    for (std::size_t k = 0; k < results.size(); ++k) // as often as it counts
      keys.insert(keys.end(), static_cast<std::size_t>(std::max(0, sign * gain_of(results[k].edits))), chosen[k].order);
    const std::uint64_t threshold = selection_threshold(comm_, keys, std::max<GlobalId>(0, most));
    for (std::size_t k = 0; k < results.size(); ++k)
      if (sign * gain_of(results[k].edits) > 0 && !(chosen[k].order < threshold))
        results[k] = {{}, {}, 0, true};
  };
  if (const GlobalId most = std::max<GlobalId>(0, most_sites_ - sites_); gains[0] - gains[1] > most)
    limit(1, most + gains[1]);
  else if (gains[1] - gains[0] > sites_ - least_sites_)
    limit(-1, sites_ - least_sites_ + gains[0]);
}

/// All edits of this rank, with canonical places, counted.
std::vector<SiteEdit> Cleanup::collect(std::span<const Contender> chosen, const std::vector<PatchResult>& results,
                                       CleanupCounts& counts) {
  const geometry::Periods& periods = state_.grid().periods();
  std::vector<SiteEdit> all;
  counts.patches = static_cast<std::int64_t>(chosen.size());
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const PatchResult& result = results[k];
    counts.better += !result.edits.empty();
    counts.left += result.edits.empty() && !result.put_off;
    for (SiteEdit edit : result.edits) {
      edit.from = periods.wrap(edit.from);
      edit.to = periods.wrap(edit.to);
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

/// The owners learn what the triangles of their sites are like.
void Cleanup::take_verdicts(std::span<const Contender> chosen, const std::vector<PatchResult>& results) {
  const geometry::Periods& periods = state_.grid().periods();
  std::map<int, std::vector<SiteVerdict>> by_rank;
  for (std::size_t k = 0; k < chosen.size(); ++k)
    for (SiteVerdict verdict : results[k].verdicts) {
      verdict.position = periods.wrap(verdict.position);
      by_rank[places_->owner(verdict.position)].push_back(verdict);
    }
  for (const SiteVerdict& verdict : send(comm_, by_rank)) {
    places_->set_rest(verdict.position, verdict.rests != 0);
    if (!(verdict.alpha > 0)) {
      candidates_.drop(verdict.position);
      continue;
    }
    candidates_.set({verdict.position, verdict.size, verdict.alpha}); // it has not moved
    if (verdict.rests)
      candidates_.settle(verdict.position, stage_);
  }
}

/// All ranks learn what happens on the boundary, of which each has a copy; new sites get their indices.
void Cleanup::edit_the_boundary(std::vector<SiteEdit>& edits) {
  std::vector<BoundaryEdit> own;
  for (const SiteEdit& edit : edits)
    if (edit.boundary >= 0)
      own.push_back({edit.boundary, edit.kind, edit.arc, edit.to, edit.patch});
  const std::size_t before = chain_.sites().sites.size();
  const std::vector<LocalIndex> changed =
      chain_.apply(comm::from_bytes<BoundaryEdit>(comm_.all_gather(std::as_bytes(std::span<const BoundaryEdit>(own)))));
  find_tolerances(changed);
  std::map<std::pair<double, double>, LocalIndex> index_at;
  for (std::size_t k = before; k < chain_.sites().sites.size(); ++k)
    index_at[{chain_.sites().sites[k].position.x, chain_.sites().sites[k].position.y}] = static_cast<LocalIndex>(k);
  for (SiteEdit& edit : edits)
    if (edit.boundary >= 0 && edit.kind == EditKind::insert)
      edit.boundary = index_at.at({edit.to.x, edit.to.y});
}

/// To those of the old places and of the new ones.
std::vector<SiteEdit> Cleanup::send_to_owners(const std::vector<SiteEdit>& edits) const {
  std::map<int, std::vector<SiteEdit>> by_rank;
  for (const SiteEdit& edit : edits) {
    const int from = places_->owner(edit.from), to = places_->owner(edit.to);
    by_rank[from].push_back(edit);
    if (to != from)
      by_rank[to].push_back(edit);
  }
  return send(comm_, by_rank);
}

CleanupCounts Cleanup::sum_over_ranks(const CleanupCounts& own) const {
  std::array<std::int64_t, 7> all{own.patches, own.better,      own.moved, own.inserted,
                                  own.deleted, own.on_boundary, own.left};
  comm_.sum(all);
  return {all[0], all[1], all[2], all[3], all[4], all[5], all[6]};
}

CleanupCounts Cleanup::round(std::span<const Contender> contenders) {
  std::vector<Contender> chosen;
  for (const std::size_t k : choose_apart(comm_, *places_, state_.grid().periods(), contenders))
    chosen.push_back(contenders[k]);
  std::vector<PatchResult> results = try_patches(chosen);
  keep_within_limits(chosen, results);
  CleanupCounts counts;
  std::vector<SiteEdit> edits = collect(chosen, results, counts);
  edit_the_boundary(edits);
  const std::vector<SiteEdit> own = send_to_owners(edits);
  places_->apply(own);
  for (const SiteEdit& edit : own)
    if (edit.kind != EditKind::insert)
      candidates_.drop(edit.from);
  take_verdicts(chosen, results);
  for (std::size_t k = 0; k < chosen.size(); ++k)
    if (results[k].edits.empty() && !results[k].put_off)
      candidates_.settle(chosen[k].place, stage_);
  ++round_;
  counts = sum_over_ranks(counts);
  sites_ += counts.inserted - counts.deleted;
  return counts;
}

CleanupCounts Cleanup::run() {
  find_candidates();
  places_ = std::make_unique<CleanupSites>(comm_, state_, *layout_.size);
  std::vector<LocalIndex> all_of_boundary(chain_.sites().sites.size());
  for (std::size_t k = 0; k < all_of_boundary.size(); ++k)
    all_of_boundary[k] = static_cast<LocalIndex>(k);
  find_tolerances(all_of_boundary);
  CleanupCounts all;
  for (stage_ = 1; stage_ <= stages; ++stage_) {
    again_alpha_ = find_again_alpha();
    for (int k = 0; k < most_rounds; ++k) {
      const std::vector<Contender> contenders = list_contenders();
      if (comm_.sum(static_cast<std::int64_t>(contenders.size())) == 0)
        break;
      all.add(round(contenders));
    }
  }
  if (all.better > 0) {
    places_->finish(state_, chain_.renumber());
    layout_.boundary = chain_.sites();
    layout_.guard = std::make_unique<BoundaryGuard>(layout_.boundary, lattice_);
  }
  return all;
}

} // namespace trime::meshing
