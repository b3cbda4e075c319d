// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup.hpp"

#include "cleanup/cleanup_rounds.hpp"
#include "core/gather.hpp"
#include "sites/fan.hpp"
#include "trime/mesh/quality.hpp"

#include <algorithm>
#include <cmath>

namespace trime::cleanup {
namespace {

using geometry::Vec2;
using sites::Fan;
using sites::inside_fan;
using sites::SiteState;
using sites::StageView;
using sites::Wanted;

constexpr std::ptrdiff_t sites_in_a_row = 1024; // by one thread

/// The largest alpha in the fan of a site if that is bad and finite, else 0.
double worst_alpha(const mesh::BinnedPoints& points, LocalIndex site, const Fan& fan) {
  const Vec2 p = points.position(site);
  double worst = 0;
  for (std::size_t k = 0; k < fan.triangles; ++k)
    if (const Vec2 q = points.position(fan.neighbour(k)), r = points.position(fan.neighbour(k + 1));
        !mesh::is_surely_below(CleanupRules::bad_alpha, p, q, r))
      worst = std::max(worst, mesh::aspect_ratio(p, q, r));
  return worst > CleanupRules::bad_alpha && std::isfinite(worst) ? worst : 0;
}

/// Of the owned sites, by stars that are computed here. Collective.
std::vector<Candidate> find_candidates(const CleanupTask& task) {
  SiteState& state = task.state;
  state.compute_stars(task.builder, task.size, Wanted::all_sites);
  const StageView context{state, task.polygon, task.size, task.lattice};
  const mesh::BinnedPoints& points = state.points();
  return gather_in_order<Candidate>(points.owned(), sites_in_a_row,
                                    [&](std::ptrdiff_t item, std::vector<Candidate>& list) {
                                      const auto i = static_cast<LocalIndex>(item);
                                      const Fan fan = inside_fan(context, i);
                                      if (!state.stars().certain(i) || !fan.complete)
                                        return;
                                      if (const double alpha = worst_alpha(points, i, fan); alpha > 0)
                                        list.push_back({points.position(i), state.sizes()[i], alpha});
                                    });
}

} // namespace

CleanupCounts mend(const comm::Communicator& comm, const CleanupTask& task, const CleanupOptions& options) {
  CleanupRounds rounds(comm, task, options, find_candidates(task));
  CleanupCounts all;
  for (int stage = 1; stage <= CleanupRules::stages; ++stage)
    all.add(rounds.run_stage(stage));
  if (all.better > 0)
    rounds.finish(task);
  return all;
}

} // namespace trime::cleanup
