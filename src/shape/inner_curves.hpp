// SPDX-License-Identifier: BSD-3-Clause
// Joins the pieces of curves inside a shape to arcs from node to node.
#pragma once

#include "trime/core/types.hpp"
#include "trime/geometry/boundary.hpp"

#include <vector>

namespace trime::shape {

/// A piece of a curve or an interface in the arrangement of all parts and curves.
struct CurvePiece {
  LocalIndex from, to;     ///< vertices of the arrangement or nodes of its Quotient, in the direction of the piece
  int left = 0, right = 0; ///< regions on both sides
  geometry::Piece piece;   ///< Piece::part is the number of the curve, or -1 for an interface on which no curve lies
};

/// Returns the piece moved by a multiple of the periods.
geometry::Piece moved(geometry::Piece piece, geometry::Vec2 by);

/// @brief Joins pieces to arcs. A vertex is a node if it lies on the boundary, if another number of pieces than two
/// meets there, or if pieces of two curves or of two pairs of regions do. A ring without a node begins at its vertex
/// that comes first in lexicographic order. Cost: O(n log n).
/// In a periodic container the arcs are unrolled.
/// @param pieces each of them occurs once; their ends are exact images of nodes @param on_boundary by node: whether it
/// lies on the boundary of the shape
/// @param boundary decides, with the arcs, where an angle between curves is below 60 degrees; knows the periods
std::vector<geometry::InnerArc> join_pieces(std::vector<CurvePiece> pieces, const std::vector<char>& on_boundary,
                                            const geometry::Boundary& boundary);

} // namespace trime::shape
