// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary and the polygon of the chords between them. Everything that comes after the layout of the
// boundary knows it by this polygon alone. This header also says which junctions of the pieces of a loop are corners,
// and counts what was simplified before the layout.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime::polygon {

/// Counts and area of the loops that a rule drops.
struct DroppedLoops {
  std::vector<char> dropped; ///< per loop of the boundary
  int components = 0, holes = 0;
  double area = 0;        ///< area of the islands plus that of the lakes
  double share = 0;       ///< that area over the shape's, as the shape was given
  int others = 0;         ///< components that are left out since one was asked for; not among `components`
  double others_area = 0; ///< their area, without their holes
  double change = 0;      ///< change of the shape's area: lakes minus islands
  std::vector<geometry::Loop> other_loops; ///< the loops of the other components
  bool any() const { return components + holes + others > 0; }
};

struct BoundarySite {
  geometry::Vec2 position;     ///< on the lattice; canonical in a periodic container
  LocalIndex previous, next;   ///< along its loop, interior on the left
  std::int32_t tag;            ///< tag of its loop, and of the chord from here to `next`
  bool corner;                 ///< true for corners of the shape, whose coordinates are kept exactly
  geometry::Vec2 next_shift{}; ///< multiple of the periods: the chord ends at the position of `next` plus this shift
  LocalIndex piece = 0;        ///< piece of its loop on which the site lies
  double along = 0;            ///< arc length from the start of that piece
  std::int32_t part = 0;       ///< index into Boundary::part_names of the curve in the middle of the chord to `next`
};

/// Invariants: sites of one loop are consecutive and in order. A loop has at least 3. No two positions are equal. The
/// open diametral disc of each chord (site, next) holds no other site, so no two chords cross. All this includes images
/// of sites and chords in a periodic container. The whole torus has no sites.
struct BoundarySites {
  std::vector<BoundarySite> sites;
  geometry::Periods periods{}; ///< periods of the boundary
  std::vector<LocalIndex>
      loop_start; ///< the sites of the i-th remaining loop are loop_start[i] .. loop_start[i+1]-1; length loops + 1
  LocalIndex corners = 0;
  LocalIndex sharp_corners = 0; ///< corners with an angle below 60 degrees on either side
  LocalIndex halvings = 0;      ///< chords divided after the layout
  int rounds = 0;               ///< rounds of halving
  double shortest = 0;          ///< length of the shortest chord
  bool overfull = false;        ///< true if halving ended because there were too many sites: discs may not be empty
  DroppedLoops dropped;         ///< loops dropped by the rule for features below the resolution
  LocalIndex left_out = 0;      ///< number of corners of the shape on remaining loops that are not sites
  double deviation = 0;         ///< largest distance of such a corner from its chord, over the local size

  /// Returns the chord from site i to its next, or to the image of it to which the boundary leads.
  geometry::Segment chord(LocalIndex i) const {
    const BoundarySite& site = sites[i];
    return {site.position, sites[site.next].position + site.next_shift};
  }
};

/// Returns whether another part of the shape begins with this piece. Then a facet across the junction would belong to
/// both parts.
inline bool changes_part(const geometry::Loop& loop, std::size_t piece) {
  return loop.pieces[piece > 0 ? piece - 1 : loop.pieces.size() - 1].part != loop.pieces[piece].part;
}

/// Returns whether the start of a piece is a corner, because the boundary turns there or another part begins. Corners
/// below the resolution may be left out later.
inline bool is_corner(const geometry::Loop& loop, std::size_t piece, double corner_degrees) {
  return changes_part(loop, piece) || loop.turn_degrees(piece) > corner_degrees;
}

/// Counts of changes to a boundary over all passes.
struct Simplification {
  std::int64_t cut = 0;      ///< narrow parts of the shape that were removed
  std::int64_t filled = 0;   ///< filled holes with a small perimeter
  std::int64_t closed = 0;   ///< narrow parts of the outside that were filled
  std::int64_t widened = 0;  ///< narrow parts of the outside, and thin components, whose sides were moved apart, in the
                             ///< pass with most of them
  std::int64_t thinned = 0;  ///< pieces of ragged runs that were replaced by fewer pieces
  std::int64_t smoothed = 0; ///< vertices of ragged runs that were replaced by others
  double cut_area = 0, closed_area = 0; ///< areas in squared units of the coordinates
  double largest_move = 0;              ///< longest move of a vertex, over h
  double coarseness = 1;                ///< h for which this was done, over h of the mesh
  std::int64_t severed = 0;             ///< parts that joined or separated what stays, and were cut or closed
  double widest_severed = 0;            ///< [h] the least width of the widest of them
  geometry::Vec2 severed_place;         ///< where that is
  std::int64_t held = 0;                ///< narrow parts that stay since they join or separate; in the pass with most

  void add(const Simplification& other) {
    cut += other.cut;
    filled += other.filled;
    closed += other.closed;
    widened = std::max(widened, other.widened); // later passes may widen the same parts a little more
    thinned += other.thinned;
    smoothed += other.smoothed;
    cut_area += other.cut_area;
    closed_area += other.closed_area;
    largest_move = std::max(largest_move, other.largest_move);
    severed += other.severed;
    if (other.widest_severed > widest_severed) {
      widest_severed = other.widest_severed;
      severed_place = other.severed_place;
    }
    held = std::max(held, other.held);
  }
};

/// Returns the number of pieces of all loops.
inline std::int64_t piece_count(const geometry::Boundary& boundary) {
  std::int64_t count = 0;
  for (const geometry::Loop& loop : boundary.loops)
    count += static_cast<std::int64_t>(loop.pieces.size());
  return count;
}

} // namespace trime::polygon
