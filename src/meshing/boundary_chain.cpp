// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/boundary_chain.hpp"

#include "trime/core/error.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace trime::meshing {
namespace {

std::size_t at(LocalIndex i) {
  return static_cast<std::size_t>(i);
}

} // namespace

BoundaryChain::BoundaryChain(const BoundarySites& boundary, const BoundaryCurve& curve)
    : curve_(curve), sites_(boundary), original_(boundary.sites.size()), fates_(original_, Fate::untouched) {
  for (std::size_t loop = 0; loop + 1 < boundary.loop_start.size(); ++loop)
    loops_.resize(at(boundary.loop_start[loop + 1]), static_cast<LocalIndex>(loop));
}

void BoundaryChain::place(LocalIndex site, double arc, geometry::Vec2 position) {
  const BoundaryCurve::Place on = curve_.place(loop(site), arc);
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

/// Patches that do not overlap change each site once, and a chord is divided by one of them.
/// @param edits by site, insertions into a chord by their way
void BoundaryChain::check_apart(std::span<const BoundaryEdit> edits) {
  for (std::size_t k = 1; k < edits.size(); ++k) {
    const BoundaryEdit &one = edits[k - 1], &other = edits[k];
    const bool divides = other.kind == BoundaryEdit::Kind::insert;
    if (one.site == other.site && (!divides || one.patch != other.patch || one.arc == other.arc))
      throw InternalError(
          fmt::format("two changes of one boundary site or chord, at ({}, {})", other.position.x, other.position.y));
  }
}

std::vector<LocalIndex> BoundaryChain::apply(std::vector<BoundaryEdit> edits) {
  const auto divisions = std::stable_partition(
      edits.begin(), edits.end(), [](const BoundaryEdit& edit) { return edit.kind != BoundaryEdit::Kind::insert; });
  std::sort(edits.begin(), divisions, [](const BoundaryEdit& a, const BoundaryEdit& b) { return a.site < b.site; });
  check_apart({edits.begin(), divisions});
  std::vector<LocalIndex> changed;
  for (const BoundaryEdit& edit : edits) {
    if (edit.kind == BoundaryEdit::Kind::slide) {
      place(edit.site, edit.arc, edit.position);
      fates_[at(edit.site)] = Fate::moved;
      changed.push_back(edit.site);
    } else if (edit.kind == BoundaryEdit::Kind::remove) {
      const BoundarySite& its = sites_.sites[at(edit.site)];
      sites_.sites[at(its.previous)].next = its.next;
      sites_.sites[at(its.next)].previous = its.previous;
      fates_[at(edit.site)] = Fate::gone;
      changed.push_back(its.previous);
    }
  }
  std::erase_if(edits, [](const BoundaryEdit& edit) { return edit.kind != BoundaryEdit::Kind::insert; });
  const auto way = [&](const BoundaryEdit& edit) { // from the site before
    const double arc = edit.arc - curve_.arc(loop(edit.site), sites_.sites[at(edit.site)]);
    return arc >= 0 ? arc : arc + curve_.length(loop(edit.site));
  };
  std::sort(edits.begin(), edits.end(), [&](const BoundaryEdit& a, const BoundaryEdit& b) {
    return a.site != b.site ? a.site < b.site : way(a) > way(b); // the last comes first: each goes behind `site`
  });
  check_apart(edits);
  for (const BoundaryEdit& edit : edits) {
    const auto made = static_cast<LocalIndex>(sites_.sites.size());
    BoundarySite site = sites_.sites[at(edit.site)];
    site.previous = edit.site;
    site.corner = false;
    sites_.sites[at(site.next)].previous = made;
    sites_.sites[at(edit.site)].next = made;
    sites_.sites.push_back(site);
    loops_.push_back(loop(edit.site));
    fates_.push_back(Fate::moved);
    place(made, edit.arc, edit.position);
    changed.push_back(made);
    changed.push_back(edit.site);
  }
  std::erase_if(changed, [&](LocalIndex site) { return fates_[at(site)] == Fate::gone; });
  for (const LocalIndex site : changed) {
    close_chord(site);
    close_chord(sites_.sites[at(site)].previous);
  }
  return changed;
}

std::vector<LocalIndex> BoundaryChain::finish(BoundarySites& boundary) const {
  std::vector<BoundaryEdit> edits;
  for (std::size_t k = 0; k < sites_.sites.size(); ++k) {
    const BoundarySite& site = sites_.sites[k];
    const double arc = curve_.arc(loops_[k], site);
    const auto index = static_cast<LocalIndex>(k);
    if (k < original_ && fates_[k] == Fate::gone)
      edits.push_back({index, BoundaryEdit::Kind::remove, 0, {}});
    else if (k < original_ && fates_[k] == Fate::moved)
      edits.push_back({index, BoundaryEdit::Kind::slide, arc, site.position});
    else if (k >= original_ && fates_[k] != Fate::gone) {
      LocalIndex before = site.previous;
      while (at(before) >= original_)
        before = sites_.sites[at(before)].previous;
      edits.push_back({before, BoundaryEdit::Kind::insert, arc, site.position});
    }
  }
  std::vector<LocalIndex> inserted, new_index(sites_.sites.size(), -1);
  const std::vector<LocalIndex> of_originals = edit_boundary(boundary, curve_, edits, inserted);
  std::copy(of_originals.begin(), of_originals.end(), new_index.begin());
  std::map<std::pair<double, double>, LocalIndex> index_at;
  for (std::size_t k = 0; k < edits.size(); ++k)
    if (inserted[k] >= 0)
      index_at[{edits[k].position.x, edits[k].position.y}] = inserted[k];
  for (std::size_t k = original_; k < sites_.sites.size(); ++k)
    if (fates_[k] != Fate::gone)
      new_index[k] = index_at.at({sites_.sites[k].position.x, sites_.sites[k].position.y});
  return new_index;
}

} // namespace trime::meshing
