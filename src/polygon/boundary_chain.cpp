// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/boundary_chain.hpp"

#include "polygon/chord_curve.hpp"
#include "trime/core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trime::polygon {
BoundaryChain::BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve)
    : curve_(curve), sites_(boundary), is_gone_(boundary.sites.size(), 0) {
  for (std::size_t loop = 0; loop + 1 < boundary.loop_start.size(); ++loop)
    loops_.resize(at(boundary.loop_start[loop + 1]), static_cast<LocalIndex>(loop));
}

void BoundaryChain::place(LocalIndex site, double arc, geometry::Vec2 position) {
  const BoundaryCurve::CurvePlace on = curve_.place(loop(site), arc);
  BoundarySite& its = sites_.sites[at(site)];
  its.position = position;
  its.piece = on.piece;
  its.along = on.along;
}

/// To the image of the next site that is near.
void BoundaryChain::close_chord(LocalIndex site) {
  BoundarySite& its = sites_.sites[at(site)];
  const geometry::Vec2 end = sites_.sites[at(its.next)].position;
  its.next_shift = sites_.periods.nearest_image(end, its.position) - end;
}

/// Patches that do not overlap change each site once, only one of them divides a chord, and all know which sites there
/// are. @param edits by site, insertions into a chord by their arcs
void BoundaryChain::check(std::span<const BoundaryEdit> edits) const {
  for (std::size_t k = 0; k < edits.size(); ++k) {
    const BoundaryEdit& edit = edits[k];
    const auto fail = [&](const char* what) {
      throw InternalError(fmt::format("{}, at ({}, {})", what, edit.position.x, edit.position.y));
    };
    if (is_gone_[at(edit.site)])
      fail("a change of a boundary site that is gone");
    if (k == 0 || edits[k - 1].site != edit.site)
      continue;
    const BoundaryEdit& other = edits[k - 1];
    if (edit.kind != EditKind::insert || edit.patch != other.patch || edit.arc == other.arc)
      fail("two changes of one boundary site or chord");
  }
}

void BoundaryChain::move_or_remove(const BoundaryEdit& edit, std::vector<LocalIndex>& changed) {
  if (edit.kind == EditKind::move) {
    place(edit.site, edit.arc, edit.position);
    changed.push_back(edit.site);
    return;
  }
  const BoundarySite& its = sites_.sites[at(edit.site)];
  sites_.sites[at(its.previous)].next = its.next;
  sites_.sites[at(its.next)].previous = its.previous;
  is_gone_[at(edit.site)] = 1;
  changed.push_back(its.previous);
}

/// Behind the site that the edit names.
void BoundaryChain::insert(const BoundaryEdit& edit, std::vector<LocalIndex>& changed) {
  const auto made = static_cast<LocalIndex>(sites_.sites.size());
  BoundarySite site = sites_.sites[at(edit.site)];
  site.previous = edit.site;
  site.corner = false;
  sites_.sites[at(site.next)].previous = made;
  sites_.sites[at(edit.site)].next = made;
  sites_.sites.push_back(site);
  loops_.push_back(loop(edit.site));
  is_gone_.push_back(0);
  place(made, edit.arc, edit.position);
  changed.push_back(made);
  changed.push_back(edit.site);
}

std::vector<LocalIndex> BoundaryChain::apply(std::vector<BoundaryEdit> edits) {
  const auto insertions = std::stable_partition(edits.begin(), edits.end(),
                                                [](const BoundaryEdit& edit) { return edit.kind != EditKind::insert; });
  std::sort(edits.begin(), insertions, [](const BoundaryEdit& a, const BoundaryEdit& b) { return a.site < b.site; });
  check({edits.begin(), insertions});
  std::vector<LocalIndex> changed;
  for (auto edit = edits.begin(); edit != insertions; ++edit)
    move_or_remove(*edit, changed);
  const auto way = [&](const BoundaryEdit& edit) { // from the site before
    const double arc = edit.arc - curve_.arc(loop(edit.site), sites_.sites[at(edit.site)]);
    return arc >= 0 ? arc : arc + curve_.length(loop(edit.site));
  };
  std::sort(insertions, edits.end(), [&](const BoundaryEdit& a, const BoundaryEdit& b) {
    return a.site != b.site ? a.site < b.site : way(a) > way(b); // the last comes first: each goes behind `site`
  });
  check({insertions, edits.end()});
  for (auto edit = insertions; edit != edits.end(); ++edit)
    insert(*edit, changed);
  std::erase_if(changed, [&](LocalIndex site) { return is_gone_[at(site)] != 0; });
  for (const LocalIndex site : changed) {
    close_chord(site);
    close_chord(sites_.sites[at(site)].previous);
  }
  return changed;
}

/// The sites along the loops, by the indices that they have.
std::vector<LocalIndex> BoundaryChain::list_along_loops() {
  const std::size_t loops = sites_.loop_start.size() - 1;
  std::vector<LocalIndex> first(loops, -1), order;
  for (LocalIndex k = static_cast<LocalIndex>(sites_.sites.size()) - 1; k >= 0; --k)
    if (!is_gone_[at(k)])
      first[at(loop(k))] = k;
  for (std::size_t l = 0; l < loops; ++l) {
    if (LocalIndex k = first[l]; k >= 0)
      do
        order.push_back(k);
      while ((k = sites_.sites[at(k)].next) != first[l]);
    sites_.loop_start[l + 1] = static_cast<LocalIndex>(order.size());
  }
  return order;
}

std::vector<LocalIndex> BoundaryChain::renumber() {
  const std::vector<LocalIndex> order = list_along_loops();
  std::vector<LocalIndex> new_index(sites_.sites.size(), -1), loops;
  for (std::size_t k = 0; k < order.size(); ++k)
    new_index[at(order[k])] = static_cast<LocalIndex>(k);
  std::vector<BoundarySite> sites;
  for (const LocalIndex k : order) {
    BoundarySite& site = sites.emplace_back(sites_.sites[at(k)]);
    site.previous = new_index[at(site.previous)];
    site.next = new_index[at(site.next)];
    loops.push_back(loop(k));
  }
  sites_.sites = std::move(sites);
  loops_ = std::move(loops);
  is_gone_.assign(order.size(), 0);
  sites_.shortest = std::numeric_limits<double>::infinity();
  for (LocalIndex k = 0; k < static_cast<LocalIndex>(order.size()); ++k) {
    close_chord(k);
    const geometry::Segment chord = sites_.chord(k);
    sites_.shortest = std::fmin(sites_.shortest, geometry::length(chord.b - chord.a));
  }
  name_parts(curve_.boundary(), sites_);
  return new_index;
}

} // namespace trime::polygon
