// SPDX-License-Identifier: BSD-3-Clause
#include "cleanup/cleanup_boundary.hpp"

#include "comm/agree.hpp"
#include "sizing/size_blocks.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

namespace trime::cleanup {
namespace {

using polygon::BoundaryChain;
using polygon::BoundaryEdit;
using polygon::BoundarySites;
using polygon::EditKind;

} // namespace

CleanupBoundary::CleanupBoundary(const comm::Communicator& comm, const geometry::Boundary& curves,
                                 const BoundarySites& sites, const sizing::SizeField& size, double tolerance)
    : comm_(comm), sites_(sites), size_(size), tolerance_(tolerance), curve_(curves) {
  for (std::size_t loop = 0; loop + 1 < sites.loop_start.size(); ++loop)
    loops_.resize(at(sites.loop_start[loop + 1]), static_cast<LocalIndex>(loop));
  tolerances_.resize(sites.sites.size(), 0);
  if (tolerance > 0)
    comm::run_agreed(comm, [&] {
      sizing::loop_over_blocks(size_, std::ssize(tolerances_), [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        std::vector<geometry::Vec2> places;
        for (std::ptrdiff_t k = begin; k < end; ++k)
          places.push_back(sites.sites[static_cast<std::size_t>(k)].position);
        const std::vector<double> sizes = sizing::sizes_at(size_, places);
        for (std::size_t k = 0; k < places.size(); ++k)
          tolerances_[static_cast<std::size_t>(begin) + k] = tolerance_ * sizes[k];
      });
    });
}

BoundaryPlace CleanupBoundary::place(BoundaryName site) const {
  if (const auto known = known_.find(site); known != known_.end())
    return known->second;
  const auto k = static_cast<std::size_t>(site);
  TRIME_ASSERT(k < sites_.sites.size(), "the clean-up has no data of the boundary site {}", site);
  const polygon::BoundarySite& its = sites_.sites[k];
  return {loops_[k], its.corner, curve_.arc(loops_[k], its), tolerances_[k], its.next};
}

/// The arc is that of the piece and the way along it, as BoundaryChain holds them.
void CleanupBoundary::set_place(BoundaryName site, const SiteEdit& edit) {
  const polygon::BoundaryCurve::CurvePlace on = curve_.place(edit.loop, edit.arc);
  polygon::BoundarySite there{};
  there.piece = on.piece;
  there.along = on.along;
  known_[site] = {edit.loop, false, curve_.arc(edit.loop, there), edit.tolerance, -1};
}

void CleanupBoundary::set_next(BoundaryName site, BoundaryName next) {
  known_.try_emplace(site, place(site)).first->second.next = next;
}

void CleanupBoundary::note(std::span<const SiteEdit> edits, int round) {
  for (const SiteEdit& edit : edits)
    if (edit.boundary >= 0 || edit.boundary <= first_on_curve)
      edits_.push_back({round, edit.kind, edit.boundary, edit.made, edit.arc, edit.to, edit.patch});
}

/// The edits of a round.
void CleanupBoundary::carry_out(std::span<const Edit> edits, BoundaryChain& chain) {
  const auto index_of = [&](BoundaryName site) {
    const auto made = made_.find(site);
    return made != made_.end() ? made->second : static_cast<LocalIndex>(site);
  };
  std::vector<BoundaryEdit> list;
  std::map<std::pair<double, double>, BoundaryName> made_at;
  for (const Edit& edit : edits) {
    list.push_back({index_of(edit.site), edit.kind, edit.arc, edit.position, edit.patch});
    if (edit.kind == EditKind::insert)
      made_at[{edit.position.x, edit.position.y}] = edit.made;
  }
  std::size_t next = chain.sites().sites.size();
  chain.apply(std::move(list));
  for (; next < chain.sites().sites.size(); ++next) {
    const geometry::Vec2 p = chain.sites().sites[next].position;
    made_[made_at.at({p.x, p.y})] = static_cast<LocalIndex>(next);
  }
}

/// Takes the moves of sites on curves inside out of a list in the order of the rounds. Returns the last one of each
/// site, by site.
std::vector<polygon::InnerMove> CleanupBoundary::inner_moves(std::vector<Edit>& edits) {
  const auto inside =
      std::stable_partition(edits.begin(), edits.end(), [](const Edit& edit) { return edit.site >= 0; });
  std::stable_sort(inside, edits.end(), [](const Edit& a, const Edit& b) { return a.site > b.site; });
  std::vector<polygon::InnerMove> moves;
  for (auto edit = inside; edit != edits.end(); ++edit)
    if (edit + 1 == edits.end() || (edit + 1)->site != edit->site)
      moves.push_back({index_on_curve(edit->site), edit->position});
  edits.erase(inside, edits.end());
  return moves;
}

std::optional<BoundarySites> CleanupBoundary::finish() {
  std::vector<Edit> all = comm::from_bytes<Edit>(comm_.all_gather(std::as_bytes(std::span<const Edit>(edits_))));
  if (all.empty())
    return std::nullopt;
  std::stable_sort(all.begin(), all.end(), [](const Edit& a, const Edit& b) { return a.round < b.round; });
  const std::vector<polygon::InnerMove> moves = inner_moves(all);
  BoundaryChain chain(sites_, curve_);
  for (auto begin = all.begin(); begin != all.end();) {
    const auto end = std::find_if(begin, all.end(), [&](const Edit& edit) { return edit.round != begin->round; });
    carry_out({begin, end}, chain);
    begin = end;
  }
  new_index_ = chain.renumber();
  BoundarySites sites = chain.sites();
  sites.inner.move_sites(moves);
  return sites;
}

LocalIndex CleanupBoundary::index(BoundaryName site) const {
  if (!has_new_indices())
    return static_cast<LocalIndex>(site);
  const auto made = made_.find(site);
  return new_index_[at(made != made_.end() ? made->second : static_cast<LocalIndex>(site))];
}

} // namespace trime::cleanup
