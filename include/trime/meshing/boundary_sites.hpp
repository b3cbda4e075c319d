// SPDX-License-Identifier: BSD-3-Clause
// Boundary first: the sites on the boundary of a shape, laid out before any site inside. Corners are kept, arcs are
// divided by the size field, sharp corners by shells; then segments are halved until every chord between neighbouring
// sites is the diameter of a disc without other sites and the polygon of chords has the topology of the curve.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/periods.hpp"
#include "trime/geometry/segment.hpp"
#include "trime/meshing/feature_rule.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace trime::meshing {

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

/// Invariants: sites of one loop are consecutive and in order; at least 3 a loop; no two positions are equal; the open
/// diametral disc of each chord (site, next) holds no other site, so no two chords cross; images of sites and chords in
/// a periodic container included. The whole torus has no sites at all.
struct BoundarySites {
  std::vector<BoundarySite> sites;
  geometry::Periods periods{}; ///< of the container
  std::vector<LocalIndex>
      loop_start; ///< loops + 1: sites of loop i of those that stay are loop_start[i] .. loop_start[i+1]-1
  LocalIndex corners = 0;
  LocalIndex sharp_corners = 0; ///< corners with an angle below 60 degrees on either side
  LocalIndex halvings = 0;      ///< segments divided after the layout
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

/// @brief Lays out the sites of `boundary` for the absolute element size `size`.
///
/// A junction of two pieces that turns by more than `corner_angle` degrees is a corner; `rule` says which corners and
/// loops are left out. Between corners that are kept for certain, or along a whole loop without any, the sites lie at
/// equal quantiles of the integral of ds/h; where corners between them may be left out, a shortest path chooses those
/// that stay and places between them (site_path.hpp). Where two arms meet at less than 60 degrees both get sites at
/// equal distances from the corner until their gap reaches h (shells; Ruppert 1995). A segment is then divided while
/// another site lies in its diametral disc, or the curve between its ends leaves that disc, or turns by more than 60
/// degrees and strays from it by more than the tolerance: in the middle, or next to a sharp corner on a power-of-two
/// radius (concentric shells), so that the process ends for any angle. The discs are kept free of the points of
/// `inside`, too. Sites always lie on the curve. Deterministic; O(B log^2 B) for B sites and pieces.
/// @param affordable once there are so many sites, halving ends: the caller only wants to know that they are too many
/// @throws GeometryError with the place, if two parts of the boundary are too close to be told apart, or if the size
///         asks for more than 2^27 sites
BoundarySites make_boundary_sites(const geometry::Boundary& boundary, const sizing::SizeField& size,
                                  const geometry::Lattice& lattice, double corner_angle,
                                  std::span<const geometry::Vec2> inside = {}, const FeatureRule& rule = {},
                                  std::size_t affordable = std::numeric_limits<std::size_t>::max());

} // namespace trime::meshing
