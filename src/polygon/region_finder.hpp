// SPDX-License-Identifier: BSD-3-Clause
// Finds the region in which a place of the mesh lies. The chords of boundary and interfaces decide, so the answer is
// exact for the polygons that the mesh fills.
#pragma once

#include "geometry/box_tree.hpp"
#include "geometry/periodic_outline.hpp"
#include "polygon/polygon.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/segment_grid.hpp"

#include <cstddef>
#include <vector>

namespace trime::polygon {

/// @brief Divides the polygon of the boundary sites by its interfaces. Keeps references to the sites and the regions.
/// Immutable and thread-safe; takes O(c log c) time to build for c chords.
class RegionFinder {
public:
  RegionFinder(const BoundarySites& sites, const geometry::Regions& regions, const geometry::Lattice& lattice);

  /// Returns whether there is more than one region.
  bool any() const { return regions_.any(); }
  std::size_t count() const { return any() ? regions_.names.size() : 1; }
  /// Returns the region at p, as an index into Regions::names; the rest (0) where no other region lies. The region is
  /// exact for lattice points off the chords. Cost: O(log regions) and one exact inside test for each region near p.
  /// @pre p, or an image of it, lies in the polygon of the boundary and on the coordinate lattice
  int at(geometry::Vec2 p) const;

  /// Calls visit(a, b) for all chords of the outline of a region, with the region on the left. In a periodic container
  /// an end may be an image of its site.
  template <class Visit>
  void for_each_chord(int region, const Visit& visit) const {
    for (const LocalIndex k : outlines_[static_cast<std::size_t>(region)]) {
      const auto chord = static_cast<std::size_t>(k / 2);
      const bool is_rim = chord < sites_.sites.size();
      const geometry::Segment ends =
          is_rim ? sites_.chord(static_cast<LocalIndex>(chord)) : sites_.inner.chords[chord - sites_.sites.size()].ends;
      k % 2 == 0 ? visit(ends.a, ends.b) : visit(ends.b, ends.a);
    }
  }
  const geometry::Regions& regions() const { return regions_; }

private:
  void add_grids();
  void add_outlines(const geometry::Lattice& lattice);

  const BoundarySites& sites_;
  const geometry::Regions& regions_;
  std::vector<std::vector<LocalIndex>> outlines_; // by region: chords as 2 k if it is on the left, else 2 k + 1; those
                                                  // inside follow those of the boundary
  std::vector<geometry::SegmentGrid> grids_;      // by region from 1, without empty ones
  std::vector<geometry::PeriodicOutline> periodic_; // replace grids_ in a periodic container
  std::vector<int> regions_of_grids_;
  geometry::BoxTree boxes_;             // one for each grid
  std::vector<std::size_t> everywhere_; // periodic outlines that have no box
  int whole_ = 0;                       // region without an outline that fills a torus
};

/// Returns the lattice point next to the centroid of a triangle.
inline geometry::Vec2 centroid(geometry::Vec2 a, geometry::Vec2 b, geometry::Vec2 c, const geometry::Lattice& lattice) {
  return lattice.snap(a + (1.0 / 3) * ((b - a) + (c - a)));
}

} // namespace trime::polygon
