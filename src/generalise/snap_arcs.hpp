// SPDX-License-Identifier: BSD-3-Clause
// Joins curves with interfaces that they follow, where both lie nearer to each other than the triangles can show.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <vector>

namespace trime::generalise {

/// Says how often curves and interfaces that follow each other were joined.
struct JoinedLines {
  std::int64_t vertices = 0; ///< vertices of one line through which the other one leads
  double farthest = 0;       ///< largest distance of such a vertex from the other line
  geometry::Vec2 place{};    ///< where that vertex is
  /// Takes in what was joined later.
  void add(const JoinedLines& later) {
    vertices += later.vertices;
    if (later.farthest > farthest) {
      farthest = later.farthest;
      place = later.place;
    }
  }
};

/// Arcs after some of them were joined.
struct SnappedArcs {
  std::vector<geometry::InnerArc> arcs;
  JoinedLines joined;
};

/// @brief Joins each curve with the interfaces between regions that it follows. Where a vertex of one of both lies
/// nearer to an edge of the other than GeneraliseRules::snap_distance h, that edge leads through the vertex. Edges of a
/// curve and of an interface that have the same ends then become one edge, with the name of the curve and the regions
/// of the interface. No vertex moves: ends of curves, nodes of interfaces and points that the user asked for stay bit
/// for bit.
///
/// An edge moves only if the triangle over which it moves holds no other vertex, and if its two parts meet no other
/// curve. So no crossings arise, and each region keeps its neighbours. Edges whose parts lead through further vertices
/// do not move farther than the distance in total. InnerArc::lost_area says what the interfaces take from the regions
/// on their left. If nothing is joined, all arcs are as they were. Cost: O(n log n) for n pieces, in each of a few
/// rounds. Deterministic; uses one thread.
/// @param boundary the boundary that is meshed, without periods
/// @throws GeometryError if a size is not positive and finite
SnappedArcs snapped_arcs(const std::vector<geometry::InnerArc>& arcs, const geometry::Boundary& boundary,
                         const sizing::SizeField& size, const geometry::Lattice& lattice);

} // namespace trime::generalise
