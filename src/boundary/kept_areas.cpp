// SPDX-License-Identifier: BSD-3-Clause
// Moves the sites of simplified interfaces so far that the regions on both sides keep their areas.

#include "boundary/boundary_refiner.hpp"
#include "boundary/rules.hpp"

#include <algorithm>
#include <cmath>

namespace trime::boundary {

using geometry::Vec2;

namespace {

// [rounds] Each round holds the sites that would come too near to others; then nothing moves.
constexpr int most_rounds = 8;

// [steps] The first step leaves about the square of the relative shift; two more reach the accuracy of numbers.
constexpr int newton_steps = 4;

double area_beside(const std::vector<Vec2>& path, Vec2 place, bool closed) {
  double twice = closed ? cross(path.back() - place, path.front() - place) : 0;
  for (std::size_t k = 1; k < path.size(); ++k)
    twice += cross(path[k - 1] - place, path[k] - place);
  return 0.5 * twice;
}

} // namespace

struct BoundaryRefiner::Chain {
  std::vector<LocalIndex> sites;
  std::vector<double> sizes; // h by site
  bool closed;
  Vec2 place;  // where the curve begins
  double area; // wanted between the sites and the lines from the place to the ends
};

/// The simplified interfaces of straight pieces; sites on circles must stay there.
std::vector<BoundaryRefiner::Chain> BoundaryRefiner::simplified_chains() const {
  std::vector<Chain> chains;
  for (std::size_t loop = boundary_loops_; loop < loop_first_.size(); ++loop) {
    const geometry::InnerArc& arc = curves_->arc(loop - boundary_loops_);
    if (!arc.is_simplified ||
        std::ranges::any_of(arc.pieces, [](const geometry::Piece& piece) { return piece.circular; }))
      continue;
    Chain& chain = chains.emplace_back();
    chain.closed = arc.closed;
    chain.place = arc.pieces.front().start;
    std::vector<Vec2> given{chain.place};
    for (const geometry::Piece& piece : arc.pieces)
      given.push_back(piece.end);
    chain.area = area_beside(given, chain.place, false) + arc.lost_area;
    for (LocalIndex k = loop_first_[loop]; k >= 0 && (chain.sites.empty() || k != loop_first_[loop]);
         k = sites_[k].next) {
      chain.sites.push_back(k);
      chain.sizes.push_back(metrics_[loop].sizes(sites_[k].t).asked);
    }
  }
  return chains;
}

/// Moves the sites of a chain to the right, in proportion to h, until the area on its left is what it should be.
/// @param is_held sites that stay
void BoundaryRefiner::shift(const Chain& chain, const std::vector<char>& is_held) {
  const std::size_t n = chain.sites.size();
  std::vector<Vec2> given(n), outward(n), path(n);
  double width = 0;
  for (std::size_t k = 0; k < n; ++k)
    given[k] = sites_[chain.sites[k]].position;
  for (std::size_t k = 0; k < n; ++k) {
    const Site& site = sites_[chain.sites[k]];
    if (site.kind != SiteKind::plain || site.vertex != chain.sites[k] || is_held[chain.sites[k]] != 0 ||
        (!chain.closed && (k == 0 || k + 1 == n)))
      continue;
    const Vec2 along = given[k + 1 < n ? k + 1 : 0] - given[k > 0 ? k - 1 : n - 1];
    const double way = length(along);
    if (!(way > 0))
      continue;
    outward[k] = (-chain.sizes[k] / way) * geometry::left_normal(along);
    width += 0.5 * chain.sizes[k] * way;
  }
  if (!(width > 0))
    return;
  double shift = 0; // in h
  path = given;
  for (int step = 0; step < newton_steps; ++step) {
    shift += (chain.area - area_beside(path, chain.place, chain.closed)) / width;
    shift = std::clamp(shift, -BoundaryRules::most_area_shift, BoundaryRules::most_area_shift);
    for (std::size_t k = 0; k < n; ++k)
      path[k] = given[k] + shift * outward[k];
  }
  for (std::size_t k = 0; k < n; ++k)
    if (outward[k] != Vec2{})
      sites_[chain.sites[k]].position = lattice_.snap(path[k]);
}

/// Holds the sites at chords whose circles are not empty. Returns false if there are none.
bool BoundaryRefiner::hold_offenders(std::vector<char>& is_held) const {
  std::vector<SiteTree::Entry> items;
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(sites_.size()); ++k)
    if (sites_[k].vertex == k)
      items.push_back({boundary_.periods.wrap(sites_[k].position), k});
  const SiteTree tree(std::move(items));
  bool any = false;
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(sites_.size()); ++k) {
    if (sites_[k].next < 0)
      continue;
    const LocalIndex intruder = find_intruder(tree, k);
    if (intruder < 0 && find_intruder(inside_tree_, k, true) < 0)
      continue;
    any = true;
    for (const LocalIndex site : {k, sites_[k].next, intruder})
      if (site >= 0)
        is_held[site] = 1;
  }
  return any;
}

void BoundaryRefiner::keep_areas() {
  const std::vector<Chain> chains = simplified_chains();
  if (chains.empty())
    return;
  std::vector<Vec2> given;
  for (const Site& site : sites_)
    given.push_back(site.position);
  std::vector<char> is_held(sites_.size(), 0);
  for (int round = 0; round < most_rounds; ++round) {
    for (const Chain& chain : chains)
      shift(chain, is_held);
    if (!hold_offenders(is_held))
      return;
    for (std::size_t k = 0; k < given.size(); ++k)
      sites_[static_cast<LocalIndex>(k)].position = given[k];
  }
}

} // namespace trime::boundary
