// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup.hpp"

#include "cleanup/cleanup_rounds.hpp"
#include "core/thread_loop.hpp"
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
using sites::Stage;
using sites::StageView;
using sites::Wanted;

constexpr std::ptrdiff_t sites_in_a_row = 1024; // by one thread

/// Is surely no triangle of a fan bad, see mesh::squares_surely_below? Triangles share edges from the site. There is no
/// branch, since nearly all fans are good.
bool is_surely_good(const mesh::BinnedPoints& points, LocalIndex site, const Fan& fan) {
  constexpr double largest = mesh::squares_surely_below(CleanupRules::bad_alpha);
  const Vec2 p = points.position(site);
  Vec2 u = points.position(fan.neighbour(0)) - p;
  double u2 = geometry::squared_length(u);
  bool good = true;
  for (std::size_t k = 1; k <= fan.triangles; ++k) {
    const Vec2 v = points.position(fan.neighbour(k)) - p;
    const double v2 = geometry::squared_length(v);
    good &= 2 * (u2 + v2 - geometry::dot(u, v)) < largest * geometry::cross(u, v);
    u = v;
    u2 = v2;
  }
  return good;
}

/// Is the triangle of a site on the boundary to be divided, see Patch::is_ear?
bool is_ear(const mesh::BinnedPoints& points, LocalIndex site, const Fan& fan) {
  return !fan.closed && fan.triangles == 1 &&
         is_wide_corner(points.position(site), points.position(fan.neighbour(0)), points.position(fan.neighbour(1)));
}

/// A site with the largest alpha in its fan if that is bad and finite, else 0. @pre the fan is complete
Candidate candidate_at(const SiteState& state, LocalIndex site, const Fan& fan, const CleanupOptions& options) {
  const mesh::BinnedPoints& points = state.points();
  const Vec2 p = points.position(site);
  Candidate candidate{p, state.sizes()[site]};
  const double more = options.split_ears && is_ear(points, site, fan) ? CleanupRules::ear_alpha : 0;
  if (more == 0 && is_surely_good(points, site, fan))
    return candidate;
  for (std::size_t k = 0; k < fan.triangles; ++k) {
    const Vec2 q = points.position(fan.neighbour(k)), r = points.position(fan.neighbour(k + 1));
    const double alpha = more + mesh::aspect_ratio(p, q, r);
    candidate.alpha = std::max(candidate.alpha, alpha);
    candidate.obtuse = candidate.obtuse || (alpha > mesh::least_obtuse_alpha && mesh::is_obtuse(p, q, r));
  }
  if (!(candidate.alpha > options.bad_alpha && std::isfinite(candidate.alpha)))
    candidate.alpha = 0;
  return candidate;
}

/// Finds the bad triangles of the owned sites, by stars that are computed here. Collective.
std::vector<Candidate> find_candidates(Stage& stage, const geometry::Lattice& lattice,
                                       const delaunay::StarBuilder& builder, const CleanupOptions& options) {
  SiteState& state = *stage.state;
  state.compute_stars(builder, *stage.size, Wanted::all_sites);
  const StageView view = stage.view(lattice);
  const mesh::BinnedPoints& points = state.points();
  return gather_in_order<Candidate>(
      points.owned(), sites_in_a_row, [&](std::ptrdiff_t item, std::vector<Candidate>& list) {
        const auto i = static_cast<LocalIndex>(item);
        const Fan fan = inside_fan(view, i);
        if (!state.stars().certain(i) || !fan.complete)
          return;
        if (const Candidate candidate = candidate_at(state, i, fan, options); candidate.alpha > 0)
          list.push_back(candidate);
      });
}

} // namespace

CleanupCounts mend(Stage& stage, const geometry::Boundary& meshed, const geometry::Lattice& lattice,
                   const delaunay::StarBuilder& builder, const CleanupOptions& options) {
  CleanupRounds rounds(stage, meshed, lattice, options, find_candidates(stage, lattice, builder, options));
  for (int k = 1; k <= CleanupRules::stages + CleanupRules::obtuse_stages; ++k)
    rounds.run_stage(k);
  const CleanupCounts all = rounds.counts();
  if (all.better > 0)
    rounds.finish(stage, builder);
  return all;
}

} // namespace trime::cleanup
