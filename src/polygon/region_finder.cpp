// SPDX-License-Identifier: BSD-3-Clause
#include "polygon/region_finder.hpp"

#include <cmath>
#include <utility>

namespace trime::polygon {

using geometry::Segment;
using geometry::Vec2;

RegionFinder::RegionFinder(const BoundarySites& sites, const geometry::Regions& regions,
                           const geometry::Lattice& lattice)
    : sites_(sites), regions_(regions) {
  if (!any())
    return;
  outlines_.resize(count());
  const auto rim = static_cast<LocalIndex>(sites.sites.size());
  for (LocalIndex k = 0; k < rim; ++k)
    outlines_[static_cast<std::size_t>(sites.sites[static_cast<std::size_t>(k)].region)].push_back(2 * k);
  for (std::size_t k = 0; k < sites.inner.chords.size(); ++k)
    if (const InnerChord& chord = sites.inner.chords[k]; chord.left != chord.right) {
      const LocalIndex number = 2 * (rim + static_cast<LocalIndex>(k));
      outlines_[static_cast<std::size_t>(chord.left)].push_back(number);
      outlines_[static_cast<std::size_t>(chord.right)].push_back(number + 1);
    }
  if (sites.periods.any())
    add_outlines(lattice);
  else
    add_grids();
}

void RegionFinder::add_grids() {
  std::vector<geometry::Box> boxes;
  for (int region = 1; region < static_cast<int>(count()); ++region) {
    std::vector<Segment> outline;
    geometry::Box box;
    for_each_chord(region, [&](Vec2 a, Vec2 b) {
      outline.push_back({a, b});
      box.include(a);
      box.include(b);
    });
    if (outline.empty())
      continue;
    boxes.push_back(box);
    regions_of_grids_.push_back(region);
    grids_.emplace_back(std::move(outline));
  }
  boxes_ = geometry::BoxTree(boxes);
}

void RegionFinder::add_outlines(const geometry::Lattice& lattice) {
  std::vector<geometry::Box> boxes;
  const double far = 2 * std::fmax(sites_.periods.x, sites_.periods.y);
  for (int region = 1; region < static_cast<int>(count()); ++region) {
    std::vector<Segment> outline;
    for_each_chord(region, [&](Vec2 a, Vec2 b) { outline.push_back({a, b}); });
    if (outline.empty()) {
      if (regions_.areas[static_cast<std::size_t>(region)] > 0)
        whole_ = region;
      continue;
    }
    regions_of_grids_.push_back(region);
    periodic_.emplace_back(outline, sites_.periods, lattice);
    geometry::Box box = periodic_.back().box();
    if (!(box.min.x <= box.max.x)) {
      everywhere_.push_back(periodic_.size() - 1);
      box = {sites_.periods.min - Vec2{far, far}, sites_.periods.min - Vec2{far, far}}; // where no point is looked for
    }
    boxes.push_back(box);
  }
  boxes_ = geometry::BoxTree(boxes);
}

int RegionFinder::at(Vec2 p) const {
  int found = whole_;
  if (sites_.periods.any()) {
    p = sites_.periods.wrap(p);
    const auto look = [&](std::size_t k) {
      if (found == whole_ && periodic_[k].inside(p))
        found = regions_of_grids_[k];
    };
    boxes_.for_each_meeting({p, p}, look);
    for (const std::size_t k : everywhere_)
      look(k);
    return found;
  }
  boxes_.for_each_meeting({p, p}, [&](std::size_t grid) {
    if (found == 0 && grids_[grid].inside(p))
      found = regions_of_grids_[grid];
  });
  return found;
}

} // namespace trime::polygon
