// SPDX-License-Identifier: BSD-3-Clause
// Moves the sites of simplified interfaces so far that the regions on both sides keep their areas.

#include "boundary/boundary_refiner.hpp"
#include "boundary/rules.hpp"
#include "core/angle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trime::boundary {

using geometry::Vec2;

namespace {

// [rounds] Each round holds the sites that would come too near to others; then nothing moves.
constexpr int most_rounds = 12;

// [rounds] Later rounds hold all sites of an interface on which a site is held.
constexpr int rounds_of_sites = 5;

// [steps] The first step leaves about the square of the relative shift; two more reach the accuracy of numbers.
constexpr int newton_steps = 4;

/// @param winding of a closed path, see geometry::Loop
double area_beside(const std::vector<Vec2>& path, Vec2 place, bool closed, Vec2 winding) {
  double twice = closed ? cross(path.back() - place, path.front() + winding - place) : 0;
  if (closed && winding != Vec2{}) // along the lines from the place, and its image, to the ends
    twice -= cross(winding, path.front() - place);
  for (std::size_t k = 1; k < path.size(); ++k)
    twice += cross(path[k - 1] - place, path[k] - place);
  return 0.5 * twice;
}

} // namespace

struct BoundaryRefiner::Chain {
  const geometry::InnerArc& arc;
  std::vector<LocalIndex> sites;
  std::vector<double> sizes; // h by site
  bool closed;
  Vec2 place;  // where the curve begins
  double area; // wanted between the sites and the lines from the place to the ends
};

/// The sites on a curve inside, and the area of its given form.
BoundaryRefiner::Chain BoundaryRefiner::chain_on(std::size_t loop) const {
  const geometry::InnerArc& arc = curves_->arc(loop - boundary_loops_);
  Chain chain{arc, {}, {}, arc.closed, arc.pieces.front().start, arc.lost_area};
  for (const geometry::Piece& piece : arc.pieces) {
    chain.area += 0.5 * cross(piece.start - chain.place, piece.end - chain.place);
    if (piece.circular)
      chain.area += 0.5 * piece.radius * piece.radius * (piece.sweep - std::sin(piece.sweep));
  }
  for (LocalIndex k = loop_first_[loop]; k >= 0 && (chain.sites.empty() || k != loop_first_[loop]);
       k = sites_[k].next) {
    chain.sites.push_back(k);
    chain.sizes.push_back(metrics_[loop].sizes(sites_[k].t).asked);
  }
  return chain;
}

/// Does a chord pass by a corner of the curve?
bool BoundaryRefiner::leaves_out_corners(const Chain& chain) const {
  const double turn = corner_angle_ * (pi / 180);
  return std::ranges::any_of(chain.sites, [&](LocalIndex k) {
    const Site& site = sites_[k];
    return site.next >= 0 && metrics_[site.loop].corners_between(site.t, end_t(site), turn) > 0;
  });
}

/// The interfaces of straight pieces that are not as they were given; sites on circles must stay there.
std::vector<BoundaryRefiner::Chain> BoundaryRefiner::simplified_chains() const {
  std::vector<Chain> chains;
  if (boundary_.periods.any()) // all corners are kept
    return chains;
  for (std::size_t loop = boundary_loops_; loop < loop_first_.size(); ++loop) {
    const geometry::InnerArc& arc = curves_->arc(loop - boundary_loops_);
    if (arc.left == arc.right ||
        std::ranges::any_of(arc.pieces, [](const geometry::Piece& piece) { return piece.circular; }))
      continue;
    Chain chain = chain_on(loop);
    if (arc.is_simplified || leaves_out_corners(chain))
      chains.push_back(std::move(chain));
  }
  return chains;
}

/// Returns the areas that regions lose to each other on the interfaces, and at nodes that became one.
std::vector<geometry::RegionLoss> BoundaryRefiner::losses() const {
  std::vector<geometry::RegionLoss> losses = curves_->losses();
  for (std::size_t loop = boundary_loops_; loop < loop_first_.size(); ++loop) {
    const Chain chain = chain_on(loop);
    if (chain.arc.left == chain.arc.right)
      continue;
    std::vector<Vec2> path;
    for (const LocalIndex k : chain.sites)
      path.push_back(sites_[k].position);
    const double lost = chain.area - area_beside(path, chain.place, chain.closed, chain.arc.winding);
    const bool is_simpler = chain.arc.is_simplified || leaves_out_corners(chain);
    losses.push_back({lost > 0 ? chain.arc.left : chain.arc.right, lost > 0 ? chain.arc.right : chain.arc.left,
                      is_simpler ? geometry::LossReason::thinning : geometry::LossReason::chords, std::fabs(lost), 1,
                      std::fabs(lost), boundary_.periods.wrap(path[path.size() / 2])});
  }
  return losses;
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
    shift += (chain.area - area_beside(path, chain.place, chain.closed, chain.arc.winding)) / width;
    shift = std::clamp(shift, -BoundaryRules::most_area_shift, BoundaryRules::most_area_shift);
    for (std::size_t k = 0; k < n; ++k)
      path[k] = given[k] + shift * outward[k];
  }
  for (std::size_t k = 0; k < n; ++k)
    if (outward[k] != Vec2{})
      sites_[chain.sites[k]].position = lattice_.snap(path[k]);
}

/// Holds the sites at chords whose circles are not empty. Returns whether there is such a chord.
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
    for (const Chain& chain : chains)
      if (round + 1 >= rounds_of_sites &&
          std::ranges::any_of(chain.sites, [&](LocalIndex site) { return is_held[site] != 0; }))
        for (const LocalIndex site : chain.sites)
          is_held[site] = 1;
  }
}

} // namespace trime::boundary
