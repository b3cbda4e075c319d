// SPDX-License-Identifier: BSD-3-Clause
// Joins curves with the interfaces and the curves that they follow, where both lie nearer to each other than the
// triangles can show.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/lattice.hpp"
#include "trime/geometry/piece_tree.hpp"
#include "trime/geometry/vec2.hpp"
#include "trime/sizing/size_field.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace trime::generalise {

/// The parts of curves that belong to other lines, see join_lines().
struct JoinedParts {
  double length = 0;    ///< their total length
  double farthest = 0;  ///< largest distance of one of them from its line
  geometry::Vec2 place; ///< where that is
  /// Takes in further parts.
  void add(const JoinedParts& later) {
    length += later.length;
    if (later.farthest > farthest) {
      farthest = later.farthest;
      place = later.place;
    }
  }
};

/// Says how often lines that follow each other were joined.
struct JoinedLines {
  std::int64_t vertices = 0;   ///< vertices of one line through which the other one leads
  double farthest = 0;         ///< largest distance of such a vertex from the other line
  geometry::Vec2 place{};      ///< where that vertex is
  std::int64_t loose_ends = 0; ///< ends of curves beyond another curve or an interface that were left out
  double longest_end = 0;      ///< length of the longest of them
  JoinedParts rim{};           ///< parts of curves that belong to the boundary
  JoinedParts lines{};         ///< parts of curves that belong to other curves
  JoinedParts interfaces{};    ///< parts of curves that belong to interfaces between regions
  /// Returns the total length of the parts that belong to other lines.
  double length() const { return rim.length + lines.length + interfaces.length; }
  /// Takes in what was joined later.
  void add(const JoinedLines& later) {
    vertices += later.vertices;
    loose_ends += later.loose_ends;
    longest_end = longest_end > later.longest_end ? longest_end : later.longest_end;
    rim.add(later.rim);
    lines.add(later.lines);
    interfaces.add(later.interfaces);
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

/// Says by which size and rules arcs are joined.
struct ArcRules {
  const sizing::SizeField& size; ///< h
  const geometry::Lattice& lattice;
  std::span<const geometry::Vec2> corners{};       ///< places that must stay, in lexicographic order
  std::span<const geometry::CurveKind> kinds{};    ///< as InnerCurves::kinds
  const geometry::PieceTree* interfaces = nullptr; ///< from which interfaces stay within rim_distance h; null: any
};

/// @brief Joins each curve with the interfaces between regions, and with the other curves, that it follows. Where a
/// vertex of one of both lies nearer to an edge of the other than GeneraliseRules::snap_distance h, that edge leads
/// through the vertex. So a curve that ends just before another one ends on it. Edges of a curve and of an
/// interface that have the same ends then become one edge, with the name of the curve and the regions of the interface.
/// Edges of two curves become one with the name of the first curve, unless one of them is split. Curves that meet at
/// more than about 20 degrees do not follow each other. An end of a curve that reaches beyond another curve or an
/// interface by less than GeneraliseRules::node_distance h is left out. Other ends of curves, nodes of interfaces and
/// points that the user asked for stay bit for bit.
///
/// An edge moves only if the triangle over which it moves holds no other vertex, and if its two parts meet no other
/// curve. So no crossings arise, and each region keeps its neighbours. Edges whose parts lead through further vertices
/// do not move farther than the distance in total, and interfaces stay within
/// GeneraliseRules::rim_distance h of ArcRules::interfaces, however often the function is called. InnerArc::lost_area
/// says what the interfaces take from the regions on their left. If nothing is joined, all arcs are as they were. Cost:
/// O(n log n) for n pieces, in each of a few rounds. Deterministic; uses one thread.
/// @param boundary the boundary that is meshed, without periods
/// @throws GeometryError if a size is not positive and finite
SnappedArcs snapped_arcs(const std::vector<geometry::InnerArc>& arcs, const geometry::Boundary& boundary,
                         const ArcRules& rules);

} // namespace trime::generalise
