// SPDX-License-Identifier: BSD-3-Clause
// The pieces of a boundary and of the arcs inside it, with a search tree.
#pragma once

#include "trime/geometry/boundary.hpp"
#include "trime/geometry/piece_tree.hpp"

#include <cstddef>
#include <vector>

namespace trime::generalise {

/// Returns the point of a piece that is nearest to p.
geometry::Vec2 nearest_on(const geometry::Piece& piece, geometry::Vec2 p);
/// Returns the arc length from the start of a piece to its point p.
double way_on(const geometry::Piece& piece, geometry::Vec2 p);

/// Pieces of an arc that an edge may meet.
struct OwnPieces {
  std::size_t arc, first, last;
};

/// The pieces of the boundary, then those of the arcs, numbered from 0. Refers to the arcs.
class LinePieces {
public:
  static constexpr int rim = -1;
  struct Line {
    int arc;            ///< its number, or rim
    std::size_t loop;   ///< its number in the boundary
    std::size_t number; ///< number of the piece in its arc or loop
    double way;         ///< along the arc or loop up to the piece
    const geometry::Piece* piece;
  };

  /// Cost: O(n log n).
  LinePieces(const geometry::Boundary& boundary, const std::vector<geometry::InnerArc>& arcs);

  const Line& operator[](std::size_t k) const { return lines_[k]; }
  /// Returns the number of the first piece of an arc.
  std::size_t first_of(std::size_t arc) const { return first_of_[arc]; }
  /// Returns the length of an arc.
  double length_of(std::size_t arc) const { return length_of_[arc]; }
  /// Returns the numbers of the pieces that are nearer to p than this, ascending.
  std::vector<std::size_t> within(geometry::Vec2 p, double distance) const { return tree_.within(p, distance); }
  /// Returns whether a piece is one of these.
  bool is_own(std::size_t piece, const OwnPieces& own) const;
  /// Returns whether a straight piece meets another piece. @param except a piece that does not count @param own further
  /// ones
  bool meets(const geometry::Piece& edge, std::size_t except, const OwnPieces& own) const;

private:
  void add(int arc, std::size_t loop, const std::vector<geometry::Piece>& pieces);

  std::vector<Line> lines_;
  std::vector<std::size_t> first_of_; // by arc
  std::vector<double> length_of_;     // by arc
  geometry::PieceTree tree_;
};

} // namespace trime::generalise
