// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary and the polygon of the chords between them. Everything that comes after the layout of the
// boundary knows it by this polygon alone.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/geometry/segment.hpp"
#include "trime/geometry/vec2.hpp"

#include <cstdint>
#include <vector>

namespace trime::polygon {

/// Counts and area of the loops that a rule drops.
struct DroppedLoops {
  std::vector<char> dropped; ///< per loop of the boundary
  int components = 0, holes = 0;
  double area = 0;        ///< of the islands plus that of the lakes
  double share = 0;       ///< that area over the shape's, as the shape was given
  int others = 0;         ///< components that are left out since one was asked for; not among `components`
  double others_area = 0; ///< their area, without their holes
  double change = 0;      ///< of the shape's area: lakes minus islands
  bool any() const { return components + holes + others > 0; }
};

struct BoundarySite {
  geometry::Vec2 position;     ///< on the lattice; canonical in a periodic container
  LocalIndex previous, next;   ///< along its loop, interior on the left
  std::int32_t tag;            ///< of its loop; also of the chord from here to `next`
  bool corner;                 ///< given by the shape, kept bit for bit
  geometry::Vec2 next_shift{}; ///< multiple of the periods: the chord ends at the position of `next` moved by it
  LocalIndex piece = 0;        ///< of its loop, on which the site lies
  double along = 0;            ///< arc length from the start of that piece
  std::int32_t part = 0;       ///< index into Boundary::part_names: of the curve in the middle of the chord to `next`
};

/// Invariants: sites of one loop are consecutive and in order. A loop has at least 3. No two positions are equal. The
/// open diametral disc of each chord (site, next) holds no other site, so no two chords cross. All this includes images
/// of sites and chords in a periodic container. The whole torus has no sites.
struct BoundarySites {
  std::vector<BoundarySite> sites;
  geometry::Periods periods{}; ///< those of the boundary
  std::vector<LocalIndex>
      loop_start; ///< loops + 1: sites of loop i of those that stay are loop_start[i] .. loop_start[i+1]-1
  LocalIndex corners = 0;
  LocalIndex sharp_corners = 0; ///< corners with an angle below 60 degrees on either side
  LocalIndex halvings = 0;      ///< chords divided after the layout
  int rounds = 0;               ///< of halving
  double shortest = 0;          ///< length of the shortest chord
  bool overfull = false;        ///< ended at more sites than are affordable: the discs may not be empty
  DroppedLoops dropped;         ///< by the rule for features below the resolution
  LocalIndex left_out = 0;      ///< corners of the shape, on loops that stay, that are no sites
  double deviation = 0;         ///< largest distance of such a corner from its chord, over the local size

  /// From site i to its next, or to that image of it where the boundary leads.
  geometry::Segment chord(LocalIndex i) const {
    const BoundarySite& site = sites[i];
    return {site.position, sites[site.next].position + site.next_shift};
  }
};

} // namespace trime::polygon
