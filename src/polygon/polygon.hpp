// SPDX-License-Identifier: BSD-3-Clause
// The sites on the boundary, and the polygon of the straight chords between them. All later steps of a run use only
// this polygon as the boundary. This header also decides which junctions of pieces are corners, and counts how the
// boundary was simplified before sites were placed on it.
#pragma once

#include "polygon/inner_chords.hpp"
#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace trime::polygon {

/// The loops of the boundary that are not meshed, with their number and area.
struct DroppedLoops {
  std::vector<char> dropped; ///< by loop of the boundary: whether it is dropped
  int components = 0, holes = 0;
  double area = 0;  ///< area of the dropped islands plus that of the dropped lakes
  double share = 0; ///< `area` divided by the area of the shape as it was given
  int others = 0;   ///< number of components that are left out because the user asked for one component; not counted in
                    ///< `components`
  double others_area = 0;                  ///< area of these other components, without their holes
  double change = 0;                       ///< change of the shape's area: dropped lakes minus dropped islands
  std::vector<geometry::Loop> other_loops; ///< the loops of the other components
  bool any() const { return components + holes + others > 0; }
};

struct BoundarySite {
  geometry::Vec2 position;     ///< position on the coordinate lattice; inside the container if that is periodic
  LocalIndex previous, next;   ///< neighbours along the loop, with the interior on the left
  std::int32_t tag;            ///< tag of the loop, and of the chord from here to `next`
  bool corner;                 ///< true for corners of the shape, whose coordinates are kept exactly
  geometry::Vec2 next_shift{}; ///< multiple of the periods; the chord ends at the position of `next` plus this shift
  LocalIndex piece = 0;        ///< number of the piece of the loop on which the site lies
  double along = 0;            ///< arc length from the start of the piece
  std::int32_t part =
      0; ///< part of the shape at the middle of the chord to `next`, as an index into Boundary::part_names
  std::int32_t region = 0; ///< region on the left of this chord, as an index into geometry::Regions::names
};

/// The boundary sites. Invariants: the sites of one loop are consecutive and in order. A loop has at least 3 sites. No
/// two positions are equal. The open diametral circle of each chord (site, next) contains no other site, so no two
/// chords cross. In a periodic container all this includes periodic images of sites and chords. A shape that covers the
/// whole torus has no boundary sites.
struct BoundarySites {
  std::vector<BoundarySite> sites;
  geometry::Periods periods{};        ///< periods of the boundary
  std::vector<LocalIndex> loop_start; ///< the sites of the i-th remaining loop are loop_start[i] .. loop_start[i+1]-1;
                                      ///< the last entry is the number of sites
  LocalIndex corners = 0;
  LocalIndex sharp_corners = 0; ///< corners with an angle below 60 degrees, inside or outside
  LocalIndex halvings = 0;      ///< number of chords that were divided after the first placement
  int rounds = 0;               ///< rounds of halving
  double shortest = 0;          ///< length of the shortest chord
  bool overfull =
      false; ///< true if dividing ended because there were too many sites; then diametral circles may contain sites
  DroppedLoops dropped;    ///< loops that are dropped because they are smaller than the triangles
  LocalIndex left_out = 0; ///< number of corners of the shape on remaining loops that are not boundary sites
  double deviation = 0;    ///< largest distance of such a corner from its chord, divided by the local size
  InnerChords inner;       ///< chords of curves inside the shape

  /// Returns the chord from site i to the next site, or to that periodic image of the next site to which the boundary
  /// leads.
  geometry::Segment chord(LocalIndex i) const {
    const BoundarySite& site = sites[i];
    return {site.position, sites[site.next].position + site.next_shift};
  }
};

/// Returns whether another part of the shape begins with this piece. Without a corner there, a facet across the
/// junction would belong to both parts.
inline bool changes_part(const geometry::Loop& loop, std::size_t piece) {
  return loop.pieces[piece > 0 ? piece - 1 : loop.pieces.size() - 1].part != loop.pieces[piece].part;
}

/// Returns whether the start of a piece is a corner, because the boundary turns there or another part begins. Corners
/// of features that are smaller than the triangles may be left out later.
inline bool is_corner(const geometry::Loop& loop, std::size_t piece, double corner_degrees) {
  return changes_part(loop, piece) || loop.turn_degrees(piece) > corner_degrees;
}

/// Counts of all changes that simplified a boundary.
struct Simplification {
  std::int64_t cut = 0;      ///< narrow parts of the shape that were removed
  std::int64_t filled = 0;   ///< holes with a small perimeter that were filled
  std::int64_t closed = 0;   ///< narrow parts of the outside that were filled
  std::int64_t widened = 0;  ///< narrow parts of the outside, and thin components, whose sides were moved apart; the
                             ///< largest number in one pass
  std::int64_t thinned = 0;  ///< pieces of ragged curves that were replaced by fewer pieces
  std::int64_t smoothed = 0; ///< vertices of ragged curves that smoothing replaced by others
  double cut_area = 0, closed_area = 0; ///< areas in squared units of the coordinates
  double largest_move = 0;              ///< longest move of a vertex, divided by h
  double coarseness = 1;                ///< size h for which the boundary was simplified, divided by h of the mesh
  std::int64_t severed = 0;  ///< narrow parts that joined or separated large parts of the shape, and were cut or closed
  double widest_severed = 0; ///< [h] largest width among the severed parts
  geometry::Vec2 severed_place; ///< place of the widest severed part
  std::int64_t held = 0; ///< narrow parts that stay because they join or separate large parts of the shape; the largest
                         ///< number in one pass

  void add(const Simplification& other) {
    cut += other.cut;
    filled += other.filled;
    closed += other.closed;
    widened =
        std::max(widened, other.widened); // a maximum, because later passes may widen the same parts a little more
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

/// Returns the total number of pieces of all loops.
inline std::int64_t piece_count(const geometry::Boundary& boundary) {
  std::int64_t count = 0;
  for (const geometry::Loop& loop : boundary.loops)
    count += static_cast<std::int64_t>(loop.pieces.size());
  return count;
}

} // namespace trime::polygon
