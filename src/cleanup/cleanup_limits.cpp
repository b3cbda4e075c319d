// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_limits.hpp"

#include "decomposition/selection.hpp"

#include <algorithm>
#include <cstdlib>

namespace trime::cleanup {
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

CleanupLimits::CleanupLimits(GlobalId sites, GlobalId most_points) : wanted_sites_(sites), sites_(sites) {
  const GlobalId leeway = static_cast<GlobalId>(Rules::largest_loss * static_cast<double>(sites)) + 1;
  most_points_ = most_points > 0 ? std::max(most_points, sites) : sites + leeway;
  least_sites_ = sites - leeway;
}

/// For more sites. Some are kept for places where nothing but smaller triangles helps.
GlobalId CleanupLimits::room(int stage) const {
  const GlobalId reserve =
      stage == Rules::stages ? 0 : 1 + static_cast<GlobalId>(Rules::reserved * static_cast<double>(most_points_));
  return most_points_ - sites_ - reserve;
}

PatchBudget CleanupLimits::budget(int stage, double again_alpha) const {
  const auto share = [&](GlobalId of) { return std::clamp<GlobalId>(of, 0, Rules::patch_budget); };
  const double most = static_cast<double>(most_points_), wanted = static_cast<double>(wanted_sites_);
  const bool crowded = static_cast<double>(room(stage)) < scarcity * most;
  const bool scarce = static_cast<double>(sites_) < (1 - scarcity) * wanted;
  PatchBudget budget;
  budget.may_insert = share(room(stage));
  budget.may_refine = std::min(GlobalId{Rules::most_refined}, most_points_ - sites_);
  budget.may_delete = share(sites_ - least_sites_);
  budget.is_again = stage > 1;
  budget.again_alpha = again_alpha;
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
