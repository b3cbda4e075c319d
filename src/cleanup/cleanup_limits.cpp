// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_limits.hpp"

#include "cleanup/rules.hpp"
#include "core/random.hpp"
#include "decomposition/selection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

namespace trime::cleanup {
namespace {

using geometry::Vec2;

/// The worst first, in a few classes; then by the hash.
std::uint64_t order_of(double alpha, std::uint64_t hash) {
  constexpr int bits = 4;   // of the key, for the class
  std::uint64_t better = 0; // limits that it is below
  for (const double limit : CleanupRules::classes)
    better += alpha < limit;
  return (better << (64 - bits)) | (hash >> bits);
}

} // namespace

std::uint64_t hash_of(Vec2 place, int salt) {
  return mix_bits(mix_bits(std::bit_cast<std::uint64_t>(place.x) + static_cast<std::uint64_t>(salt)) ^
                  std::bit_cast<std::uint64_t>(place.y));
}

/// The key of the cell of a place, a few h wide, in its tile: the same on any number of ranks.
std::uint64_t CleanupCandidates::cell_key(Vec2 p, double h) const {
  int exponent = 0;
  std::frexp(h, &exponent);
  const Vec2 cell{std::floor(std::ldexp(p.x, -CleanupRules::contender_cell - exponent)),
                  std::floor(std::ldexp(p.y, -CleanupRules::contender_cell - exponent))};
  const mesh::Tile& tile = grid_.tile(grid_.tile_at(p));
  return mix_bits(hash_of(cell, exponent) + (std::uint64_t{tile.x} << 32 | tile.y));
}

void CleanupCandidates::set(const Candidate& candidate) {
  const auto [known, is_new] =
      entry_at_.try_emplace(hash_of(candidate.place, 0), static_cast<std::uint32_t>(entries_.size()));
  if (is_new)
    entries_.emplace_back();
  Entry& entry = entries_[known->second];
  entry.candidate = candidate;
  entry.cell = cell_key(candidate.place, candidate.size);
}

/// The entry stays in the list until there are many such.
void CleanupCandidates::drop(Vec2 place) {
  if (const auto known = entry_at_.find(hash_of(place, 0)); known != entry_at_.end())
    entries_[known->second] = {{place}};
}

void CleanupCandidates::settle(Vec2 place, int stage) {
  if (const auto known = entry_at_.find(hash_of(place, 0));
      known != entry_at_.end() && entries_[known->second].candidate.alpha > 0)
    entries_[known->second].settled = stage;
}

void CleanupCandidates::give_up(Vec2 place, int stage) {
  if (const auto known = entry_at_.find(hash_of(place, 0));
      known != entry_at_.end() && entries_[known->second].candidate.alpha > 0) {
    entries_[known->second].candidate.alpha = CleanupRules::bad_alpha;
    entries_[known->second].candidate.obtuse = false;
    entries_[known->second].settled = stage;
  }
}

double CleanupCandidates::worst() const {
  double worst = 1;
  for (const Entry& entry : entries_)
    worst = std::max(worst, entry.candidate.alpha);
  return worst;
}

/// Removes the entries that are no longer candidates, once they are at least half of all.
void CleanupCandidates::forget_the_good() {
  const auto is_good = [](const Entry& entry) { return !(entry.candidate.alpha > 0); };
  if (2 * std::count_if(entries_.begin(), entries_.end(), is_good) < std::ssize(entries_))
    return;
  std::erase_if(entries_, is_good);
  entry_at_.clear();
  for (std::size_t k = 0; k < entries_.size(); ++k)
    entry_at_[hash_of(entries_[k].candidate.place, 0)] = static_cast<std::uint32_t>(k);
}

std::vector<Contender> CleanupCandidates::contenders(const ContenderRule& rule) {
  forget_the_good();
  std::unordered_map<std::uint64_t, const Candidate*> worst;
  for (const Entry& entry : entries_) {
    const Candidate& own = entry.candidate;
    if (!(own.alpha > rule.above) || (rule.only_obtuse && !own.obtuse) || entry.settled >= rule.stage ||
        !(rule.separation * own.size < rule.most_separation))
      continue;
    const auto [known, is_new] = worst.try_emplace(entry.cell, &own);
    const Candidate& other = *known->second;
    if (!is_new && (own.alpha > other.alpha ||
                    (own.alpha == other.alpha && geometry::lexicographically_less(own.place, other.place))))
      known->second = &own;
  }
  std::vector<Contender> contenders;
  contenders.reserve(worst.size());
  for (const auto& [cell, own] : worst)
    contenders.push_back(
        {own->place, rule.separation * own->size, order_of(own->alpha, hash_of(own->place, 1 + rule.round))});
  // The order of a map may differ from machine to machine.
  std::sort(contenders.begin(), contenders.end(),
            [](const Contender& a, const Contender& b) { return geometry::lexicographically_less(a.place, b.place); });
  return contenders;
}

namespace {

using decomposition::selection_threshold;
using polygon::EditKind;

// Share of the sites: with less room than this, or with fewer sites than wanted by this share, the handicaps apply.
constexpr double scarcity = 0.001;

using Rules = CleanupRules;

int gain_of(const std::vector<SiteEdit>& edits) {
  int gain = 0;
  for (const SiteEdit& edit : edits)
    gain += edit.kind == EditKind::insert ? 1 : edit.kind == EditKind::remove ? -1 : 0;
  return gain;
}

/// Takes back what gains sites (sign 1), or loses them (sign -1), beyond the first `most` of them.
void limit(const comm::Communicator& comm, int sign, GlobalId most, std::span<const ChosenContender> chosen,
           std::vector<PatchResult>& results) {
  std::vector<std::uint64_t> keys;
  for (std::size_t k = 0; k < results.size(); ++k) // as often as it counts
    keys.insert(keys.end(), static_cast<std::size_t>(std::max(0, sign * gain_of(results[k].edits))),
                chosen[k].contender.order);
  const std::uint64_t threshold = selection_threshold(comm, keys, std::max<GlobalId>(0, most));
  for (std::size_t k = 0; k < results.size(); ++k)
    if (sign * gain_of(results[k].edits) > 0 && !(chosen[k].contender.order < threshold))
      results[k] = {{}, {}, {}, true};
}

} // namespace

CleanupLimits::CleanupLimits(GlobalId sites, GlobalId most_points, GlobalId inner_edges)
    : wanted_sites_(sites), sites_(sites) {
  const GlobalId leeway = static_cast<GlobalId>(Rules::largest_loss * static_cast<double>(sites)) + 1;
  const auto at_curves = static_cast<GlobalId>(Rules::inserted_per_inner_edge * static_cast<double>(inner_edges));
  most_points_ = most_points > 0 ? std::max(most_points, sites) : sites + leeway + at_curves;
  least_sites_ = sites - leeway;
  for_last_stage_ = 1 + static_cast<GlobalId>(Rules::reserved * static_cast<double>(most_points_));
  if (inner_edges > 0) // places along curves need sites in all stages
    for_last_stage_ = std::min(for_last_stage_, (most_points_ - sites) / 4);
}

/// For more sites. Some are kept for places where nothing but smaller triangles helps.
GlobalId CleanupLimits::room(int stage) const {
  return most_points_ - sites_ - (stage >= Rules::stages ? 0 : for_last_stage_);
}

PatchBudget CleanupLimits::budget(int stage, double again_alpha) const {
  const auto share = [&](GlobalId of) { return std::clamp<GlobalId>(of, 0, Rules::patch_budget); };
  const double most = static_cast<double>(most_points_), wanted = static_cast<double>(wanted_sites_);
  const bool crowded = static_cast<double>(room(stage)) < scarcity * most;
  const bool scarce = static_cast<double>(sites_) < (1 - scarcity) * wanted;
  const GlobalId for_obtuse =
      stage > Rules::stages ? 0 : static_cast<GlobalId>(Rules::reserved_for_obtuse * static_cast<double>(most_points_));
  PatchBudget budget;
  budget.may_insert = share(std::min(room(stage), most_points_ - sites_ - for_obtuse));
  budget.may_refine = std::clamp<GlobalId>(most_points_ - sites_ - for_obtuse, 0, Rules::most_refined);
  budget.may_delete = share(sites_ - least_sites_);
  budget.is_again = stage > 1;
  budget.again_alpha = again_alpha;
  budget.is_last = stage == Rules::stages + Rules::obtuse_stages;
  if (stage > Rules::stages)
    budget.obtuse_weight = Rules::obtuse_weight[at(stage - Rules::stages - 1)];
  budget.deletion_handicap = crowded ? Rules::handicap_if_crowded : scarce ? Rules::handicap_if_scarce : 1;
  return budget;
}

CleanupLimits::Gains CleanupLimits::gains_of(std::span<const PatchResult> results) {
  Gains gains;
  for (const PatchResult& result : results) {
    const int gain = gain_of(result.edits);
    (gain < 0 ? gains.taken : gains.added) += std::abs(gain);
  }
  return gains;
}

void CleanupLimits::count(const comm::Communicator& comm, const Gains& all, std::span<const ChosenContender> chosen,
                          std::vector<PatchResult>& results) {
  const GlobalId gain = all.added - all.taken, most = std::max<GlobalId>(0, most_points_ - sites_);
  if (gain > most)
    limit(comm, 1, most + all.taken, chosen, results);
  else if (-gain > sites_ - least_sites_)
    limit(comm, -1, sites_ - least_sites_ + all.added, chosen, results);
  else {
    sites_ += gain;
    return;
  }
  const Gains left = gains_of(results);
  sites_ += comm.sum(left.added - left.taken);
}

} // namespace trime::cleanup
